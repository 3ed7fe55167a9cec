#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cutout/drawn_table.h"
#include "cutout/tracker/pose/outline_fit.h"
#include "cutout/tracker/pose/pose_hypotheses.h"

namespace icome::cutout {
namespace {

constexpr double kPartDegree = std::numbers::pi / 180;

TEST(TriangleCorners, AreAsTheyAreSeen) {
  // Apex up: in a picture with y down, the base lies below and its left corner comes next.
  const KnownTriangle triangle{"", 45 * kPartDegree, 30, ""};
  const auto corners = corners_of(triangle, {{100, 100}, std::numbers::pi / 2});
  EXPECT_LT((corners[0] - Vector2(100, 80)).norm(), 1e-9);
  EXPECT_LT((corners[1] - Vector2(70, 110)).norm(), 1e-9);
  EXPECT_LT((corners[2] - Vector2(130, 110)).norm(), 1e-9);
  const auto turned_right = corners_of(triangle, {{100, 100}, 0});
  EXPECT_LT((turned_right[0] - Vector2(120, 100)).norm(), 1e-9);
  EXPECT_LT((turned_right[1] - Vector2(90, 70)).norm(), 1e-9);
}

TEST(TriangleShape, HasTheAnglesAndHeightsOfItsTriangle) {
  for (const double degrees : {20.0, 45.0, 60.0, 80.0}) {
    const TriangleShape shape(KnownTriangle{"", degrees * kPartDegree, 50, ""});
    EXPECT_LT((shape.corners[0] + shape.corners[1] + shape.corners[2]).norm(), 1e-9);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector2 a = shape.corners[(i + 1) % 3] - shape.corners[i];
      const Vector2 b = shape.corners[(i + 2) % 3] - shape.corners[i];
      EXPECT_NEAR(std::acos(a.dot(b) / a.norm() / b.norm()), shape.corner_angles[i], 1e-9);
      EXPECT_NEAR(a.norm(), shape.lengths[i], 1e-9);
      EXPECT_LT(shape.offsets[i], 0);
      EXPECT_GT(shape.normals[i].dot(shape.corners[(i + 2) % 3]), shape.offsets[i]);
    }
    EXPECT_NEAR(shape.corners[0].x() - shape.corners[1].x(), 50, 1e-9);
    EXPECT_NEAR(depth_within(shape, {{5, 7}, 1.2}, {5, 7}),
                -std::max({shape.offsets[0], shape.offsets[1], shape.offsets[2]}), 1e-9);
  }
  EXPECT_EQ(within_half_turn(-std::numbers::pi), std::numbers::pi);
  EXPECT_NEAR(within_half_turn(7), 7 - 2 * std::numbers::pi, 1e-12);
}

/// The piece of an edge between two shares of its length, exactly.
EdgeSegment piece_of(const TriangleShape& shape, const Placed& placed, std::size_t edge, double from,
                     double to) {
  const auto corners = corners_of(shape, placed);
  const Vector2 start = corners[edge], way = corners[(edge + 1) % 3] - start;
  EdgeSegment segment;
  segment.normal = Vector2(-way.y(), way.x()).normalized();
  segment.offset = segment.normal.dot(start);
  segment.angle = std::atan2(segment.normal.y(), segment.normal.x());
  segment.from = segment.along().dot(start + from * way);
  segment.to = segment.along().dot(start + to * way);
  segment.points = int(segment.length());
  return segment;
}

TEST(PoseHypotheses, FindThePoseByAnyTwoPiecesOfEdges) {
  const KnownTriangles known = drawn_triangles(7);
  const std::vector<TriangleShape> shapes(known.triangles.begin(), known.triangles.end());
  const PoseHypotheses makes(shapes);
  base::Random random(3);
  for (std::size_t triangle = 0; triangle < shapes.size(); ++triangle)
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const Placed truth{{random.uniform(0, 500), random.uniform(0, 500)}, random.uniform(-3, 3)};
      const std::vector<EdgeSegment> segments = {piece_of(shapes[triangle], truth, edge, 0.2, 0.5),
                                                 piece_of(shapes[triangle], truth, (edge + 1) % 3, 0.6, 0.9)};
      std::vector<PoseHypothesis> found;
      makes.find(segments, 0.5, std::vector<bool>(shapes.size(), true), found);
      bool right = false;
      for (const PoseHypothesis& hypothesis : found)
        right |= hypothesis.triangle == triangle &&
                 (hypothesis.placed.centroid - truth.centroid).norm() < 1e-6 &&
                 std::abs(within_half_turn(hypothesis.placed.turn - truth.turn)) < 1e-9;
      EXPECT_TRUE(right) << triangle << " by edge " << edge;
      // A triangle that is not wanted is not looked for.
      std::vector<bool> wanted(shapes.size(), true);
      wanted[triangle] = false;
      makes.find(segments, 0.5, wanted, found);
      for (const PoseHypothesis& hypothesis : found) EXPECT_NE(hypothesis.triangle, triangle);
    }
}

TEST(PoseHypotheses, AreBounded) {
  base::Random random(3);
  KnownTriangles known;
  for (int i = 0; i < 300; ++i)
    known.triangles.push_back({"", random.uniform(30, 70) * kPartDegree, random.uniform(50, 60), ""});
  const std::vector<TriangleShape> shapes(known.triangles.begin(), known.triangles.end());
  std::vector<EdgeSegment> segments;
  for (int i = 0; i < 400; ++i)
    segments.push_back(piece_of(shapes[std::size_t(i) % 300],
                                {{random.uniform(0, 60), random.uniform(0, 60)}, random.uniform(-3, 3)},
                                std::size_t(i) % 3, 0.4, 0.6));
  std::vector<PoseHypothesis> found;
  PoseHypotheses(shapes).find(segments, 0.5, std::vector<bool>(shapes.size(), true), found);
  EXPECT_EQ(found.size(), PoseHypotheses::kMost);
}

class OutlineFitOnDrawn : public testing::Test {
 protected:
  OutlineFitOnDrawn() : view_(TableView::whole_frame(320, 240, 320, 240)), rectifier_(view_) {}

  OutlineFitted fit(const DrawnTable& table, const Placed& from, double window) {
    frame_ = table.frame(2, 1);
    OutlineFit fit(rectifier_, colours_);
    fit.look_at(frame_.view());
    return fit.fit(shape_, from, window, {});
  }

  TableView view_;
  Rectifier rectifier_;
  ColourClasses colours_;
  Frame frame_;
  KnownTriangle triangle_{"", 50 * kPartDegree, 70, ""};
  TriangleShape shape_{triangle_};
  Placed truth_{{160, 120}, 0.4};
};

TEST_F(OutlineFitOnDrawn, MovesToTheEdges) {
  DrawnTable table(view_);
  table.triangle(triangle_, pose_of(truth_));
  for (const auto& [x, y, turn] : {std::tuple(3.0, -2.0, 0.03), std::tuple(-4.0, 1.0, -0.05)}) {
    const OutlineFitted fitted = fit(table, {truth_.centroid + Vector2(x, y), truth_.turn + turn}, 8);
    EXPECT_LT((fitted.placed.centroid - truth_.centroid).norm(), 0.06);
    EXPECT_LT(std::abs(fitted.placed.turn - truth_.turn) / kPartDegree, 0.1);
    EXPECT_GT(fitted.evidence.support(), 0.95);
    EXPECT_EQ(fitted.evidence.contradicted, 0);
    EXPECT_LT(fitted.evidence.rms, 0.2);
    EXPECT_GT(fitted.information.determinant(), 0);
  }
}

TEST_F(OutlineFitOnDrawn, IsContradictedByRedWithin) {
  DrawnTable table(view_);
  table.triangle(triangle_, pose_of(truth_));
  const auto corners = corners_of(shape_, truth_);
  table.disc(corners[0], 25, kTableRed);
  const OutlineFitted fitted = fit(table, truth_, 0);
  EXPECT_GT(fitted.evidence.contradiction(), 0.1);
}

TEST_F(OutlineFitOnDrawn, KnowsNothingOfWhatAHandHides) {
  DrawnTable table(view_);
  table.triangle(triangle_, pose_of(truth_));
  const auto corners = corners_of(shape_, truth_);
  table.disc(corners[0], 25, kHandSkin);
  const OutlineFitted fitted = fit(table, truth_, 0);
  EXPECT_LE(fitted.evidence.contradiction(), 0.02);
  EXPECT_LT(fitted.evidence.support(), 0.85);
  EXPECT_GT(fitted.evidence.support(), 0.5);
  EXPECT_LT((fitted.placed.centroid - truth_.centroid).norm(), 0.1);
}

TEST_F(OutlineFitOnDrawn, TellsBlueBeyondUnlessAnotherTriangleLiesThere) {
  DrawnTable table(view_);
  table.triangle(triangle_, pose_of(truth_));
  const Placed other{truth_.centroid + Vector2(45, 10), 2};
  table.triangle(triangle_, pose_of(other));
  frame_ = table.frame(2, 1);
  OutlineFit fit(rectifier_, colours_);
  fit.look_at(frame_.view());
  const OutlineFitted alone = fit.fit(shape_, truth_, 0, {});
  EXPECT_GT(alone.evidence.beyond(), 0.1);
  const Neighbour neighbour{&shape_, other};
  const OutlineFitted beside = fit.fit(shape_, truth_, 0, {}, {&neighbour, 1});
  EXPECT_LT(beside.evidence.beyond(), 0.02);
  EXPECT_LT((beside.placed.centroid - truth_.centroid).norm(), 0.1);
}

}  // namespace
}  // namespace icome::cutout
