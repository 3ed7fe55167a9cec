#include "speech/hearing/language_model.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace icome::speech {
namespace {

/// Recognisers take it for "never".
constexpr double kNever = -99.0;

double log10_of(double probability) { return probability > 0.0 ? std::log10(probability) : kNever; }

}  // namespace

double LanguageModel::Followers::share(std::string_view word) const {
  const auto found = counts.find(word);
  return found == counts.end() ? 0.0 : (1.0 - rest()) * found->second / sum;
}

LanguageModel::LanguageModel(std::span<const Sentence> sentences, const std::set<std::string>& words) {
  const auto add = [](Followers& to, const std::string& word) {
    to.counts[word] += 1.0;
    to.sum += 1.0;
  };
  const std::string begin(kBegin);
  for (const Sentence& sentence : sentences) {
    std::string before, last = begin;
    const auto take = [&](const std::string& word) {
      if (before.empty())
        add(after_word_[last], word);
      else
        add(after_two_[{before, last}], word);
      before = std::exchange(last, word);
    };
    for (const std::string& word : sentence) take(word);
    take(std::string(kEnd));
  }
  // As a follower of fewer words, a word counts once for each place that it was in: one that is
  // often said, but only by itself, is unlikely after all others.
  for (const auto& [two, followers] : after_two_)
    for (const auto& [word, count] : followers.counts) add(after_word_[two.second], word);
  for (const auto& [last, followers] : after_word_)
    for (const auto& [word, count] : followers.counts) add(words_, word);
  for (const std::string& word : words)
    if (!words_.counts.contains(word)) add(words_, word);
}

double LanguageModel::alone(std::string_view word) const {
  const auto found = words_.counts.find(word);
  return found == words_.counts.end() ? 0.0 : found->second / words_.sum;
}

double LanguageModel::after(const std::string& last, std::string_view word) const {
  const auto seen = after_word_.find(last);
  if (seen == after_word_.end()) return alone(word);
  return seen->second.share(word) + seen->second.rest() * alone(word);
}

double LanguageModel::probability(std::span<const std::string> before, std::string_view word) const {
  if (before.empty()) return alone(word);
  const std::string& last = before.back();
  if (before.size() == 1) return after(last, word);
  const auto seen = after_two_.find({before[before.size() - 2], last});
  if (seen == after_two_.end()) return after(last, word);
  return seen->second.share(word) + seen->second.rest() * after(last, word);
}

std::string LanguageModel::arpa() const {
  std::size_t pairs = 0, triples = 0;
  for (const auto& [word, followers] : after_word_) pairs += followers.counts.size();
  for (const auto& [words, followers] : after_two_) triples += followers.counts.size();
  std::string text =
      fmt::format("\\data\\\nngram 1={}\nngram 2={}\nngram 3={}\n", words_.counts.size() + 1, pairs, triples);
  const auto out = std::back_inserter(text);
  const auto rest_of = [](const auto& all, const auto& key) {
    const auto found = all.find(key);
    return log10_of(found == all.end() ? 1.0 : found->second.rest());
  };
  fmt::format_to(out, "\n\\1-grams:\n{} {} {:.4f}\n", kNever, kBegin, rest_of(after_word_, kBegin));
  for (const auto& [word, count] : words_.counts)
    fmt::format_to(out, "{:.4f} {} {:.4f}\n", log10_of(alone(word)), word, rest_of(after_word_, word));
  fmt::format_to(out, "\n\\2-grams:\n");
  for (const auto& [last, followers] : after_word_)
    for (const auto& [word, count] : followers.counts)
      fmt::format_to(out, "{:.4f} {} {} {:.4f}\n", log10_of(after(last, word)), last, word,
                     rest_of(after_two_, std::pair(last, word)));
  fmt::format_to(out, "\n\\3-grams:\n");
  for (const auto& [words, followers] : after_two_)
    for (const auto& [word, count] : followers.counts)
      fmt::format_to(out, "{:.4f} {} {} {}\n",
                     log10_of(probability(std::vector{words.first, words.second}, word)), words.first,
                     words.second, word);
  return text + "\n\\end\\\n";
}

}  // namespace icome::speech
