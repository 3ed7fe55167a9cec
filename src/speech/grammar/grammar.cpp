#include "speech/grammar/grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr std::size_t kMostAnyWords = 3;

/// Visits a pattern with all that it refers to, each rule once.
template <typename Visit>
void visit_all(const Grammar& grammar, const Pattern& pattern, std::set<std::string>& seen,
               const Visit& visit) {
  visit(pattern);
  for (const Pattern& part : pattern.parts) visit_all(grammar, part, seen, visit);
  if (pattern.kind != Pattern::Kind::Rule) return;
  const std::string& rule = pattern.text == kAnyWords ? std::string(kSuggestedWords) : pattern.text;
  const Pattern* inner = grammar.find(rule);
  if (inner != nullptr && seen.insert(rule).second) visit_all(grammar, *inner, seen, visit);
}

class RuleChecker {
 public:
  explicit RuleChecker(const Grammar& grammar) : grammar_(grammar) {}

  Result<void> check(const std::string& rule) {
    if (rule == kAnyWords || good_.contains(rule)) return {};
    const Pattern* pattern = grammar_.find(rule);
    if (pattern == nullptr) return fail(fmt::format("there is no rule <{}>", rule));
    if (!inside_.insert(rule).second)
      return fail(fmt::format("the rule <{}> refers to itself, so its sentences have no end", rule));
    if (auto good = check(*pattern); !good) return good;
    inside_.erase(rule);
    good_.insert(rule);
    return {};
  }

 private:
  Result<void> check(const Pattern& pattern) {
    if (pattern.kind == Pattern::Kind::Rule) return check(pattern.text);
    for (const Pattern& part : pattern.parts)
      if (auto good = check(part); !good) return good;
    return {};
  }

  const Grammar& grammar_;
  std::set<std::string> inside_, good_;
};

/// Writes patterns as JSGF; a pattern that nothing can match is nothing.
class JsgfWriter {
 public:
  explicit JsgfWriter(const Grammar& grammar) : grammar_(grammar) {}

  std::optional<std::string> written(const Pattern& pattern) {
    switch (pattern.kind) {
      case Pattern::Kind::Word:
        return pattern.text;
      case Pattern::Kind::Rule:
        return written_rule(pattern.text == kAnyWords ? std::string(kSuggestedWords) : pattern.text);
      case Pattern::Kind::Tag:
        return std::string();
      case Pattern::Kind::Sequence:
        return sequence(pattern);
      case Pattern::Kind::Choice:
        return choice(pattern);
      case Pattern::Kind::Optional:
        break;
    }
    const auto inner = written(pattern.parts.front());
    return inner && !inner->empty() ? fmt::format("[{}]", *inner) : std::string();
  }

  /// The definitions of all rules that were referred to; the main one is public.
  std::string definitions(std::string_view main) const {
    std::string text;
    for (const auto& [rule, body] : rules_)
      if (body && !body->empty())
        text += fmt::format("{}<{}> = {};\n", rule == main ? "public " : "", rule, *body);
    return text;
  }

 private:
  std::optional<std::string> written_rule(const std::string& rule) {
    const auto [known, is_new] = rules_.try_emplace(rule);
    if (is_new) {
      const Pattern* pattern = grammar_.find(rule);
      // Not by `known`: rules below make the table longer.
      std::optional<std::string> body = pattern ? written(*pattern) : std::nullopt;
      rules_[rule] = body;
    }
    const auto& body = rules_[rule];
    if (!body) return std::nullopt;
    return body->empty() ? std::string() : fmt::format("<{}>", rule);
  }

  std::optional<std::string> sequence(const Pattern& pattern) {
    std::string text;
    for (const Pattern& part : pattern.parts) {
      const auto one = written(part);
      if (!one) return std::nullopt;
      if (!one->empty()) text.append(text.empty() ? "" : " ").append(*one);
    }
    return text;
  }

  std::optional<std::string> choice(const Pattern& pattern) {
    std::vector<std::string> ways;
    for (const Pattern& part : pattern.parts)
      if (const auto one = written(part); one && !one->empty()) ways.push_back(*one);
    if (ways.empty()) return std::nullopt;
    return ways.size() == 1 ? ways.front() : fmt::format("({})", fmt::join(ways, " | "));
  }

  const Grammar& grammar_;
  std::map<std::string, std::optional<std::string>> rules_;
};

}  // namespace

// ---- Parsing ----------------------------------------------------------------------------------------------

std::vector<Phrase> SentenceParser::readings(std::string_view rule) {
  std::vector<Phrase> readings;
  for (const Match& match : rule_at(std::string(rule), 0))
    if (match.end == words_.size() && readings.size() < kMostReadings)
      readings.push_back(match.parts.front());
  return readings;
}

const SentenceParser::Matches& SentenceParser::rule_at(const std::string& rule, std::size_t begin) {
  const auto known = known_.find(rule);
  if (known != known_.end())
    if (const auto found = known->second.find(begin); found != known->second.end()) return found->second;
  Matches matches;
  if (rule == kAnyWords) {
    matches = any_words(begin);
  } else if (const Pattern* pattern = grammar_.find(rule)) {
    for (Match& inner : match(*pattern, begin)) {
      Match outer{inner.end};
      outer.parts.push_back({rule, std::move(inner.tags), std::move(inner.parts), begin, inner.end});
      matches.push_back(std::move(outer));
    }
  }
  return known_[rule][begin] = std::move(matches);
}

SentenceParser::Matches SentenceParser::any_words(std::size_t begin) const {
  Matches matches;
  std::string text;
  for (std::size_t end = begin + 1; end <= std::min(words_.size(), begin + kMostAnyWords); ++end) {
    text.append(text.empty() ? "" : " ").append(words_[end - 1]);
    Match match{end};
    match.parts.push_back({std::string(kAnyWords), {text}, {}, begin, end});
    matches.push_back(std::move(match));
  }
  return matches;
}

SentenceParser::Matches SentenceParser::match(const Pattern& pattern, std::size_t begin) {
  switch (pattern.kind) {
    case Pattern::Kind::Word:
      if (begin < words_.size() && words_[begin] == pattern.text) return {{begin + 1}};
      return {};
    case Pattern::Kind::Rule:
      return rule_at(pattern.text, begin);
    case Pattern::Kind::Tag:
      return {{begin, {pattern.text}}};
    case Pattern::Kind::Sequence:
      return sequence(pattern, begin);
    case Pattern::Kind::Choice:
      return choice(pattern, begin);
    case Pattern::Kind::Optional:
      break;
  }
  Matches matches = match(pattern.parts.front(), begin);
  add(matches, {begin});
  return matches;
}

SentenceParser::Matches SentenceParser::choice(const Pattern& pattern, std::size_t begin) {
  Matches matches;
  for (const Pattern& part : pattern.parts)
    for (Match& one : match(part, begin)) add(matches, std::move(one));
  return matches;
}

SentenceParser::Matches SentenceParser::sequence(const Pattern& pattern, std::size_t begin) {
  Matches matches{{begin}};
  for (const Pattern& part : pattern.parts) {
    Matches longer;
    for (const Match& before : matches)
      for (Match& next : match(part, before.end)) add(longer, joined(before, std::move(next)));
    matches = std::move(longer);
    if (matches.empty()) break;
  }
  return matches;
}

SentenceParser::Match SentenceParser::joined(const Match& before, Match next) {
  Match both = before;
  both.end = next.end;
  std::ranges::move(next.tags, std::back_inserter(both.tags));
  std::ranges::move(next.parts, std::back_inserter(both.parts));
  return both;
}

void SentenceParser::add(Matches& matches, Match match) {
  constexpr std::size_t kMostMatches = 64;
  if (matches.size() < kMostMatches && std::ranges::find(matches, match) == matches.end())
    matches.push_back(std::move(match));
}

// ---- Phrases and grammars ---------------------------------------------------------------------------------

bool Phrase::has(std::string_view tag) const { return std::ranges::find(tags, tag) != tags.end(); }

const Phrase* Phrase::find(std::string_view wanted) const {
  for (const Phrase& part : parts) {
    if (part.rule == wanted) return &part;
    if (const Phrase* found = part.find(wanted)) return found;
  }
  return nullptr;
}

const Phrase* Phrase::part(std::string_view wanted) const {
  const auto found = std::ranges::find(parts, wanted, &Phrase::rule);
  return found == parts.end() ? nullptr : &*found;
}

std::vector<const Phrase*> Phrase::all(std::string_view wanted) const {
  std::vector<const Phrase*> found;
  for (const Phrase& part : parts)
    if (part.rule == wanted) found.push_back(&part);
  return found;
}

const Pattern* Grammar::find(std::string_view rule) const {
  const auto found = rules_.find(rule);
  return found == rules_.end() ? nullptr : &found->second;
}

Result<void> Grammar::check(std::string_view rule) const {
  return RuleChecker(*this).check(std::string(rule));
}

std::vector<Phrase> Grammar::parse(std::string_view rule, std::span<const std::string> words) const {
  return SentenceParser(*this, words).readings(rule);
}

std::set<std::string> Grammar::vocabulary(std::string_view rule) const {
  std::set<std::string> words, seen;
  const auto visit = [&](const Pattern& pattern) {
    if (pattern.kind == Pattern::Kind::Word) words.insert(pattern.text);
  };
  visit_all(*this, {Pattern::Kind::Rule, std::string(rule), {}}, seen, visit);
  return words;
}

std::string Grammar::jsgf(std::string_view rule, std::string_view name) const {
  JsgfWriter writer(*this);
  writer.written({Pattern::Kind::Rule, std::string(rule), {}});
  return fmt::format("#JSGF V1.0 UTF-8;\ngrammar {};\n{}", name, writer.definitions(rule));
}

}  // namespace icome::speech
