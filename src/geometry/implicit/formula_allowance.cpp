#include "geometry/implicit/formula_allowance.h"

#include <algorithm>
#include <limits>

namespace icome::geometry {
namespace {

thread_local std::uint64_t evaluations_so_far = 0;
thread_local std::uint64_t evaluations_allowed = std::numeric_limits<std::uint64_t>::max();

}  // namespace

FormulaAllowance::FormulaAllowance(std::uint64_t evaluations) : before_(evaluations_allowed) {
  evaluations_allowed = std::min(before_, evaluations_so_far + evaluations);
}

FormulaAllowance::~FormulaAllowance() { evaluations_allowed = before_; }

void FormulaAllowance::count(std::uint64_t evaluations) { evaluations_so_far += evaluations; }

bool FormulaAllowance::spent() { return evaluations_so_far >= evaluations_allowed; }

std::uint64_t FormulaAllowance::counted() { return evaluations_so_far; }

}  // namespace icome::geometry
