#include "stats_samples.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "io/file_bytes.h"
#include "stats/tables/table_reader.h"

namespace icome::benchmarks {
namespace {

constexpr unsigned kSampleSeed = 1998;
constexpr std::uint64_t kLargestSample = 1ULL << 30U;  // bytes

stats::Factor named_factor(const std::string& name, int levels) {
  stats::Factor factor{name, {}, {}, false};
  for (int level = 0; level < levels; ++level) factor.levels.push_back(fmt::format("{}{}", name, level + 1));
  return factor;
}

/// A measured value as files have them: with three digits after the point.
double drawn(std::mt19937_64& random, double mean) {
  return std::round(std::normal_distribution<double>(mean, 1.0)(random) * 1e3) * 1e-3;
}

}  // namespace

StatsSample one_way_sample(int rows) {
  std::mt19937_64 random(kSampleSeed);
  StatsSample sample{{}, {named_factor("g", 10)}};
  for (int row = 0; row < rows; ++row) {
    const int level = row % 10;
    sample.values.push_back(drawn(random, 20.0 + 0.001 * level));
    sample.factors[0].of.push_back(level);
  }
  return sample;
}

StatsSample factorial_sample(int rows) {
  std::mt19937_64 random(kSampleSeed);
  // The cells get 1 to 12 shares of the rows.
  std::discrete_distribution<int> cell({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  StatsSample sample{{}, {named_factor("a", 3), named_factor("b", 4)}};
  for (int row = 0; row < rows; ++row) {
    // The first rows go to all cells in turn, so that no cell of a small sample is empty.
    const int drawn_cell = row < 24 ? row % 12 : cell(random);
    const int a = drawn_cell / 4, b = drawn_cell % 4;
    sample.values.push_back(drawn(random, 20.0 + 0.002 * a + 0.003 * b + 0.001 * a * b));
    sample.factors[0].of.push_back(a);
    sample.factors[1].of.push_back(b);
  }
  return sample;
}

StatsSample repeated_sample(int subjects) {
  std::mt19937_64 random(kSampleSeed);
  StatsSample sample{{}, {named_factor("s", subjects), named_factor("a", 3), named_factor("b", 4)}};
  for (int subject = 0; subject < subjects; ++subject) {
    const double ability = drawn(random, 20.0);
    for (int condition = 0; condition < 12; ++condition) {
      const int a = condition / 4, b = condition % 4;
      sample.values.push_back(drawn(random, ability + 0.05 * a + 0.03 * b));
      sample.factors[0].of.push_back(subject);
      sample.factors[1].of.push_back(a);
      sample.factors[2].of.push_back(b);
    }
  }
  return sample;
}

void write_sample(const StatsSample& sample, const std::filesystem::path& file) {
  std::ofstream csv(file);
  csv << "y";
  for (const stats::Factor& factor : sample.factors) csv << ',' << factor.name;
  for (std::size_t row = 0; row < sample.values.size(); ++row) {
    csv << fmt::format("\n{}", sample.values[row]);
    for (const stats::Factor& factor : sample.factors)
      csv << ',' << factor.levels[std::size_t(factor.of[row])];
  }
  csv << '\n';
  if (!csv.flush()) std::abort();
}

StatsSample read_sample(const std::filesystem::path& file) {
  const auto bytes = io::read_bytes(file, kLargestSample);
  if (!bytes) std::abort();
  const auto table = stats::read_any_table(*bytes, file.string());
  if (!table) std::abort();
  const bool named = table->find("y").has_value();
  const stats::Column& response = named ? table->columns().front() : table->columns().back();
  auto values = table->numbers(response);
  if (!values) std::abort();
  StatsSample sample{std::move(*values), {}};
  for (const stats::Column& column : table->columns()) {
    if (&column == &response) continue;
    stats::Levels levels = table->levels(column);
    stats::Factor factor{column.name(), std::move(levels.names), {}, false};
    factor.of.assign(levels.of.begin(), levels.of.end());
    sample.factors.push_back(std::move(factor));
  }
  return sample;
}

}  // namespace icome::benchmarks
