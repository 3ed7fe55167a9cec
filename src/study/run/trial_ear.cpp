#include "study/run/trial_ear.h"

#include <fmt/format.h>

#include <map>

#include "base/parse_number.h"
#include "speech/hearing/likely_meant.h"
#include "speech/words/spoken_words.h"

namespace icome::study {
namespace {

using speech::Pattern;

constexpr const char* kChoice = "choice";
constexpr const char* kThing = "thing";

}  // namespace

std::vector<std::string> words_of_thing(const TrialGoal& goal, const Thing& thing) {
  if (thing.widget == nullptr) return speech::spoken_words(thing.name);
  const auto& written = thing.widget->text;
  const std::size_t language = goal.element->language;
  return speech::spoken_words(language < written.size() ? written[language] : thing.widget->name);
}

TrialEar::TrialEar(speech::OpenSource source, speech::Ear::MakeRecogniser make)
    : ear_(std::move(source), std::move(make)) {}

base::Result<void> TrialEar::expect(const TrialGoal& goal) {
  Pattern things{Pattern::Kind::Choice, {}, {}};
  std::map<std::vector<std::string>, const Thing*> known;
  for (std::size_t i = 0; i < goal.things.size(); ++i) {
    const Thing& thing = goal.things[i];
    const std::vector<std::string> words = words_of_thing(goal, thing);
    if ((!thing.target && !thing.wrong) || words.empty()) continue;
    const auto [same, is_new] = known.emplace(words, &thing);
    if (!is_new && same->second->target != thing.target)
      return base::fail(
          fmt::format("'{}' and '{}' sound alike, and only one of them is the target of the trial.",
                      same->second->name, thing.name));
    if (!is_new) continue;
    std::vector<Pattern> parts;
    for (const std::string& word : words) parts.push_back(speech::word_pattern(word));
    parts.push_back(speech::tag_pattern(std::to_string(i)));
    things.parts.push_back(speech::sequence_of(std::move(parts)));
  }
  if (things.parts.empty()) return base::fail("nothing in this trial has a name that can be said.");
  grammar_ = {};
  grammar_.set(kThing, std::move(things));
  grammar_.set(kChoice, *speech::pattern_from_text("[select | choose | take | touch] [the] <thing>"));
  ear_.take();  // of another trial
  ear_.expect(grammar_, kChoice, kChoice);
  expects_ = true;
  return {};
}

bool TrialEar::is_ready() const {
  using Doing = speech::EarState::Doing;
  const Doing doing = ear_.state().doing;
  return expects_ && (doing == Doing::Listening || doing == Doing::Hearing || doing == Doing::Understanding);
}

std::vector<SaidInTrial> TrialEar::take() {
  std::vector<SaidInTrial> all;
  for (const speech::HeardUtterance& utterance : ear_.take())
    if (!utterance.sentences.empty()) all.push_back(understood(utterance));
  return all;
}

SaidInTrial TrialEar::understood(const speech::HeardUtterance& utterance) const {
  const speech::HearingLimits limits;
  const speech::Heard& likeliest = utterance.sentences.front();
  SaidInTrial said{utterance.begin + likeliest.words.front().begin, utterance.end, likeliest.sentence(),
                   likeliest.score};
  if (likeliest.score < limits.least_score || likeliest.behind > limits.most_behind) return said;
  const auto readings = grammar_.parse(kChoice, speech::spoken_words(said.heard));
  if (!readings.empty())
    said.thing = base::parse_number<int>(readings.front().part(kThing)->tag()).value_or(-1);
  return said;
}

}  // namespace icome::study
