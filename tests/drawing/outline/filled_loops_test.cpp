#include "drawing/outline/filled_loops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/random.h"

namespace icome::drawing {
namespace {

constexpr int kLoopSamples = 120;   // of each cubic
constexpr double kNearEdge = 4e-4;  // farther off than the straight pieces between samples
constexpr double kLoopTolerance = 1e-5;

Vector2 random_place(base::Random& random) { return {random.uniform(), random.uniform()}; }

Curve random_loop(base::Random& random) {
  Curve loop;
  const std::size_t count = 1 + random.index(3);
  const double size = random.uniform(0.05, 0.6);
  const Vector2 corner = random_place(random);
  Vector2 at = corner;
  for (std::size_t i = 0; i < count; ++i) {
    const auto next = [&] { return Vector2(corner + size * random_place(random)); };
    loop.segments.push_back({{at, next(), next(), next()}});
    at = loop.segments.back().points[3];
  }
  loop.closed = random.index(2) == 0;
  if (loop.closed) loop.segments.back().points[3] = corner;
  return loop;
}

Curve circle_about(const Vector2& centre, double radius, bool backwards) {
  constexpr double kHandle = 0.5522847498307936;
  Curve circle;
  circle.closed = true;
  const Vector2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  for (int i = 0; i < 4; ++i)
    circle.segments.push_back(
        {{centre + radius * axes[i], centre + radius * (axes[i] + kHandle * axes[i + 1]),
          centre + radius * (axes[i + 1] + kHandle * axes[i]), centre + radius * axes[i + 1]}});
  return backwards ? reversed(circle) : circle;
}

/// The number of times that a line, closed by a straight one, winds around a place, by many samples; also the
/// distance to it.
int winding_of(const Curve& line, const Vector2& place, double& distance) {
  int winding = 0;
  Vector2 last = line.segments.front().points[0];
  const auto step = [&](const Vector2& next) {
    const Vector2 way = next - last;
    const double length = way.squaredNorm();
    const double part = length > 0.0 ? std::clamp((place - last).dot(way) / length, 0.0, 1.0) : 0.0;
    distance = std::min(distance, (last + part * way - place).norm());
    const double side = way.x() * (place.y() - last.y()) - (place.x() - last.x()) * way.y();
    if (last.y() <= place.y() && next.y() > place.y() && side > 0.0) ++winding;
    if (last.y() > place.y() && next.y() <= place.y() && side < 0.0) --winding;
    last = next;
  };
  for (const CubicBezier& segment : line.segments)
    for (int i = 1; i <= kLoopSamples; ++i) step(segment.at(double(i) / kLoopSamples));
  step(line.segments.front().points[0]);
  return winding;
}

/// Holds the fills against the rule at random places that are not near a line.
void expect_same_area(const std::vector<Curve>& lines, FillRule rule, base::Random& random) {
  const std::vector<FilledLoops> fills = filled_loops(lines, rule, 0.0, kLoopTolerance);
  std::size_t members = 0;
  for (const FilledLoops& filled : fills) members += filled.members.size();
  EXPECT_EQ(members, lines.size());
  for (int i = 0; i < 60; ++i) {
    const Vector2 place = 1.4 * random_place(random) - Vector2(0.2, 0.2);
    double distance = 1.0, beyond = 1.0;
    int wound = 0;
    for (const Curve& line : lines) wound += winding_of(line, place, distance);
    if (distance < kNearEdge) continue;
    bool is_filled = false;
    for (const FilledLoops& filled : fills) is_filled |= winding_of(filled.curve, place, beyond) != 0;
    EXPECT_EQ(is_filled, rule == FillRule::NonZero ? wound != 0 : wound % 2 != 0) << place.transpose();
  }
}

class RandomLoops : public ::testing::TestWithParam<int> {};

TEST_P(RandomLoops, FillWhatTheRuleSays) {
  base::Random random{std::uint64_t(GetParam())};
  for (int i = 0; i < 12; ++i) {
    std::vector<Curve> lines;
    for (std::size_t k = 1 + random.index(5); k-- > 0;) lines.push_back(random_loop(random));
    expect_same_area(lines, FillRule::NonZero, random);
    expect_same_area(lines, FillRule::EvenOdd, random);
    if (HasFailure()) FAIL() << "drawing " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomLoops, ::testing::Range(0, 4));

TEST(FilledLoops, OfNestedCirclesAreExact) {
  base::Random random(5);
  for (int backwards = 0; backwards < 8; ++backwards) {
    std::vector<Curve> circles;
    for (int i = 0; i < 3; ++i)
      circles.push_back(circle_about({0.5, 0.5}, 0.4 - 0.1 * i, (backwards >> i & 1) != 0));
    const auto fills = filled_loops(circles, FillRule::EvenOdd, 0.0, kLoopTolerance);
    ASSERT_EQ(fills.size(), 1U);
    EXPECT_EQ(fills[0].likeness, FillLikeness::Exact);
    EXPECT_EQ(fills[0].curve.segments.size(), 12U + 4U) << "two ways there and back";
    expect_same_area(circles, FillRule::EvenOdd, random);
  }
}

TEST(FilledLoops, KeepWhatLiesApart) {
  const std::vector<Curve> lines = {circle_about({0.2, 0.2}, 0.1, false), circle_about({0.8, 0.2}, 0.1, true),
                                    circle_about({0.2, 0.2}, 0.05, true)};
  const auto fills = filled_loops(lines, FillRule::NonZero, 0.0, kLoopTolerance);
  ASSERT_EQ(fills.size(), 2U);
  EXPECT_EQ(fills[0].members, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(fills[1].members, (std::vector<std::size_t>{1}));
  EXPECT_EQ(fills[1].curve, lines[1]);
  EXPECT_EQ(filled_loops(lines, FillRule::NonZero, 0.21, kLoopTolerance).size(), 1U)
      << "with lines that are wide enough to meet";
  EXPECT_TRUE(filled_loops(std::vector<Curve>{{}, {}}, FillRule::EvenOdd, 0.0, kLoopTolerance).empty());
}

TEST(FilledLoops, OfVeryManyLinesEndInTime) {
  std::vector<Curve> dots;
  for (int i = 0; i < 30000; ++i) dots.push_back(circle_about({0.01 * i, 0.0}, 0.001, i % 2 == 0));
  EXPECT_EQ(filled_loops(dots, FillRule::NonZero, 0.0, kLoopTolerance).size(), 1U);
  EXPECT_EQ(filled_loops(dots, FillRule::EvenOdd, 0.0, 1e-7).at(0).likeness, FillLikeness::NonZeroInstead);
}

TEST(FilledLoops, LinesThatCrossWithoutAnEndGetTheOtherRuleInTime) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 0.2);
  Curve scribble;
  scribble.closed = true;
  const Vector2 first(place(random), place(random));
  Vector2 at = first;
  for (int i = 0; i < 800; ++i) {
    const Vector2 next = i == 799 ? first : Vector2(place(random), place(random));
    scribble.segments.push_back(CubicBezier::line(at, next));
    at = next;
  }
  const auto filled = filled_loops(std::vector{scribble}, FillRule::EvenOdd, 0.0, 1e-5);
  ASSERT_EQ(filled.size(), 1U);
  EXPECT_EQ(filled[0].likeness, FillLikeness::NonZeroInstead);
}

}  // namespace
}  // namespace icome::drawing
