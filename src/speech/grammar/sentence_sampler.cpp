#include "speech/grammar/sentence_sampler.h"

#include <utility>

namespace icome::speech {

std::optional<std::vector<std::string>> sample_sentence(const Grammar& grammar, const Pattern& pattern,
                                                        base::Random& random) {
  switch (pattern.kind) {
    case Pattern::Kind::Word:
      return std::vector{pattern.text};
    case Pattern::Kind::Tag:
      return std::vector<std::string>();
    case Pattern::Kind::Rule: {
      const Pattern* const rule =
          grammar.find(pattern.text == kAnyWords ? kSuggestedWords : std::string_view(pattern.text));
      return rule ? sample_sentence(grammar, *rule, random) : std::nullopt;
    }
    case Pattern::Kind::Optional: {
      auto inner = sample_sentence(grammar, pattern.parts.front(), random);
      return inner && random.index(2) == 0 ? std::move(inner) : std::vector<std::string>();
    }
    case Pattern::Kind::Choice: {
      const std::size_t count = pattern.parts.size();
      const std::size_t first = count == 0 ? 0 : std::size_t(random.index(count));
      for (std::size_t i = 0; i < count; ++i)
        if (auto words = sample_sentence(grammar, pattern.parts[(first + i) % count], random)) return words;
      return std::nullopt;
    }
    case Pattern::Kind::Sequence:
      break;
  }
  std::vector<std::string> all;
  for (const Pattern& part : pattern.parts) {
    const auto words = sample_sentence(grammar, part, random);
    if (!words) return std::nullopt;
    all.insert(all.end(), words->begin(), words->end());
  }
  return all;
}

}  // namespace icome::speech
