// Random samples through this library and through R's own tests, which must agree.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdlib>

#include "stats/models/post_hoc.h"
#include "stats/test_samples.h"
#include "stats/tests/assumptions.h"
#include "stats/tests/contingency.h"
#include "stats/tests/correlation.h"
#include "stats/tests/fisher_exact.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/t_tests.h"

namespace icome::stats {
namespace {

/// An R script that prints a number for each question, and the answers that are expected of it.
class QuestionsForR : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("Rscript --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "R is not installed (package r-base-core)";
    script_ = std::filesystem::path(testing::TempDir()) / fmt::format("icome-tests-in-r-{}.R", ::getpid());
  }
  void TearDown() override {
    if (!script_.empty()) std::filesystem::remove(script_);
  }

  void tell(const std::string& line) { lines_ += line + "\n"; }
  void ask(const std::string& expression, double ours) {
    tell(fmt::format("cat(sprintf('%.17g\\n', as.numeric({})))", expression));
    asked_.push_back({fmt::format("{} of\n{}", expression, data_), ours});
  }
  void give(const std::string& name, const std::vector<double>& values) {
    const std::string line = fmt::format("{} <- c({:.17g})", name, fmt::join(values, ", "));
    data_ += line + "\n";
    tell(line);
  }
  void next_case() { data_.clear(); }

  void expect_agreement(double share) {
    std::ofstream(script_) << "options(warn = -1)\n" << lines_;
    FILE* answers = ::popen(fmt::format("Rscript '{}'", script_.string()).c_str(), "r");
    ASSERT_NE(answers, nullptr);
    for (const auto& [question, ours] : asked_) {
      double theirs = 0.0;
      ASSERT_EQ(std::fscanf(answers, "%lf", &theirs), 1) << question;
      EXPECT_NEAR(ours, theirs, share * std::abs(theirs) + 1e-14) << question;
    }
    EXPECT_EQ(::pclose(answers), 0);
  }

 private:
  std::filesystem::path script_;
  std::string lines_, data_;
  std::vector<std::pair<std::string, double>> asked_;
};

// Every other case is rounded, so that there are ties.
std::vector<double> case_sample(base::Random& random, std::size_t count, int number) {
  std::vector<double> values = normal_sample(random, count);
  for (double& value : values)
    if (number % 2 == 1) value = std::round(value * 4.0) / 4.0;
  return values;
}

TEST_F(QuestionsForR, OfSamples) {
  base::Random random(77);
  for (int number = 0; number < 40; ++number) {
    const std::size_t n = 4 + random.index(14);
    const std::vector<double> a = case_sample(random, n, number), b = case_sample(random, n, number),
                              c = case_sample(random, 3 + random.index(9), number);
    give("a", a);
    give("b", b);
    give("c", c);
    ask("t.test(a, c)$p.value", welch_t_test(a, c)->p);
    ask("t.test(a, c, var.equal = TRUE)$conf.int[1]", pooled_t_test(a, c)->interval.low);
    ask("t.test(a, b, paired = TRUE)$p.value", paired_t_test(a, b)->p);
    ask("wilcox.test(a, c)$p.value", rank_sum_test(a, c)->p);
    ask("wilcox.test(a, b, paired = TRUE)$p.value", signed_rank_test(a, b)->p);
    ask("kruskal.test(list(a, b, c))$p.value", kruskal_wallis({a, b, c})->p);
    ask("cor.test(a, b)$conf.int[2]", pearson(a, b)->interval.high);
    ask("cor.test(a, b, method = 'spearman')$p.value", spearman(a, b)->p);
    ask("shapiro.test(a)$p.value", shapiro_wilk(a)->p);
    ask("bartlett.test(list(a, b, c))$p.value", bartlett_test({a, b, c})->p);
    ask("pairwise.t.test(c(a, b, c), rep(1:3, c(length(a), length(b), length(c))))$p.value[2, 1]",
        (*pairwise_t_tests({a, b, c}))[1].p);
    next_case();
  }
  expect_agreement(1e-8);
}

TEST_F(QuestionsForR, OfTables) {
  base::Random random(78);
  for (int number = 0; number < 40; ++number) {
    const std::size_t columns = 2 + random.index(3);
    CountTable table(2 + random.index(2), std::vector<double>(columns));
    std::vector<double> cells;
    for (auto& row : table)
      for (double& count : row) cells.push_back(count = static_cast<double>(1 + random.index(9)));
    give("cells", cells);
    tell(fmt::format("m <- matrix(cells, ncol = {}, byrow = TRUE)", columns));
    ask("chisq.test(m)$p.value", contingency_test(table, Yates::On)->p);
    ask("chisq.test(m, correct = FALSE)$statistic", contingency_test(table)->chi_squared);
    ask("fisher.test(m)$p.value", *fisher_exact_p(table));
    ask("chisq.test(m[1, ])$p.value", goodness_of_fit(table[0])->p);
    if (table.size() == columns) ask("mcnemar.test(m)$p.value", mcnemar_test(table)->p);
    if (cells.size() == 4)
      ask("fisher.test(m, alternative = 'less')$p.value",
          fisher_exact_2x2(table, {1.0, Alternative::Less, 0.95})->p);
    next_case();
  }
  expect_agreement(1e-8);
}

}  // namespace
}  // namespace icome::stats
