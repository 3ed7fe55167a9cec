#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "speech/grammar/grammar.h"

namespace icome::speech {

/// Samples a second of all sound that is recognised: one channel of 16 bits.
inline constexpr int kSampleRate = 16000;
using Sound = std::span<const std::int16_t>;

/// A word that was heard, s from the beginning of the sound.
struct HeardWord {
  std::string word;
  double begin = 0.0, end = 0.0;
};

/// A sentence of the grammar that may have been said.
struct Heard {
  std::vector<HeardWord> words = {};
  /// How well the sounds of its words fit: the natural logarithm of their likelihood, beside that of the
  /// best sounds for a frame of 10 ms; 0 at best.
  double score = 0.0;
  /// The likelihood that it lacks beside the best words in any order, as a natural logarithm; 0 at best.
  double behind = 0.0;

  std::string sentence() const;
};

/// The rules of a grammar that are recognised.
struct HeardRules {
  std::string_view sentence;  // whatever can be said
  std::string_view usual;     // what is said most, each of its forms as often as the others
};

/// Finds the sentences of a grammar that may have been said. One thread uses it.
class Recogniser {
 public:
  virtual ~Recogniser() = default;
  /// Sentences of these rules are recognised from now on. Gives words for which there are no sounds:
  /// sentences with these are not heard. Fails where the grammar has no sentence.
  virtual base::Result<std::vector<std::string>> set_grammar(const Grammar& grammar,
                                                             const HeardRules& rules) = 0;
  /// The sentences that may have been said in one utterance, whole: different ones, the likeliest first; none
  /// where it is no sentence of the grammar.
  virtual base::Result<std::vector<Heard>> recognise(Sound utterance) = 0;
};

/// PocketSphinx with its model of English. Fails, naming the package, where the model is missing.
base::Result<std::unique_ptr<Recogniser>> make_sphinx_recogniser();

}  // namespace icome::speech
