#include "stats/models/model_terms.h"

#include <gtest/gtest.h>

#include "stats/anova_test_data.h"

namespace icome::stats {
namespace {

TEST(ModelTerms, SmallTermsFirst) {
  EXPECT_EQ(model_terms(3, 3), (std::vector<Term>{{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}}));
  EXPECT_EQ(model_terms(3, 1), (std::vector<Term>{{0}, {1}, {2}}));
  EXPECT_TRUE(model_terms(0, 3).empty());
}

TEST(ModelTerms, ColumnsSumToZeroOverLevels) {
  const std::vector<Factor> factors = {anova_data::numbered("a", {0, 1, 2}),
                                       anova_data::numbered("b", {0, 1})};
  const std::vector<std::vector<int>> cells = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  EXPECT_EQ(term_name(factors, {0, 1}), "a:b");
  const Eigen::MatrixXd columns = term_columns(factors, {0, 1}, cells);
  ASSERT_EQ(columns.cols(), 2);
  EXPECT_EQ(columns.colwise().sum().norm(), 0.0);
  // Product of (1, 0; 0, 1; -1, -1) and (1; -1).
  EXPECT_EQ(columns.col(0), (Eigen::VectorXd(6) << 1, -1, 0, 0, -1, 1).finished());
  EXPECT_EQ(term_columns(factors, {}, cells), Eigen::MatrixXd::Ones(6, 1));
}

TEST(ModelTerms, DirectionsCountWhatIsNewOnly) {
  Directions directions(4);
  Eigen::MatrixXd columns(4, 3);
  columns.col(0) << 1, 1, 1, 1;
  columns.col(1) << 1, 1, 0, 0;
  columns.col(2) << 0, 0, 1, 1;
  EXPECT_EQ(directions.add(columns), 2);
  EXPECT_EQ(directions.add(columns), 0);
  EXPECT_EQ(directions.add(Eigen::MatrixXd::Zero(4, 1)), 0);
  // What is left of a column that is nearly there is still orthogonal to the others.
  Eigen::MatrixXd nearly = columns.leftCols(1);
  nearly(0, 0) += 1e-6;
  EXPECT_EQ(directions.add(nearly), 1);
  EXPECT_LT((directions.last(3).transpose() * directions.last(3) - Eigen::MatrixXd::Identity(3, 3)).norm(),
            1e-14);
}

}  // namespace
}  // namespace icome::stats
