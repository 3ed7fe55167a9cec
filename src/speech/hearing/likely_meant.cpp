#include "speech/hearing/likely_meant.h"

#include <utility>

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

namespace {

/// The answer that follows from the wake word alone; none: it is a sentence for the dialogue, which is left
/// in `heard`.
std::optional<UnderstoodUtterance> answer_of(WakeWord& wake_word, const HearingLimits& limits,
                                             std::vector<Heard>& heard, double begin, double end) {
  UnderstoodUtterance understood;
  if (!heard.empty()) understood.heard = heard.front();
  if (understood.heard) understood.answer.heard = understood.heard->sentence();
  std::erase_if(heard, [&](const Heard& one) { return one.score < limits.least_score; });
  WakeWord::Meant meant = wake_word.meant(std::move(heard), begin, end);
  heard = std::move(meant.sentences);
  if (meant.is_meant && !meant.is_called) return std::nullopt;
  understood.is_addressed = meant.is_meant;
  if (meant.is_called) {
    understood.answer.state = Answer::State::Asked;
    understood.answer.reply = "Yes?";
  } else {
    understood.answer.reply = "That was not said to me: begin with \"" + wake_word.text() + "\".";
  }
  return understood;
}

}  // namespace

UnderstoodUtterance understand_utterance(Dialogue& dialogue, std::vector<Heard> heard, double begin,
                                         double end, const HearingLimits& limits, WakeWord* wake_word) {
  if (wake_word != nullptr)
    if (auto answer = answer_of(*wake_word, limits, heard, begin, end)) return std::move(*answer);
  dialogue.vocabulary();  // brings up to date what can be said
  UnderstoodUtterance understood;
  if (const Heard* const meant = likely_meant(heard, dialogue, limits)) {
    WordTimes times{.now = end};
    for (const HeardWord& word : meant->words) times.words.push_back(begin + word.begin);
    understood.answer = dialogue.hear(meant->sentence(), times);
    understood.heard = *meant;
    // One sentence for each call; what is asked back is answered without the word.
    if (wake_word != nullptr) dialogue.asks() ? wake_word->stay_awake(end) : wake_word->fall_asleep();
    return understood;
  }
  if (!heard.empty()) understood.heard = heard.front();
  understood.answer.reply = "That was no sentence that I know.";
  if (understood.heard) understood.answer.heard = understood.heard->sentence();
  return understood;
}

}  // namespace icome::speech
