#pragma once
#include <cstdint>

namespace icome::geometry {

/// While it lives, walks and sweeps over surfaces of formulas on this thread end with a safe answer once they
/// have cost that many evaluations of formulas: a walk at its current place, a sweep at one that is surely
/// free. An allowance within another allows no more than the outer one. The count does not depend on the
/// machine, so replays agree bit for bit. Real-time safe.
class FormulaAllowance {
 public:
  explicit FormulaAllowance(std::uint64_t evaluations);
  ~FormulaAllowance();
  FormulaAllowance(const FormulaAllowance&) = delete;
  FormulaAllowance& operator=(const FormulaAllowance&) = delete;

  /// Counts this many evaluations; one on intervals takes the time of eight.
  static void count(std::uint64_t evaluations);
  /// Has this thread used up its allowance?
  static bool spent();
  /// All evaluations that this thread has counted.
  static std::uint64_t counted();

 private:
  std::uint64_t before_;
};

}  // namespace icome::geometry
