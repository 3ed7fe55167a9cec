#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "sketch/fit/band_system.h"
#include "sketch/fit/cubic_fit.h"
#include "sketch/fit/fit_error.h"
#include "sketch/fit/running_fit.h"
#include "sketch/fit/smooth_spline.h"
#include "sketch/fit/thesis_fit.h"
#include "sketch/fit/width_fit.h"

namespace icome::sketch {
namespace {

/// A wavy line of so many points, 1 apart or so.
std::vector<Vector2> wavy_line(int points) {
  std::vector<Vector2> line;
  for (int i = 0; i < points; ++i) line.emplace_back(i, 6.0 * std::sin(0.11 * i) + 2.0 * std::cos(0.31 * i));
  return line;
}

/// The control points B2 and B3 of least squares by the sums of thesis 4.6, solved as an overdetermined
/// system: t by the length from `start`, which is before 0 for samples that lie before it (erratum to 4.5).
CubicBezier least_squares(const std::vector<Vector2>& samples, std::size_t start, std::size_t end) {
  std::vector<double> along(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i)
    along[i] = along[i - 1] + (samples[i] - samples[i - 1]).norm();
  Eigen::MatrixXd left(samples.size(), 2);
  Eigen::MatrixXd right(samples.size(), 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = (along[i] - along[start]) / (along[end] - along[start]);
    const double u = 1.0 - t;
    left.row(Eigen::Index(i)) << 3.0 * t * u * u, 3.0 * t * t * u;
    right.row(Eigen::Index(i)) =
        (samples[i] - u * u * u * samples[start] - t * t * t * samples[end]).transpose();
  }
  const Eigen::MatrixXd solved = left.colPivHouseholderQr().solve(right);
  return {{samples[start], Vector2(solved.row(0)), Vector2(solved.row(1)), samples[end]}};
}

TEST(ThesisFit, IsTheLeastSquaresOfTheThesis) {
  const std::vector<Vector2> line = wavy_line(30);
  ThesisFit fit(1e9, 3);  // one segment, whatever its error
  for (const Vector2& point : line) fit.add(point);
  const CubicBezier expected = least_squares(line, 0, line.size() - 1);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT((fit.current().curve.points[k] - expected.points[k]).norm(), 1e-8) << k;
}

// A finished segment begins at P_s and ends at P_(n-s) of its samples; the next one begins there.
TEST(ThesisFit, NeighboursShareSamplesOnBothSidesOfTheirJoint) {
  const std::vector<Vector2> line = wavy_line(200);
  constexpr std::size_t kShared = 4;
  ThesisFit fit(0.2, kShared);
  for (const Vector2& point : line) fit.add(point);
  ASSERT_GE(fit.finished().size(), 2U);
  const CubicBezier& second = fit.finished()[1].curve;
  EXPECT_EQ(second.points[0], fit.finished()[0].curve.points[3]);
  const auto index_of = [&](const Vector2& point) {
    return std::size_t(std::find(line.begin(), line.end(), point) - line.begin());
  };
  const std::size_t start = index_of(second.points[0]);
  const std::size_t end = index_of(second.points[3]);
  ASSERT_LT(end + kShared, line.size());
  const std::vector<Vector2> samples(line.begin() + std::ptrdiff_t(start - kShared),
                                     line.begin() + std::ptrdiff_t(end + kShared) + 1);
  const CubicBezier expected = least_squares(samples, kShared, kShared + end - start);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((second.points[k] - expected.points[k]).norm(), 1e-8) << k;
}

TEST(RunningFit, ReachesFromTheStartToTheLastPointWithoutAGap) {
  const std::vector<Vector2> line = wavy_line(400);
  RunningFit fit(line.front());
  for (std::size_t i = 1; i < line.size(); ++i) {
    fit.add(line[i]);
    EXPECT_EQ(fit.current().curve.points[3], line[i]);
    Vector2 last = line.front();
    for (const RunningFit::Finished& segment : fit.finished()) {
      EXPECT_EQ(segment.curve.points[0], last);
      last = segment.curve.points[3];
    }
    EXPECT_EQ(fit.current().curve.points[0], last);
  }
  EXPECT_GT(fit.finished().size(), 3U);
}

TEST(RunningFit, TurnsWithoutABreakFromOneSegmentToTheNext) {
  const std::vector<Vector2> line = wavy_line(400);
  RunningFit fit(line.front());
  for (const Vector2& point : line) fit.add(point);
  ASSERT_EQ(fit.corners(), 0U);
  for (std::size_t i = 1; i < fit.finished().size(); ++i) {
    const Vector2 before = fit.finished()[i - 1].curve.end_direction();
    const Vector2 after = fit.finished()[i].curve.start_direction();
    EXPECT_GT(before.dot(after), 1.0 - 1e-12) << i;
  }
}

// A straight line of width 1 to 2 and then 2 all along: two pieces, and no more.
TEST(WidthFit, HasAPieceForEachStraightPart) {
  WidthFit fit(0.01);
  for (int i = 0; i <= 100; ++i) fit.add(0.1 * i, i < 50 ? 1.0 + 0.02 * i : 2.0);
  const std::vector<WidthSegment> widths = fit.widths(10.0);
  ASSERT_EQ(widths.size(), 2U);
  EXPECT_NEAR(widths[0].from_width, 1.0, 0.01);
  EXPECT_EQ(widths[1].from_width, widths[0].to_width);
  EXPECT_NEAR(widths[1].to_width, 2.0, 0.02);
  EXPECT_EQ(widths[1].to, 10.0);
}

TEST(WidthFit, IsWithinItsToleranceOfEveryWidth) {
  std::mt19937 random(4);
  std::normal_distribution<double> step(0.0, 0.02);
  WidthFit fit(0.05);
  std::vector<double> given = {1.0};
  for (int i = 1; i < 500; ++i) given.push_back(std::max(0.0, given.back() + step(random)));
  for (std::size_t i = 0; i < given.size(); ++i) fit.add(double(i), given[i]);
  const Curve curve = {{}, fit.widths(double(given.size() - 1)), false};
  for (std::size_t i = 1; i < given.size(); ++i)
    EXPECT_LE(std::abs(curve.width_at(double(i)) - given[i]), 0.0500001);
}

/// Both distances by many places of each against many of the other.
double looked_at(const std::vector<Vector2>& line, const std::vector<CubicBezier>& curve) {
  std::vector<Vector2> on_line;
  std::vector<Vector2> on_curve;
  for (std::size_t i = 1; i < line.size(); ++i)
    for (int k = 0; k <= 40; ++k) on_line.push_back(line[i - 1] + k / 40.0 * (line[i] - line[i - 1]));
  for (const CubicBezier& segment : curve)
    for (int k = 0; k <= 400; ++k) on_curve.push_back(segment.at(k / 400.0));
  double greatest = 0.0;
  const auto one_way = [&](const std::vector<Vector2>& from, const std::vector<Vector2>& to) {
    for (const Vector2& a : from) {
      double least = 1e300;
      for (const Vector2& b : to) least = std::min(least, (a - b).squaredNorm());
      greatest = std::max(greatest, std::sqrt(least));
    }
  };
  one_way(on_line, on_curve);
  one_way(on_curve, on_line);
  return greatest;
}

TEST(GreatestDistance, IsNeverBelowWhatLookingFindsAndHardlyAbove) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-5.0, 5.0);
  const auto point = [&] { return Vector2(number(random), number(random)); };
  for (int round = 0; round < 20; ++round) {
    std::vector<Vector2> line = {point(), point(), point(), point()};
    std::vector<CubicBezier> curve;
    curve.push_back({{line.front(), point(), point(), point()}});
    curve.push_back({{curve[0].points[3], point(), point(), line.back()}});
    const double looked = looked_at(line, curve);
    const double bound = greatest_distance(line, curve, 0.01);
    EXPECT_GE(bound, looked - 0.15) << round;  // places that are looked at lie up to 0.3 apart
    EXPECT_LE(bound, looked + 0.02) << round;
  }
}

// A line along the chord of a bow that is 3/4 of 4/3 high in the middle.
TEST(GreatestDistance, OfABowIsItsHeight) {
  const std::vector<Vector2> line = {{0.0, 0.0}, {4.0, 0.0}};
  const CubicBezier bow = {
      {Vector2(0.0, 0.0), Vector2(1.0, 4.0 / 3.0), Vector2(3.0, 4.0 / 3.0), Vector2(4.0, 0.0)}};
  EXPECT_NEAR(greatest_distance(line, {&bow, 1}, 1e-4), 1.0, 2e-4);
  EXPECT_GE(certified_distance(line, bow, 1e-3), 1.0);
}

TEST(CurveMoments, GiveTheCubicThatTheyAreOf) {
  // Points whose t is nearly even along the length are needed: a curve whose speed is even, an arc.
  std::vector<Vector2> line;
  for (int i = 0; i <= 2000; ++i) line.emplace_back(10.0 * std::cos(5e-4 * i), 10.0 * std::sin(5e-4 * i));
  CurveMoments moments;
  double along = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double next = along + (line[i] - line[i - 1]).norm();
    moments.add(line[i - 1], along, line[i], next);
    along = next;
  }
  const CubicBezier cubic = moments.cubic(line.front(), line.back(), along, {});
  const CubicBezier expected = least_squares(line, 0, line.size() - 1);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((cubic.points[k] - expected.points[k]).norm(), 2e-4) << k;
  const Vector2 up(0.0, 1.0);
  const CubicBezier held = moments.cubic(line.front(), line.back(), along, up);
  EXPECT_NEAR((held.points[1] - held.points[0]).x(), 0.0, 1e-12);
  EXPECT_GT((held.points[1] - held.points[0]).y(), 0.0);
}

// Joints that lie between points were taken for as far away as the next point is.
TEST(SmoothSpline, APartOfItIsAsNearAsItIsAlsoWhereItsEndsLieBetweenPoints) {
  SmoothSpline whole(
      {{{0, 0}, 0.0, 13, 13}, {{40, 0}, 0.0, 13, 13}, {{80, 0}, 0.0, 13, 13}, {{120, 0}, 0.0, 13, 13}});
  std::vector<Vector2> points;
  for (int i = 0; i <= 8; ++i) points.emplace_back(15 * i, 0.2 * (i % 2));
  constexpr SmoothSpline::Effort kEffort = {.most_rounds = 25, .rounds_of_hope = 25};
  EXPECT_LE(whole.bring_near(points, {}, 1.0, kEffort), 1.0);
  const auto& before = whole.points_before();
  SmoothSpline part({whole.joints()[1], whole.joints()[2]});
  const std::span<const Vector2> of_part(points.data() + before[1], before[2] - before[1]);
  const SmoothSpline::Beyond beyond = {whole.place_of_way(points, 1), whole.place_of_way(points, 2)};
  EXPECT_LE(part.bring_near(of_part, beyond, 1.0, kEffort), 1.0);
}

TEST(BandSystem, SolvesAsADenseOne) {
  constexpr Eigen::Index kSize = 25;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(kSize, kSize);
  for (Eigen::Index i = 0; i < kSize; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - 7); j <= i; ++j)
      factor(i, j) = number(random) + (i == j ? 3.0 : 0.0);
  const Eigen::MatrixXd matrix = factor * factor.transpose();
  BandSystem system(kSize);
  Eigen::VectorXd right(kSize);
  for (Eigen::Index i = 0; i < kSize; ++i) {
    right(i) = number(random);
    system.add_right(std::size_t(i), right(i));
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - 7); j <= i; ++j)
      system.add(std::size_t(i), std::size_t(j), matrix(i, j));
  }
  const Eigen::VectorXd expected = matrix.ldlt().solve(right);
  const std::vector<double> solved = system.solve(0.0);
  ASSERT_EQ(solved.size(), std::size_t(kSize));
  for (Eigen::Index i = 0; i < kSize; ++i) EXPECT_NEAR(solved[std::size_t(i)], expected(i), 1e-10);
}

TEST(BandSystem, HasNoSolutionWhereNothingIsKnown) { EXPECT_TRUE(BandSystem(3).solve(0.0).empty()); }

}  // namespace
}  // namespace icome::sketch
