#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "stats/tables/count_check.h"
#include "stats/tests/fisher_exact.h"

namespace icome::stats {
namespace {

using RowsLeft = std::vector<int>;  // each row's counts that are left for the columns to come, ascending

// A node of the network: rows left, and the log weight of the columns so far, rounded so that weights that
// are equal but for rounding meet in one node.
struct NodeKey {
  RowsLeft rows;
  std::int64_t past = 0;
  bool operator==(const NodeKey&) const = default;
};

struct NodeHash {
  std::size_t operator()(const RowsLeft& rows) const {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const int row : rows) hash = (hash ^ static_cast<std::uint64_t>(row)) * 1099511628211ULL;
    return hash ^ (hash >> 29);
  }
  std::size_t operator()(const NodeKey& key) const {
    return (*this)(key.rows) ^ (static_cast<std::uint64_t>(key.past) * 0x9e3779b97f4a7c15ULL);
  }
};

struct Node {
  double past = 0.0;   // log weight of one way to this node: -sum of ln(cell!)
  double share = 0.0;  // probability of all tables that pass through this node
};

struct Extremes {
  double greatest = 0.0, least = 0.0;  // log weight of the columns to come
};

// The weight of a table is 1 / product of (cell!); tables with the same margins have probabilities in
// proportion.
class FisherNetwork {
 public:
  FisherNetwork(const CountTable& counts, const Margins& margins, std::size_t most_nodes)
      : most_nodes_(most_nodes), steps_left_(20 * static_cast<std::int64_t>(most_nodes)) {
    log_factorials_.push_back(0.0);
    for (double i = 1.0; i <= margins.total; ++i)
      log_factorials_.push_back(log_factorials_.back() + std::log(i));
    for (const double row : margins.rows) start_.push_back(static_cast<int>(row));
    std::sort(start_.begin(), start_.end());
    for (const double column : margins.columns) columns_.push_back(static_cast<int>(column));
    extremes_.resize(columns_.size());
    for (const auto& row : counts)
      for (const double count : row) observed_ -= log_factorials_[static_cast<std::size_t>(count)];
    // R's margin for tables that are as likely but for rounding.
    observed_ += 1e-7;
  }

  // The p value, or nothing when the network is too large.
  std::optional<double> p_value() {
    Nodes now = {{NodeKey{start_, 0}, Node{0.0, 1.0}}};
    double p = 0.0;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      Nodes next;
      for (const auto& [key, node] : now)
        if (!pass(key.rows, node, column, next, p)) return std::nullopt;
      now = std::move(next);
    }
    return std::min(1.0, p);
  }

 private:
  using Nodes = std::unordered_map<NodeKey, Node, NodeHash>;

  double log_factorial(int n) const { return log_factorials_[static_cast<std::size_t>(n)]; }

  // The log of the summed weight of all ways to fill the columns from this one on.
  double log_ways(const RowsLeft& rows, std::size_t column) const {
    int left = 0;
    double log_weight = 0.0;
    for (const int row : rows) {
      left += row;
      log_weight -= log_factorial(row);
    }
    for (std::size_t i = column; i < columns_.size(); ++i) log_weight -= log_factorial(columns_[i]);
    return log_weight + log_factorial(left);
  }

  // Calls visit(rows left, log weight of the column) for each way to fill one column.
  void each_column(const RowsLeft& rows, std::size_t column,
                   const std::function<void(const RowsLeft&, double)>& visit) {
    RowsLeft left = rows;
    const int in_all = std::accumulate(rows.begin(), rows.end(), 0);
    fill(left, 0, columns_[column], in_all, 0.0, visit);
  }

  // `rest` is the count that the column still needs, `later` the counts left in the rows from this one on.
  void fill(RowsLeft& left, std::size_t row, int rest, int later, double log_weight,
            const std::function<void(const RowsLeft&, double)>& visit) {
    if (steps_left_ < 0) return;
    if (row == left.size()) {
      --steps_left_;
      RowsLeft sorted = left;
      std::sort(sorted.begin(), sorted.end());
      visit(sorted, log_weight);
      return;
    }
    const int had = left[row];
    for (int given = std::max(0, rest - (later - had)); given <= std::min(had, rest); ++given) {
      left[row] = had - given;
      fill(left, row + 1, rest - given, later - had, log_weight - log_factorial(given), visit);
    }
    left[row] = had;
  }

  // The greatest and least log weight of the ways from here to the end.
  Extremes extremes(const RowsLeft& rows, std::size_t column) {
    if (column == columns_.size()) return {};
    if (column + 1 == columns_.size()) {
      double log_weight = 0.0;
      for (const int row : rows) log_weight -= log_factorial(row);
      return {log_weight, log_weight};
    }
    if (const auto known = extremes_[column].find(rows); known != extremes_[column].end())
      return known->second;
    Extremes found{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    each_column(rows, column, [&](const RowsLeft& left, double log_weight) {
      const Extremes rest = extremes(left, column + 1);
      found.greatest = std::max(found.greatest, log_weight + rest.greatest);
      found.least = std::min(found.least, log_weight + rest.least);
    });
    extremes_[column].emplace(rows, found);
    return found;
  }

  // Follows all ways from a node through one column. Returns false when there are too many.
  bool pass(const RowsLeft& rows, const Node& node, std::size_t column, Nodes& next, double& p) {
    const double all_ways = log_ways(rows, column);
    each_column(rows, column, [&](const RowsLeft& left, double log_weight) {
      const double past = node.past + log_weight;
      const Extremes rest = extremes(left, column + 1);
      if (past + rest.least > observed_) return;  // all that follow are likelier
      const double share = node.share * std::exp(log_weight + log_ways(left, column + 1) - all_ways);
      if (past + rest.greatest <= observed_) {  // none that follows is likelier
        p += share;
        return;
      }
      Node& there = next[NodeKey{left, std::llround(past * 1e9)}];
      there.past = past;
      there.share += share;
    });
    return steps_left_ >= 0 && next.size() <= most_nodes_ && known_extremes() <= most_nodes_;
  }

  std::size_t known_extremes() const {
    std::size_t known = 0;
    for (const auto& column : extremes_) known += column.size();
    return known;
  }

  std::size_t most_nodes_;
  std::int64_t steps_left_;  // ways through a column that may still be tried: bounds the time
  std::vector<double> log_factorials_;
  RowsLeft start_;
  std::vector<int> columns_;
  double observed_ = 0.0;  // log weight of the table
  std::vector<std::unordered_map<RowsLeft, Extremes, NodeHash>> extremes_;
};

// The table without empty rows and columns, with no more rows than columns.
CountTable compact_table(const CountTable& counts) {
  const Margins margins = margins_of(counts);
  CountTable kept;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (margins.rows[i] == 0.0) continue;
    kept.emplace_back();
    for (std::size_t j = 0; j < margins.columns.size(); ++j)
      if (margins.columns[j] > 0.0) kept.back().push_back(counts[i][j]);
  }
  if (kept.empty() || kept.size() <= kept.front().size()) return kept;
  CountTable turned(kept.front().size(), std::vector<double>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (std::size_t j = 0; j < kept.front().size(); ++j) turned[j][i] = kept[i][j];
  return turned;
}

}  // namespace

base::Result<double> fisher_exact_p(const CountTable& counts, std::size_t most_nodes) {
  if (auto error = table_complaint("Fisher's exact test", counts)) return tl::unexpected(*error);
  const CountTable table = compact_table(counts);
  if (table.size() < 2) return 1.0;
  const Margins margins = margins_of(table);
  const std::optional<double> p =
      margins.total <= 1e6 ? FisherNetwork(table, margins, most_nodes).p_value() : std::nullopt;
  if (p) return *p;
  return base::fail(
      fmt::format("Fisher's exact test: a table of {} x {} with {} counts is too large; ask for the "
                  "chi-squared test, or merge levels",
                  counts.size(), counts.front().size(), margins.total));
}

}  // namespace icome::stats
