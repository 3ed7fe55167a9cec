#include "apps/study/study_words.h"

#include <array>

namespace icome::apps {
namespace {

// In the order of the enumerators.
constexpr std::array kScaleWords = {"nominal", "ordinal", "interval", "ratio"};
constexpr std::array kOrderWords = {"full", "latin-square", "random", "fixed"};
constexpr std::array kBetterWords = {"neither", "lower", "higher"};
constexpr std::array kTestWords = {"none",     "anova", "ttest",  "wilcoxon", "kruskal",
                                   "friedman", "chisq", "fisher", "mcnemar",  "binomial"};
constexpr std::array kWhenWords = {"before", "after-condition", "after-last", "end"};

}  // namespace

const char* scale_word(study::Scale scale) { return kScaleWords.at(std::size_t(scale)); }
const char* order_word(study::OrderMethod method) { return kOrderWords.at(std::size_t(method)); }
const char* better_word(study::Better better) { return kBetterWords.at(std::size_t(better)); }
const char* test_word(study::Test test) { return kTestWords.at(std::size_t(test)); }
const char* when_word(study::AskWhen when) { return kWhenWords.at(std::size_t(when)); }

}  // namespace icome::apps
