#include "speech/hearing/language_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

namespace icome::speech {
namespace {

const std::vector<LanguageModel::Sentence> kSaid{
    {"delete", "the", "box"}, {"delete", "the", "red", "box"}, {"delete", "it"}, {"undo"}, {"undo", "that"}};

TEST(LanguageModel, IsAsKneserAndNeyAndWittenAndBellSay) {
  const LanguageModel model(kSaid);
  // There are 12 pairs of words, 2 of which end with "box"; after "the" come "box" and "red": half is for
  // others.
  const double box = 2.0 / 12.0, after_the = 0.5 * 0.5 + 0.5 * box;
  EXPECT_NEAR(model.probability({}, "box"), box, 1e-12);
  EXPECT_NEAR(model.probability(std::vector<std::string>{"the"}, "box"), after_the, 1e-12);
  // After "delete the" the same two came.
  EXPECT_NEAR(model.probability(std::vector<std::string>{"delete", "the"}, "box"), 0.25 + 0.5 * after_the,
              1e-12);
  EXPECT_EQ(model.probability({}, "sphere"), 0.0);
}

TEST(LanguageModel, SharesAddUpToOneAfterAnyWords) {
  const std::set<std::string> more{"sphere", "cone", "box"};
  const LanguageModel model(kSaid, more);
  std::set<std::string> words{std::string(LanguageModel::kEnd), "sphere", "cone"};
  for (const auto& sentence : kSaid) words.insert(sentence.begin(), sentence.end());
  const std::vector<std::vector<std::string>> befores{{},
                                                      {std::string(LanguageModel::kBegin)},
                                                      {"the"},
                                                      {"delete", "the"},
                                                      {"red", "box"},
                                                      {"cone", "it"},
                                                      {"cone"}};
  for (const auto& before : befores) {
    double sum = 0.0;
    for (const std::string& word : words) sum += model.probability(before, word);
    EXPECT_NEAR(sum, 1.0, 1e-12) << before.size();
  }
}

/// The probability that a file of ARPA tells, by the rule of the format: of the longest words that are there,
/// times the weights of those that are not.
class Arpa {
 public:
  explicit Arpa(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with("-grams:")) order_ = std::size_t(line[1] - '0');
      std::istringstream row(line);
      double value = 0.0, weight = 0.0;
      if (order_ == 0 || !(row >> value)) continue;
      std::vector<std::string> words(order_);
      for (std::string& word : words) row >> word;
      row >> weight;
      rows_[words] = {value, weight};
    }
  }
  double log10_of(std::vector<std::string> words) const {
    if (const auto row = rows_.find(words); row != rows_.end()) return row->second.first;
    std::vector<std::string> before(words.begin(), words.end() - 1);
    const auto row = rows_.find(before);
    words.erase(words.begin());
    return (row == rows_.end() ? 0.0 : row->second.second) + log10_of(words);
  }

 private:
  std::size_t order_ = 0;
  std::map<std::vector<std::string>, std::pair<double, double>> rows_;
};

TEST(LanguageModel, TellsRecognisersTheSame) {
  const std::set<std::string> more{"sphere"};
  const LanguageModel model(kSaid, more);
  const Arpa arpa(model.arpa());
  const std::vector<std::vector<std::string>> all{{"box"},
                                                  {"the", "box"},
                                                  {"delete", "the", "box"},
                                                  {"undo", "the", "sphere"},
                                                  {"<s>", "undo", "that"},
                                                  {"<s>", "red"},
                                                  {"red", "box", "</s>"}};
  for (const auto& words : all) {
    const std::span<const std::string> before(words.data(), words.size() - 1);
    EXPECT_NEAR(arpa.log10_of(words), std::log10(model.probability(before, words.back())), 2e-4)
        << words.back();
  }
}

}  // namespace
}  // namespace icome::speech
