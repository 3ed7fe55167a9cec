#include "speech/hearing/word_sounds.h"

#include <espeak-ng/speak_lib.h>

#include <array>
#include <utility>

#include "speech/speaking/espeak.h"

namespace icome::speech {
namespace {

/// Signs of the International Phonetic Alphabet as espeak-ng writes American English, the longest first where
/// one begins another.
constexpr std::array kSounds = {std::pair{"t\u0283", "CH"},
                                std::pair{"d\u0292", "JH"},
                                std::pair{"a\u026a", "AY"},
                                std::pair{"a\u028a", "AW"},
                                std::pair{"e\u026a", "EY"},
                                std::pair{"o\u028a", "OW"},
                                std::pair{"\u0254\u026a", "OY"},
                                std::pair{"\u025c\u02d0", "ER"},
                                std::pair{"\u025a", "ER"},
                                std::pair{"\u025d", "ER"},
                                std::pair{"\u0251\u02d0\u0279", "AA R"},
                                std::pair{"\u0251\u02d0", "AA"},
                                std::pair{"\u0251", "AA"},
                                std::pair{"\u0252", "AA"},
                                std::pair{"\u0254\u02d0", "AO"},
                                std::pair{"\u0254", "AO"},
                                std::pair{"\u00e6", "AE"},
                                std::pair{"\u028c", "AH"},
                                std::pair{"\u0259", "AH"},
                                std::pair{"\u0250", "AH"},
                                std::pair{"\u025b", "EH"},
                                std::pair{"\u026a", "IH"},
                                std::pair{"\u1d7b", "IH"},
                                std::pair{"i\u02d0", "IY"},
                                std::pair{"i", "IY"},
                                std::pair{"\u028a", "UH"},
                                std::pair{"u\u02d0", "UW"},
                                std::pair{"u", "UW"},
                                std::pair{"e", "EH"},
                                std::pair{"a", "AE"},
                                std::pair{"o", "OW"},
                                std::pair{"b", "B"},
                                std::pair{"d", "D"},
                                std::pair{"f", "F"},
                                std::pair{"\u0261", "G"},
                                std::pair{"g", "G"},
                                std::pair{"h", "HH"},
                                std::pair{"j", "Y"},
                                std::pair{"k", "K"},
                                std::pair{"l", "L"},
                                std::pair{"m", "M"},
                                std::pair{"n", "N"},
                                std::pair{"\u014b", "NG"},
                                std::pair{"p", "P"},
                                std::pair{"\u0279", "R"},
                                std::pair{"r", "R"},
                                std::pair{"s", "S"},
                                std::pair{"\u0283", "SH"},
                                std::pair{"t", "T"},
                                std::pair{"\u027e", "T"},
                                std::pair{"\u0294", "T"},
                                std::pair{"\u03b8", "TH"},
                                std::pair{"\u00f0", "DH"},
                                std::pair{"v", "V"},
                                std::pair{"w", "W"},
                                std::pair{"x", "K"},
                                std::pair{"z", "Z"},
                                std::pair{"\u0292", "ZH"},
                                std::pair{"\u026b", "L"}};

}  // namespace

std::string sounds_from_ipa(std::string_view ipa) {
  std::string sounds;
  while (!ipa.empty()) {
    std::size_t taken = 1;
    for (const auto& [sign, sound] : kSounds) {
      if (!ipa.starts_with(sign)) continue;
      sounds.append(sounds.empty() ? "" : " ").append(sound);
      taken = std::string_view(sign).size();
      break;
    }
    // Stress, length and syllables have no sign there.
    ipa.remove_prefix(taken);
  }
  return sounds;
}

std::string sounds_of_word(std::string_view word) {
  const Espeak library;
  if (!library.is_there()) return {};
  const std::string text(word);
  const void* left = text.c_str();
  std::string ipa;
  constexpr int kInternationalAlphabet = 0x02;
  while (left != nullptr) {
    const char* const part = espeak_TextToPhonemes(&left, espeakCHARS_UTF8, kInternationalAlphabet);
    if (part != nullptr) ipa += part;
  }
  return sounds_from_ipa(ipa);
}

}  // namespace icome::speech
