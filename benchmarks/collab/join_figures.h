#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// Sizes of the designs that are joined, and how many clients wait for a server that was killed.
struct JoinExtent {
  int frequency = 224;  // of the bumpy sphere: 20 * frequency^2 triangles
  int objects = 100'000;
  int clients = 50;
  int times = 5;  // each figure is the median of so many
};

/// The time until a design was there, ready to be worked on.
struct JoinRow {
  std::string figure;
  double seconds = 0.0;
  double to_reach = 0.0;  // s
};

/// One program joins designs of a server on the loopback, by TLS; then a server of many clients is killed and
/// started anew. `program` is icome-server; its stores lie below `folder`.
std::vector<JoinRow> join_figures(const std::filesystem::path& program, const std::filesystem::path& folder,
                                  const JoinExtent& extent);

void print_table(const std::vector<JoinRow>& rows);

}  // namespace icome::benchmarks
