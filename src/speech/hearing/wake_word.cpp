#include "speech/hearing/wake_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ranges>

#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

Pattern choice_of(std::vector<Pattern> parts) { return {Pattern::Kind::Choice, {}, std::move(parts)}; }
Pattern rule_pattern(std::string_view rule) { return {Pattern::Kind::Rule, std::string(rule), {}}; }

}  // namespace

base::Result<WakeWord> WakeWord::of(std::string_view words) {
  std::vector<std::string> spoken = spoken_words(words);
  constexpr std::size_t kMost = 3;
  const bool has_letters = std::ranges::all_of(
      words, [](char sign) { return std::isalpha(static_cast<unsigned char>(sign)) != 0 || sign == ' '; });
  if (!has_letters || spoken.empty() || spoken.size() > kMost)
    return base::fail(
        fmt::format("'{}' is no word to call by: it takes one to three words of letters", words));
  return WakeWord(std::move(spoken));
}

std::string WakeWord::text() const { return joined_words(words_); }

Grammar WakeWord::with_word(const Grammar& grammar, const HeardRules& rules) const {
  Grammar with = grammar;
  std::vector<Pattern> called;
  for (const std::string& word : words_) called.push_back(word_pattern(word));
  const auto may_come_before = [&](std::string_view rule) {
    std::vector<Pattern> before = called;
    before.push_back(rule_pattern(rule));
    return choice_of({sequence_of(std::move(before)), rule_pattern(rule), sequence_of(called)});
  };
  with.set(std::string(kRules.sentence), may_come_before(rules.sentence));
  if (grammar.find(rules.usual) != nullptr) with.set(std::string(kRules.usual), may_come_before(rules.usual));
  return with;
}

bool WakeWord::begins(const Heard& heard) const {
  return heard.words.size() >= words_.size() &&
         std::ranges::equal(words_, heard.words | std::views::take(words_.size()), {}, {}, &HeardWord::word);
}

WakeWord::Meant WakeWord::meant(std::vector<Heard> heard, double begin, double end) {
  Meant meant;
  // The likeliest tells for all: others have the word for the sake of the grammar.
  const bool is_addressed = !heard.empty() && begins(heard.front());
  meant.is_meant = is_addressed || is_awake(begin);
  if (!meant.is_meant) return meant;
  if (is_addressed && heard.front().words.size() == words_.size()) {
    meant.is_called = true;
    stay_awake(end);
    return meant;
  }
  for (Heard& one : heard) {
    if (begins(one) != is_addressed) continue;
    if (is_addressed) one.words.erase(one.words.begin(), one.words.begin() + std::ptrdiff_t(words_.size()));
    if (!one.words.empty()) meant.sentences.push_back(std::move(one));
  }
  return meant;
}

}  // namespace icome::speech
