#include "interaction/head/head_motion.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "base/random.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

using base::Pose;
using base::Quaternion;
using base::Vector3;

Quaternion random_rotation(base::Random& random) {
  return Quaternion(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                    random.uniform(-1.0, 1.0))
      .normalized();
}

TEST(HeadTransfer, HasTheValuesOfTheThesis) {
  // By hand: 0.12 + 1.5 x 0.10 + 0.5 x 0.08 = 0.31 m to the right.
  const HeadTransfer thesis = HeadTransfer::of_thesis();
  EXPECT_NEAR(transferred(0.30, thesis.moves[0]), 0.31, 1e-15);
  EXPECT_NEAR(transferred(-0.06, thesis.moves[0]), -0.03, 1e-15);
  EXPECT_NEAR(transferred(0.22, thesis.moves[1]), 0.05 + 3.0 * 0.17, 1e-15);
  EXPECT_NEAR(transferred(-60.0 * kDegree, thesis.turns[1]), -(5.0 + 0.8 * 40.0 + 0.1 * 15.0) * kDegree,
              1e-15);
  EXPECT_NEAR(transferred(2.5 * kDegree, thesis.turns[2]), 1.25 * kDegree, 1e-15);
}

TEST(HeadTransfer, IsOddContinuousAndNeverFalls) {
  base::Random random(1);
  for (int i = 0; i < repeats(100'000); ++i) {
    const double knee1 = random.index(5) == 0 ? 0.0 : random.uniform(0.0, 1.0);
    const TransferAxis axis = {knee1, random.uniform(0.0, 5.0), knee1 + random.uniform(0.0, 1.0),
                               random.uniform(0.0, 1.0)};
    const double x = random.uniform(-3.0, 3.0), step = 1e-9;
    EXPECT_EQ(transferred(-x, axis), -transferred(x, axis));
    const double rise = transferred(x + step, axis) - transferred(x, axis);
    EXPECT_GE(rise, -1e-15);
    EXPECT_LE(rise, 5.1 * step) << "no steeper than the steepest slope";
  }
  EXPECT_EQ(transferred(0.0, {}), 0.0);
}

TEST(HeadTransfer, TakesRotationsApartAsTheyWerePutTogether) {
  base::Random random(2);
  for (int i = 0; i < repeats(100'000); ++i) {
    const double nod = random.index(20) == 0 ? std::numbers::pi / 2.0 : random.uniform(-1.57, 1.57);
    const base::Matrix3 rotation =
        rotation_of({nod, random.uniform(-3.14, 3.14), random.uniform(-3.14, 3.14)});
    EXPECT_LT((rotation_of(turns_of(rotation)) - rotation).cwiseAbs().maxCoeff(), 1e-12);
  }
  // A look to the left, then down, then a tilt: each of a known matrix.
  const base::Matrix3 left = rotation_of({0.0, std::numbers::pi / 2.0, 0.0});
  EXPECT_LT((left * Vector3(0, 0, -1) - Vector3(-1, 0, 0)).norm(), 1e-15);
  const base::Matrix3 up = rotation_of({std::numbers::pi / 2.0, 0.0, 0.0});
  EXPECT_LT((up * Vector3(0, 0, -1) - Vector3(0, 1, 0)).norm(), 1e-15);
}

TEST(MeanRotation, HasTheLeastSumOfSquaredDistances) {
  base::Random random(3);
  const auto distances = [](const Quaternion& mean, const std::vector<Quaternion>& all) {
    double sum = 0.0;
    for (const Quaternion& it : all) sum += (mean.toRotationMatrix() - it.toRotationMatrix()).squaredNorm();
    return sum;
  };
  for (int i = 0; i < repeats(2'000); ++i) {
    const Quaternion middle = random_rotation(random);
    const double spread = random.uniform(0.0, 1.0);
    std::vector<Quaternion> all;
    for (int k = 0; k < 5; ++k) {
      Quaternion near = middle.slerp(spread, random_rotation(random));
      if (random.index(2) == 0) near.coeffs() = -near.coeffs();  // the same rotation
      all.push_back(near);
    }
    const Quaternion mean = mean_rotation(all);
    EXPECT_NEAR(mean.norm(), 1.0, 1e-14);
    const double least = distances(mean, all);
    for (int k = 0; k < 20; ++k) {
      const Quaternion beside = mean.slerp(random.uniform(1e-4, 0.02), random_rotation(random));
      EXPECT_GE(distances(beside, all), least - 1e-9);
    }
  }
}

TEST(HeadMotion, MovesTheViewByTheMeanOfFiveSamplesFromRest) {
  HeadMotion motion;
  const Pose rest = Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.7, Vector3::UnitY());
  EXPECT_TRUE(motion.moved(rest, 0.0).isApprox(Pose::Identity()));
  // Steps of 1 cm to the right of the head at rest: the mean of five is two steps behind.
  Pose view = Pose::Identity();
  for (int i = 1; i <= 20; ++i)
    view = motion.moved(rest * Eigen::Translation3d(0.01 * i, 0.0, 0.0), 0.01 * i);
  EXPECT_NEAR(view.translation().x(), 0.12 + 1.5 * (0.18 - 0.12), 1e-12);
  EXPECT_NEAR(view.translation().tail<2>().norm(), 0.0, 1e-12);
  motion.recentre();
  for (int i = 0; i < 5; ++i)
    view = motion.moved(rest * Eigen::Translation3d(0.18, 0.0, 0.0), 1.0 + 0.01 * i);
  EXPECT_TRUE(view.isApprox(Pose::Identity(), 1e-12)) << "where it was recentred is at rest";
}

}  // namespace
}  // namespace icome::interaction
