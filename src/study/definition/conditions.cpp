#include "study/definition/conditions.h"

namespace icome::study {

std::vector<const IndependentVariable*> factors_of(const Study& study, bool between) {
  std::vector<const IndependentVariable*> factors;
  for (const IndependentVariable& factor : study.independent)
    if (factor.between == between) factors.push_back(&factor);
  return factors;
}

std::vector<Crossing> crossings(const Study& study, bool between) {
  std::vector<Crossing> all = {{}};
  for (const IndependentVariable* const factor : factors_of(study, between)) {
    std::vector<Crossing> longer;
    for (const Crossing& crossing : all) {
      for (std::size_t level = 0; level < factor->levels.size(); ++level) {
        longer.push_back(crossing);
        longer.back().push_back(level);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::size_t crossing_count(const Study& study, bool between, std::size_t limit) {
  std::size_t count = 1;
  for (const IndependentVariable* const factor : factors_of(study, between)) {
    if (factor->levels.size() > limit / count) return limit + 1;
    count *= factor->levels.size();
  }
  return count;
}

std::string crossing_name(const Study& study, bool between, const Crossing& crossing) {
  const auto factors = factors_of(study, between);
  std::string name;
  for (std::size_t i = 0; i < crossing.size(); ++i)
    name.append(i == 0 ? "" : ", ").append(factors[i]->levels[crossing[i]].id);
  return crossing.empty() ? std::string("all") : name;
}

}  // namespace icome::study
