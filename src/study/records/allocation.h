#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "study/definition/study.h"

namespace icome::study {

/// A variable that groups are balanced by. Its classes are its levels, or the parts of a split, by number.
struct BalancedFactor {
  std::size_t classes = 1;
  double weight = 1.0;  // above 0
};

/// A person's class in each balanced factor.
using Classes = std::vector<std::size_t>;

/// A person who is in a group already.
struct Allocated {
  Classes classes;
  std::size_t group = 0;
};

/// The plan for spreading people over groups.
struct AllocationPlan {
  std::size_t groups = 1;
  std::vector<BalancedFactor> factors;
  std::size_t most_apart = 1;  // largest difference in size of two groups while a study runs, at least 1
  std::size_t group_size = 0;  // a full group takes nobody while another is not full; 0: no limit
  std::uint64_t seed = 1;
};

/// The group of the next person by minimisation (Taves 1974; Pocock and Simon 1975): the one with which the
/// groups differ least, as the weighted sum over the factors of the largest difference between groups in the
/// number of people of this person's class. Groups that would grow too far above the smallest are left out;
/// of equally good ones the smallest is taken, and of equally small ones one drawn by the seed and the
/// number of people so far. The same people in the same order thus always get the same groups.
///
/// `person` and those already there have a class for each factor of the plan.
std::size_t allocate(const AllocationPlan& plan, const std::vector<Allocated>& already,
                     const Classes& person);

/// The plan for the groups of a study and its balanced control variables.
AllocationPlan allocation_plan(const Study& study);

/// A person's class in each balanced control variable, from the answers to all control variables in their
/// order: level ids, or numbers. Fails, naming the variable, on an unknown level and on text that is not a
/// number.
base::Result<Classes> classes_of(const Study& study, const std::vector<std::string>& answers);

}  // namespace icome::study
