#include "speech/grammar/pattern.h"

#include <fmt/format.h>

#include <utility>

#include "base/shown_text.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr std::size_t kDeepestNesting = 32;

bool is_space(char letter) { return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r'; }

/// May the letter stand in a word? Bytes of UTF-8 may.
bool is_letter(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '\'' ||
         static_cast<unsigned char>(letter) >= 0x80U;
}

/// Reads a pattern from left to right.
class PatternReader {
 public:
  explicit PatternReader(std::string_view text) : text_(text) {}

  Result<Pattern> read() {
    auto pattern = choice(0);
    if (!pattern) return pattern;
    if (at_ != text_.size()) return wrong(fmt::format("'{}' has no partner", text_[at_]));
    return pattern;
  }

 private:
  tl::unexpected<base::Error> wrong(const std::string& what) const {
    return fail(fmt::format("\"{}\", at letter {}: {}", base::shown_text(text_), at_ + 1, what));
  }

  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  Result<Pattern> choice(std::size_t depth) {
    if (depth > kDeepestNesting)
      return wrong(fmt::format("brackets are nested more than {} deep", kDeepestNesting));
    Pattern all{Pattern::Kind::Choice};
    while (true) {
      auto one = sequence(depth);
      if (!one) return one;
      all.parts.push_back(std::move(*one));
      if (at_ == text_.size() || text_[at_] != '|') break;
      ++at_;
    }
    return all.parts.size() == 1 ? std::move(all.parts.front()) : std::move(all);
  }

  Result<Pattern> sequence(std::size_t depth) {
    std::vector<Pattern> parts;
    while (true) {
      skip_space();
      if (at_ == text_.size() || std::string_view("|)]").find(text_[at_]) != std::string_view::npos) break;
      auto part = item(depth);
      if (!part) return part;
      parts.push_back(std::move(*part));
    }
    if (parts.empty()) return wrong("there is nothing to say here");
    return sequence_of(std::move(parts));
  }

  Result<Pattern> item(std::size_t depth) {
    switch (text_[at_]) {
      case '(':
        return bracketed(')', depth);
      case '[': {
        auto inner = bracketed(']', depth);
        if (!inner) return inner;
        return Pattern{Pattern::Kind::Optional, {}, {std::move(*inner)}};
      }
      case '<':
        return enclosed('>', Pattern::Kind::Rule);
      case '{':
        return enclosed('}', Pattern::Kind::Tag);
      default:
        return word();
    }
  }

  Result<Pattern> bracketed(char end, std::size_t depth) {
    ++at_;
    auto inner = choice(depth + 1);
    if (!inner) return inner;
    if (at_ == text_.size() || text_[at_] != end) return wrong(fmt::format("'{}' is missing", end));
    ++at_;
    return inner;
  }

  Result<Pattern> enclosed(char end, Pattern::Kind kind) {
    const std::size_t close = text_.find(end, at_);
    if (close == std::string_view::npos) return wrong(fmt::format("'{}' is missing", end));
    std::string inner(text_.substr(at_ + 1, close - at_ - 1));
    if (inner.empty()) return wrong("there is no name between the brackets");
    at_ = close + 1;
    return Pattern{kind, std::move(inner), {}};
  }

  Result<Pattern> word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    if (at_ == begin)
      return wrong(fmt::format("'{}' cannot be said: write words in small letters", text_[at_]));
    return word_pattern(std::string(text_.substr(begin, at_ - begin)));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::string joined(const std::vector<Pattern>& parts, std::string_view between) {
  std::string text;
  for (const Pattern& part : parts) {
    const std::string one = text_of(part);
    if (one.empty()) continue;
    text.append(text.empty() ? "" : between).append(one);
  }
  return text;
}

}  // namespace

Result<Pattern> pattern_from_text(std::string_view text) { return PatternReader(text).read(); }

std::string text_of(const Pattern& pattern) {
  switch (pattern.kind) {
    case Pattern::Kind::Word:
      return pattern.text;
    case Pattern::Kind::Rule:
      return fmt::format("<{}>", pattern.text);
    case Pattern::Kind::Tag:
      return {};
    case Pattern::Kind::Sequence:
      return joined(pattern.parts, " ");
    case Pattern::Kind::Choice:
      return fmt::format("({})", joined(pattern.parts, " | "));
    case Pattern::Kind::Optional:
      break;
  }
  return fmt::format("[{}]", joined(pattern.parts, " "));
}

Pattern word_pattern(std::string word) { return {Pattern::Kind::Word, std::move(word), {}}; }

Pattern tag_pattern(std::string tag) { return {Pattern::Kind::Tag, std::move(tag), {}}; }

Pattern sequence_of(std::vector<Pattern> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  return {Pattern::Kind::Sequence, {}, std::move(parts)};
}

}  // namespace icome::speech
