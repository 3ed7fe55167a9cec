#pragma once
#include <cstdint>

namespace icome::geometry {

/// While it lives, walks and sweeps over surfaces of formulas on this thread end with a safe answer once they
/// have cost that many evaluations of formulas: a walk where it is, a sweep at what is surely free. One
/// within another allows no more than that does. What is counted does not depend on the machine, so replays
/// agree bit for bit. Real-time safe.
class FormulaAllowance {
 public:
  explicit FormulaAllowance(std::uint64_t evaluations);
  ~FormulaAllowance();
  FormulaAllowance(const FormulaAllowance&) = delete;
  FormulaAllowance& operator=(const FormulaAllowance&) = delete;

  /// Counts this many evaluations; one on intervals takes the time of eight.
  static void count(std::uint64_t evaluations);
  /// Has this thread used up what it was allowed?
  static bool spent();
  /// All that this thread has counted.
  static std::uint64_t counted();

 private:
  std::uint64_t before_;
};

}  // namespace icome::geometry
