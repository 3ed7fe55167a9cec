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

UnderstoodUtterance understand_utterance(Dialogue& dialogue, const std::vector<Heard>& heard, double begin,
                                         double end, const HearingLimits& limits) {
  dialogue.vocabulary();  // brings up to date what can be said
  UnderstoodUtterance understood;
  if (const Heard* const meant = likely_meant(heard, dialogue, limits)) {
    WordTimes times{.now = end};
    for (const HeardWord& word : meant->words) times.words.push_back(begin + word.begin);
    understood.answer = dialogue.hear(meant->sentence(), times);
    understood.heard = *meant;
    return understood;
  }
  if (!heard.empty()) understood.heard = heard.front();
  understood.answer.reply = "That was no sentence that I know.";
  if (understood.heard) understood.answer.heard = understood.heard->sentence();
  return understood;
}

}  // namespace icome::speech
