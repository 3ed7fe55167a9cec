#pragma once
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "speech/grammar/pattern.h"

namespace icome::speech {

/// The rule that matches any one to three words; in JSGF it is the rule kSuggestedWords.
inline constexpr std::string_view kAnyWords = "words";
inline constexpr std::string_view kSuggestedWords = "new-word";

/// A part of a sentence as a rule matched it, with what the rules in it matched. A plain value.
struct Phrase {
  std::string rule = {};
  std::vector<std::string> tags = {};  // of this rule, in the order of the words
  std::vector<Phrase> parts = {};
  std::size_t begin = 0, end = 0;  // words of the sentence, from 0; end is behind the last

  bool operator==(const Phrase&) const = default;
  bool has(std::string_view tag) const;
  /// The first tag; empty where there is none.
  std::string tag() const { return tags.empty() ? std::string() : tags.front(); }
  /// The first part of that rule, looked for at all depths, depth first; null where there is none.
  const Phrase* find(std::string_view rule) const;
  /// The first direct part of that rule; null where there is none.
  const Phrase* part(std::string_view rule) const;
  /// All direct parts of that rule.
  std::vector<const Phrase*> all(std::string_view rule) const;
};

/// Named patterns of sentences. The same rules make the parser, the grammar of the recogniser (JSGF) and
/// the list of what can be said, so these cannot differ. A plain value.
class Grammar {
 public:
  void set(const std::string& rule, Pattern pattern) { rules_[rule] = std::move(pattern); }
  /// Null where there is no such rule. Valid until the rule is set again.
  const Pattern* find(std::string_view rule) const;
  const std::map<std::string, Pattern, std::less<>>& rules() const { return rules_; }

  /// Fails where `rule` refers, at any depth, to a rule that is missing, or to itself: the recogniser needs
  /// sentences with an end.
  base::Result<void> check(std::string_view rule) const;

  /// As SentenceParser::readings().
  std::vector<Phrase> parse(std::string_view rule, std::span<const std::string> words) const;

  /// The words of which some sentence of the rule consists.
  std::set<std::string> vocabulary(std::string_view rule) const;

  /// The rule with all that it refers to, as a JSGF grammar of that name. Rules that have no words are left
  /// out wherever they may be.
  std::string jsgf(std::string_view rule, std::string_view name) const;

 private:
  std::map<std::string, Pattern, std::less<>> rules_;
};

/// Finds how rules match one sentence; what it has found of a rule serves all that refer to it. Refers to the
/// grammar and the words.
class SentenceParser {
 public:
  SentenceParser(const Grammar& grammar, std::span<const std::string> words)
      : grammar_(grammar), words_(words) {}

  /// The different ways in which the rule matches all of the words, in the order of its alternatives; at most
  /// kMostReadings. Precondition: Grammar::check(rule).
  std::vector<Phrase> readings(std::string_view rule);
  static constexpr std::size_t kMostReadings = 16;

 private:
  /// A way in which a pattern matches words from a place on.
  struct Match {
    std::size_t end = 0;
    std::vector<std::string> tags = {};
    std::vector<Phrase> parts = {};

    bool operator==(const Match&) const = default;
  };
  using Matches = std::vector<Match>;

  const Matches& rule_at(const std::string& rule, std::size_t begin);
  Matches any_words(std::size_t begin) const;
  Matches match(const Pattern& pattern, std::size_t begin);
  Matches choice(const Pattern& pattern, std::size_t begin);
  Matches sequence(const Pattern& pattern, std::size_t begin);
  static Match joined(const Match& before, Match next);
  static void add(Matches& matches, Match match);

  const Grammar& grammar_;
  std::span<const std::string> words_;
  std::map<std::string, std::map<std::size_t, Matches>, std::less<>> known_;
};

}  // namespace icome::speech
