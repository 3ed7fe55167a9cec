#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// How much is measured.
struct StoreExtent {
  double seconds = 3.0;          // a row
  double edits_a_second = 20e3;  // that come in where a rate is kept
  std::size_t edit_bytes = 200;
};

/// A line of the table: how long edits wait until they are durable.
struct StoreRow {
  std::string figure = {};
  double edits_a_second = 0.0;
  double p50_ms = 0.0, p99_ms = 0.0, worst_ms = 0.0;
  std::optional<double> p99_to_reach_ms = std::nullopt;
};

/// Measures the stores of designs on the disk of `folder`: SQLite, and PostgreSQL where it is installed.
std::vector<StoreRow> store_figures(const std::filesystem::path& folder, const StoreExtent& extent);

void print_table(const std::vector<StoreRow>& rows, const StoreExtent& extent,
                 const std::filesystem::path& folder);

}  // namespace icome::benchmarks
