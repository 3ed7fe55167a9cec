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

/// The best sentence of the grammar for a sound.
struct Heard {
  std::vector<HeardWord> words = {};  // none: nothing of the grammar
  /// How well the sounds of its words fit: the natural logarithm of their likelihood, beside that of the
  /// best sounds that the search looked at, for a frame of 10 ms; 0 at best.
  double score = 0.0;

  std::string sentence() const;
};

/// Finds the sentence of a grammar that was said. One thread uses it.
class Recogniser {
 public:
  virtual ~Recogniser() = default;
  /// Sentences of this rule are recognised from now on. Gives words for which there are no sounds: sentences
  /// with these are not heard. Fails where the grammar has no sentence.
  virtual base::Result<std::vector<std::string>> set_grammar(const Grammar& grammar,
                                                             std::string_view rule) = 0;
  /// The words of one utterance, whole.
  virtual base::Result<Heard> recognise(Sound utterance) = 0;
};

/// PocketSphinx with its model of English. Fails, naming the package, where the model is missing.
base::Result<std::unique_ptr<Recogniser>> make_sphinx_recogniser();

}  // namespace icome::speech
