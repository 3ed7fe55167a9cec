#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::speech {

/// A pattern of sentences: a word, the name of a rule, a tag that stands for no word, patterns one after the
/// other, one of several, or a pattern that may be left out. A plain value.
struct Pattern {
  enum class Kind : std::uint8_t { Word, Rule, Tag, Sequence, Choice, Optional };

  Kind kind = Kind::Sequence;
  std::string text = {};            // of a word, rule or tag
  std::vector<Pattern> parts = {};  // of a sequence, choice or optional pattern

  bool operator==(const Pattern&) const = default;
};

/// Reads a pattern in the syntax of JSGF: `(make | colour) <objects> [in] <colour> {tag}`. Fails, saying
/// where, for brackets without their partner, an empty alternative, and signs that are none of these.
base::Result<Pattern> pattern_from_text(std::string_view text);

/// The pattern in that syntax again, without its tags.
std::string text_of(const Pattern& pattern);

/// A word, a tag, and patterns one after the other.
Pattern word_pattern(std::string word);
Pattern tag_pattern(std::string tag);
Pattern sequence_of(std::vector<Pattern> parts);

}  // namespace icome::speech
