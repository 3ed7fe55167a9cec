#pragma once
#include <string>
#include <string_view>

namespace icome::speech {

/// The sounds of a word by rule, for words that the recogniser's dictionary lacks: "s p r ow k eh t" would be
/// those of "sproket", in the signs of the CMU dictionary. Empty where the rules give none, as for other
/// scripts.
std::string sounds_of_word(std::string_view word);

/// The sounds of a text in the International Phonetic Alphabet, in the signs of the CMU dictionary.
std::string sounds_from_ipa(std::string_view ipa);

}  // namespace icome::speech
