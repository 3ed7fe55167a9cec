#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "speech/hearing/recogniser.h"

namespace icome::speech {

/// A word by which people say that a sentence is meant for the program, where they also talk with each other:
/// "computer, a red box". After the word alone the next sentence needs none, for some seconds. A plain value.
class WakeWord {
 public:
  /// One to three words of letters. Fails for anything else.
  static base::Result<WakeWord> of(std::string_view words);

  /// The rules with which the word may come before the sentences of `rules`, or stand alone.
  Grammar with_word(const Grammar& grammar, const HeardRules& rules) const;
  static constexpr HeardRules kRules{"addressed-sentence", "usual-addressed-sentence"};

  /// The part of an utterance that was meant for the program.
  struct Meant {
    std::vector<Heard> sentences = {};  // without the word; none: not a sentence
    bool is_called = false;             // the word alone was said
    bool is_meant = false;              // false: people talk with each other
  };
  /// Picks the sentences that were meant from those that may have been said (the likeliest first). The
  /// utterance began at `begin` and ended at `end`, s.
  Meant meant(std::vector<Heard> heard, double begin, double end);
  /// The next sentence needs no word, if it begins within kAwake s after `time`: a question was asked.
  void stay_awake(double time) { awake_until_ = time + kAwake; }
  /// The next sentence needs the word again.
  void fall_asleep() { awake_until_ = kNever; }
  bool is_awake(double time) const { return time <= awake_until_; }
  static constexpr double kAwake = 8.0;  // s

  std::string text() const;

 private:
  explicit WakeWord(std::vector<std::string> words) : words_(std::move(words)) {}
  bool begins(const Heard& heard) const;

  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::vector<std::string> words_;
  double awake_until_ = kNever;  // s
};

}  // namespace icome::speech
