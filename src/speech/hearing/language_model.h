#pragma once
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace icome::speech {

/// The likelihood of each word after the two before it, from example sentences: trigrams. Shorter ones, which
/// are for words that were not seen after these two, are counted as Kneser and Ney do (1995), and get their
/// share as Witten and Bell say (1991), so that no word is impossible anywhere. A plain value.
class LanguageModel {
 public:
  using Sentence = std::vector<std::string>;

  /// Words beside those of the sentences are as likely as one that was seen once.
  explicit LanguageModel(std::span<const Sentence> sentences, const std::set<std::string>& words = {});

  /// The likelihood of a word, or kEnd, after the words before it, kBegin at first; of these the last two
  /// count. 0 for a word that it does not know.
  double probability(std::span<const std::string> before, std::string_view word) const;
  static constexpr std::string_view kBegin = "<s>", kEnd = "</s>";

  /// The model in the text format of ARPA, which recognisers read.
  std::string arpa() const;

 private:
  /// The words seen after some words, and how often.
  struct Followers {
    std::map<std::string, double, std::less<>> counts;
    double sum = 0.0;

    /// The share for words that were not seen: the more kinds of words follow, the more.
    double rest() const { return double(counts.size()) / (sum + double(counts.size())); }
    double share(std::string_view word) const;
  };

  double alone(std::string_view word) const;
  double after(const std::string& last, std::string_view word) const;

  Followers words_;
  std::map<std::string, Followers, std::less<>> after_word_;
  std::map<std::pair<std::string, std::string>, Followers> after_two_;
};

}  // namespace icome::speech
