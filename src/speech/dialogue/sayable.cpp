#include "speech/dialogue/sayable.h"

#include <algorithm>

#include "speech/grammar/sentence_sampler.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

constexpr std::size_t kMostOfForm = 3;  // sentences
constexpr std::size_t kMostTried = 40;  // of each form
constexpr std::size_t kMostShown = 9;   // words; longer ones teach less

/// Sentences of a form that can be said now.
void add_sentences(Dialogue& dialogue, const Grammar& grammar, const Pattern& form, base::Random& random,
                   std::vector<std::string>& all) {
  std::size_t found = 0;
  for (std::size_t tried = 0; tried < kMostTried && found < kMostOfForm; ++tried) {
    const auto words = sample_sentence(grammar, form, random);
    if (!words) return;
    if (words->size() > kMostShown) continue;
    std::string sentence = joined_words(*words);
    if (std::ranges::find(all, sentence) != all.end() || !dialogue.can_be_said(sentence)) continue;
    all.push_back(std::move(sentence));
    ++found;
  }
}

}  // namespace

std::vector<Sayable> sayable_now(Dialogue& dialogue) {
  constexpr std::uint64_t kSeed = 7;
  base::Random random(kSeed);
  std::vector<Sayable> all;
  const Vocabulary vocabulary = dialogue.vocabulary();
  for (const Command& command : vocabulary.commands) {
    Sayable sayable{command.name, command.help, command.say, {}};
    const Pattern& forms = *vocabulary.grammar.find(command.rule);
    for (const Pattern& form : forms.parts)
      add_sentences(dialogue, vocabulary.grammar, form, random, sayable.sentences);
    if (!sayable.sentences.empty()) all.push_back(std::move(sayable));
  }
  return all;
}

}  // namespace icome::speech
