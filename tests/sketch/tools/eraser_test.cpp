#include "sketch/tools/eraser.h"

#include <gtest/gtest.h>

#include "drawing/test_drawings.h"
#include "sketch/dense_distance.h"

namespace icome::sketch {
namespace {

using drawing::judges::drawing_with;
using drawing::judges::random_curve;
using judges::LineDistance;

constexpr double kRubber = 0.012;  // m

std::vector<Vector2> eraser_way(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  std::vector<Vector2> way;
  for (int i = 0; i < 4; ++i) way.emplace_back(number(random), number(random));
  return way;
}

Drawing after(Drawing drawing, const DrawingEdit& edit) {
  EXPECT_TRUE(apply_edit(drawing, edit));
  return drawing;
}

/// What is left is beyond the radius, what was beyond it is left, with the widths that it had, all to a
/// thousandth of the radius.
void expect_erased(const Curve& curve, const Drawing& left, const std::vector<Vector2>& way,
                   double radius = kRubber) {
  const LineDistance from_way(way);
  std::vector<Vector2> rest;
  std::vector<double> widths;
  for (const StrokePointer& stroke : left.layers[0].strokes) {
    EXPECT_EQ(stroke->colour, (Colour{0.25F, 0.5F, 0.75F}));
    for (int k = 0; k <= 500 * int(stroke->curve.segments.size()); ++k) {
      rest.push_back(stroke->curve.at(k / 500.0));
      widths.push_back(stroke->curve.width_at(k / 500.0));
      EXPECT_GE(from_way.from(rest.back()), radius * 0.999);
    }
  }
  for (int k = 0; k <= 100 * int(curve.segments.size()); ++k) {
    const Vector2 place = curve.at(k / 100.0);
    if (from_way.from(place) < 1.002 * radius) continue;
    double least = 1.0;
    double width_off = 1.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      least = std::min(least, (rest[i] - place).norm());
      // The curve may cross itself, so that several widths belong to a place.
      if ((rest[i] - place).norm() < 4e-4)
        width_off = std::min(width_off, std::abs(widths[i] - curve.width_at(k / 100.0)));
    }
    EXPECT_LT(least, 4e-4) << "lost at " << k / 100.0;
    EXPECT_LT(width_off, 5e-5) << "width at " << k / 100.0;
  }
}

TEST(Erased, TakesAwayWhatIsNearerThanTheRadiusAndNothingElse) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Curve curve = random_curve(seed, 1 + seed % 4, seed % 2 == 1);
    const Drawing drawing = drawing_with({curve});
    const std::vector<Vector2> way = eraser_way(seed + 1000);
    std::uint64_t next_id = drawing.next_id;
    expect_erased(curve, after(drawing, erased(drawing, way, kRubber, false, next_id)), way);
  }
}

TEST(Erased, AClosedCurveErasedInOnePlaceIsOneOpenCurve) {
  for (const std::size_t segments : {1U, 2U, 5U}) {
    // A drop for one segment, else bows around the origin that do not cross.
    Curve ring = random_curve(3, segments, true);
    for (std::size_t i = 0; i < segments; ++i) {
      const double turn = 2.0 * std::numbers::pi / double(segments);
      const Vector2 from = judges::polar(0.1, turn * double(i));
      const Vector2 to = i + 1 == segments ? Vector2(0.1, 0.0) : judges::polar(0.1, turn * double(i + 1));
      const Vector2 aside(-from.y(), from.x());
      ring.segments[i] = {{from, from + 0.5 * aside, to - 0.5 * Vector2(-to.y(), to.x()), to}};
    }
    if (segments == 1) ring.segments = {{{Vector2(0, 0), Vector2(0.1, 0), Vector2(0, 0.1), Vector2(0, 0)}}};
    const Drawing drawing = drawing_with({ring});
    std::uint64_t next_id = drawing.next_id;
    const std::vector<Vector2> way = {ring.at(0.5)};
    const Drawing left = after(drawing, erased(drawing, way, 0.002, false, next_id));
    ASSERT_EQ(left.stroke_count(), 1U);
    const Stroke& stroke = *left.layers[0].strokes[0];
    expect_erased(ring, left, way, 0.002);
    EXPECT_FALSE(stroke.curve.closed);
    EXPECT_TRUE(stroke.fill);  // a gap in its rim does not empty an area
    EXPECT_NEAR((stroke.curve.at(0.0) - way[0]).norm(), 0.002, 4e-6);
    EXPECT_NEAR((stroke.curve.at(stroke.curve.end()) - way[0]).norm(), 0.002, 4e-6);
  }
}

TEST(Erased, TakesWholeStrokesThatItTouchesWhereThatIsAskedFor) {
  const Curve near = random_curve(1, 3);
  Curve far = near;
  for (CubicBezier& segment : far.segments)
    for (Vector2& point : segment.points) point += Vector2(1.0, 0.0);
  const Drawing drawing = drawing_with({near, far});
  std::uint64_t next_id = drawing.next_id;
  const std::vector<Vector2> way = {near.at(1.2)};
  const Drawing left = after(drawing, erased(drawing, way, 0.001, true, next_id));
  ASSERT_EQ(left.stroke_count(), 1U);
  EXPECT_EQ(left.layers[0].strokes[0], drawing.layers[0].strokes[1]);
  EXPECT_EQ(next_id, drawing.next_id);
}

TEST(Erased, LeavesHiddenAndLockedLayersAlone) {
  Drawing drawing = drawing_with({random_curve(1, 3)});
  std::uint64_t next_id = drawing.next_id;
  const std::vector<Vector2> way = {drawing.layers[0].strokes[0]->curve.at(1.2)};
  drawing.layers[0].locked = true;
  EXPECT_TRUE(erased(drawing, way, 0.01, false, next_id).empty());
  drawing.layers[0].locked = false;
  drawing.layers[0].visible = false;
  EXPECT_TRUE(erased(drawing, way, 0.01, true, next_id).empty());
}

}  // namespace
}  // namespace icome::sketch
