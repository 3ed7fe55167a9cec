#include "drawing/curve.h"

#include <gtest/gtest.h>

#include "drawing/test_drawings.h"

namespace icome::drawing {
namespace {

using judges::random_curve;

/// Both curves are the same to the eye: at places counted by `renumber`.
template <typename Renumber>
void expect_same_places(const Curve& curve, const Curve& other, double from, double to,
                        const Renumber& renumber) {
  for (int k = 0; k <= 400; ++k) {
    const double place = from + (to - from) * k / 400.0;
    ASSERT_LT((other.at(renumber(place)) - curve.at(place)).norm(), 1e-13) << place;
    ASSERT_NEAR(other.width_at(renumber(place)), curve.width_at(place), 1e-13) << place;
  }
  EXPECT_EQ(other.widths.front().from, 0.0);
  EXPECT_EQ(other.widths.back().to, other.end());
  for (std::size_t i = 1; i < other.widths.size(); ++i)
    EXPECT_EQ(other.widths[i].from, other.widths[i - 1].to);
}

// Inside of one segment, over joints, at joints; and over ends of width segments, of which one is at 1.4.
TEST(PartOf, KeepsPointsAndWidths) {
  const Curve curve = random_curve(1, 4);
  for (const double from : {0.0, 0.2, 1.0, 1.4, 1.9}) {
    for (const double to : {1.95, 2.0, 3.2, 3.9, 4.0}) {
      const Curve part = part_of(curve, from, to);
      const double whole = std::floor(from);
      const double last = std::ceil(to) - 1.0;
      expect_same_places(curve, part, from, to, [&](double place) {
        const double segment = std::clamp(std::floor(place), whole, last);
        const double begin = std::max(from, segment);
        const double end = std::min(to, segment + 1.0);
        return segment - whole + (place - begin) / (end - begin);
      });
    }
  }
}

TEST(CutAt, AddsASegmentAndChangesNothingElse) {
  const Curve curve = random_curve(2, 3);
  for (const double cut : {0.3, 1.05, 1.5, 2.99}) {
    const Curve more = cut_at(curve, cut);
    ASSERT_EQ(more.segments.size(), 4U);
    const double whole = std::floor(cut);
    const double t = cut - whole;
    expect_same_places(curve, more, 0.0, 3.0, [&](double place) {
      if (place <= whole) return place;
      if (place <= cut) return whole + (place - whole) / t;
      return place <= whole + 1.0 ? whole + 1.0 + (place - cut) / (1.0 - t) : place + 1.0;
    });
  }
  EXPECT_EQ(cut_at(curve, 1.0), curve);
}

TEST(Reversed, RunsThroughTheSamePlaces) {
  const Curve curve = random_curve(3, 3);
  expect_same_places(curve, reversed(curve), 0.0, 3.0, [](double place) { return 3.0 - place; });
}

TEST(TransformedCurve, WidthsGrowWithTheRootOfTheDeterminant) {
  const Curve curve = random_curve(4, 2);
  Eigen::Affine2d there = Eigen::Affine2d::Identity();
  there.linear() << 0.0, -3.0, 2.0, 1.0;  // determinant 6
  there.translation() << 0.5, -0.5;
  const Curve moved = transformed(curve, there);
  for (const double place : {0.0, 0.7, 1.3, 2.0}) {
    EXPECT_LT((moved.at(place) - there * curve.at(place)).norm(), 1e-14);
    EXPECT_NEAR(moved.width_at(place), std::sqrt(6.0) * curve.width_at(place), 1e-15);
  }
}

}  // namespace
}  // namespace icome::drawing
