#include "study/definition/spoken_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/parse_number.h"
#include "speech/hearing/word_sounds.h"
#include "speech/words/spoken_words.h"

namespace icome::study {
namespace {

using speech::Pattern;

constexpr const char* kThing = "thing";

std::vector<std::string> words_of_thing(const TrialGoal& goal, const Thing& thing) {
  if (thing.widget == nullptr) return speech::spoken_words(thing.name);
  const auto& written = thing.widget->text;
  const std::size_t language = goal.element->language;
  return speech::spoken_words(language < written.size() ? written[language] : thing.widget->name);
}

/// Has the word sounds? Letters of English have; of others, and of signs, the rules tell.
bool has_sounds(const std::string& word) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  return std::ranges::any_of(word, is_letter) || !speech::sounds_of_word(word).empty();
}

}  // namespace

int SpokenChoices::chosen(const std::vector<std::string>& words) const {
  const auto readings = grammar.parse(kSentence, words);
  return readings.empty() ? -1 : base::parse_number<int>(readings.front().part(kThing)->tag()).value_or(-1);
}

base::Result<SpokenChoices> spoken_choices(const TrialGoal& goal) {
  Pattern things{Pattern::Kind::Choice, {}, {}};
  std::map<std::vector<std::string>, const Thing*> known;
  for (std::size_t i = 0; i < goal.things.size(); ++i) {
    const Thing& thing = goal.things[i];
    if (!thing.target && !thing.wrong) continue;
    const std::vector<std::string> words = words_of_thing(goal, thing);
    if (thing.target && (words.empty() || !std::ranges::all_of(words, has_sounds)))
      return base::fail(fmt::format("'{}' is the target, and has no name that can be said.", thing.name));
    if (words.empty()) continue;
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
  SpokenChoices choices;
  choices.grammar.set(kThing, std::move(things));
  choices.grammar.set(SpokenChoices::kSentence,
                      *speech::pattern_from_text("[select | choose | take | touch] [the] <thing>"));
  return choices;
}

}  // namespace icome::study
