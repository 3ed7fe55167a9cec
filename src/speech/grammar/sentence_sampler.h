#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "speech/grammar/grammar.h"

namespace icome::speech {

/// A sentence that the pattern matches, drawn at random; nothing where it matches none, as its rules have no
/// words.
std::optional<std::vector<std::string>> sample_sentence(const Grammar& grammar, const Pattern& pattern,
                                                        base::Random& random);

}  // namespace icome::speech
