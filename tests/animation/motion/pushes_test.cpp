#include "animation/motion/pushes.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "repeats.h"

namespace icome::animation {
namespace {

TEST(Pushes, KeepWhatTheyAreAskedFor) {
  base::Random random(1);
  for (int k = 0; k < repeats(3000); ++k) {
    const std::size_t n = 1 + random.index(12), rank = 1 + random.index(12);
    std::vector<double> shape(n * rank), matrix(n * n);
    for (double& value : shape) value = random.uniform(-1, 1);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        matrix[a * n + b] = a == b ? 1e-3 : 0;
        for (std::size_t r = 0; r < rank; ++r) matrix[a * n + b] += shape[a * rank + r] * shape[b * rank + r];
      }
    std::vector<PushRow> rows(n);
    for (PushRow& row : rows) row = {random.uniform(-10, 10), random.index(3) == 0, random.index(8) != 0};
    const std::vector<double> pushes = pushes_of(matrix, rows);
    for (std::size_t a = 0; a < n; ++a) {
      double left = rows[a].excess;
      for (std::size_t b = 0; b < n; ++b) left += matrix[a * n + b] * pushes[b];
      if (!rows[a].moves) {
        EXPECT_EQ(pushes[a], 0);
      } else if (rows[a].is_even) {
        EXPECT_NEAR(left, 0, 1e-6);
      } else {
        EXPECT_LE(left, 1e-4);
        EXPECT_LE(pushes[a], 1e-4);
        EXPECT_NEAR(std::min(-left, -pushes[a]), 0, 1e-4) << "one of the two is 0";
      }
    }
  }
}

}  // namespace
}  // namespace icome::animation
