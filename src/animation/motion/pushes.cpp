#include "animation/motion/pushes.h"

#include <algorithm>
#include <cmath>

#include "animation/motion/small_system.h"

namespace icome::animation {
namespace {

constexpr int kBlockRounds = 4;  // that may pass without fewer rows being wrong
constexpr int kMostRounds = 40;
constexpr double kNoExcess = 1e-9;  // px, and a share of the largest push

/// Pushes of the rows that push, 0 of others.
std::vector<double> solve_pushing(std::span<const double> matrix, std::span<const PushRow> rows,
                                  const std::vector<char>& pushing) {
  std::vector<std::size_t> taken;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (pushing[k]) taken.push_back(k);
  const std::size_t n = taken.size();
  std::vector<double> part(n * n), values(n);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) part[a * n + b] = matrix[taken[a] * rows.size() + taken[b]];
    values[a] = -rows[taken[a]].excess;
  }
  solve_symmetric(part, values);
  std::vector<double> pushes(rows.size(), 0);
  for (std::size_t a = 0; a < n; ++a) pushes[taken[a]] = values[a];
  return pushes;
}

}  // namespace

std::vector<double> pushes_of(std::span<const double> matrix, std::span<const PushRow> rows) {
  const std::size_t count = rows.size();
  std::vector<char> pushing(count);
  for (std::size_t k = 0; k < count; ++k)
    pushing[k] = rows[k].moves && (rows[k].is_even || rows[k].excess > 0);
  std::size_t fewest = count + 1;
  int patience = kBlockRounds;
  std::vector<double> pushes;
  for (int round = 0; round < kMostRounds; ++round) {
    pushes = solve_pushing(matrix, rows, pushing);
    double largest = 0;
    for (const double push : pushes) largest = std::max(largest, std::abs(push));
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < count; ++k) {
      if (!rows[k].moves || rows[k].is_even) continue;
      if (pushing[k]) {
        if (pushes[k] > kNoExcess * largest) wrong.push_back(k);
        continue;
      }
      double left = rows[k].excess;
      for (std::size_t j = 0; j < count; ++j) left += matrix[k * count + j] * pushes[j];
      if (left > kNoExcess * (1 + largest)) wrong.push_back(k);
    }
    if (wrong.empty()) return pushes;
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      patience = kBlockRounds;
    } else if (patience > 0) {
      --patience;
    }
    if (patience == 0) wrong = {wrong.back()};
    for (const std::size_t k : wrong) pushing[k] = !pushing[k];
  }
  for (std::size_t k = 0; k < count; ++k)
    if (!rows[k].is_even) pushes[k] = std::min(pushes[k], 0.0);
  return pushes;
}

}  // namespace icome::animation
