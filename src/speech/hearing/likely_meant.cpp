#include "speech/hearing/likely_meant.h"

namespace icome::speech {

const Heard* likely_meant(const std::vector<Heard>& heard, Dialogue& dialogue, const HearingLimits& limits) {
  const Heard* best = nullptr;
  double best_cost = 0.0;
  for (const Heard& one : heard) {
    if (one.score < limits.least_score || one.behind > limits.most_behind) continue;
    if (best != nullptr && one.behind >= best_cost) break;  // those that follow are less likely still
    const double cost = one.behind + (dialogue.can_be_said(one.sentence()) ? 0.0 : limits.impossible);
    if (best != nullptr && cost >= best_cost) continue;
    best = &one;
    best_cost = cost;
  }
  return best;
}

}  // namespace icome::speech
