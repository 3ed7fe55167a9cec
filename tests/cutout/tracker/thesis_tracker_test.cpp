#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cutout/drawn_table.h"
#include "cutout/tracker/thesis/hough_lines.h"
#include "cutout/tracker/thesis/isosceles_triples.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kThesisDegree = std::numbers::pi / 180;

TableView thesis_view() { return TableView::whole_frame(640, 480, 640, 480); }

double off_half_turn(double a, double b) { return std::abs(std::remainder(a - b, std::numbers::pi)); }

/// Lines through the edges of triangles, as equation 3.2 has them.
std::vector<HoughLine> lines_of(const KnownTriangle& triangle, const TrianglePose& pose) {
  const auto corners = corners_of(triangle, pose);
  std::vector<HoughLine> lines;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 way = corners[(i + 1) % 3] - corners[i];
    double theta = std::atan2(way.x(), -way.y());
    if (theta < 0) theta += std::numbers::pi;
    lines.push_back({corners[i].x() * std::cos(theta) + corners[i].y() * std::sin(theta), theta, 50});
  }
  return lines;
}

TEST(HoughLines, FindsLinesOfMarks) {
  base::Random random(4);
  for (int round = 0; round < 20; ++round) {
    // Two lines of marks and as many scattered ones.
    std::vector<HoughLine> truth;
    std::vector<Vector2> marks;
    for (int i = 0; i < 2; ++i) {
      const double theta = random.uniform(0, std::numbers::pi), rho = random.uniform(-200, 200);
      truth.push_back({rho, theta, 0});
      const Vector2 normal(std::cos(theta), std::sin(theta)), along(-normal.y(), normal.x());
      const double start = random.uniform(-100, 100);
      for (int k = 0; k < 80; ++k) marks.push_back(rho * normal + (start + k) * along);
    }
    for (int k = 0; k < 100; ++k) marks.emplace_back(random.uniform(-300, 300), random.uniform(-300, 300));
    std::vector<HoughLine> lines;
    HoughLines().find(marks, 1, 40, 50, lines);
    for (const HoughLine& wanted : truth) {
      bool found = false;
      for (const HoughLine& line : lines) {
        const double sign = std::cos(line.theta - wanted.theta) > 0 ? 1 : -1;
        // Two lines of one place differ by their angle about the marks, far from where rho is measured.
        found |= off_half_turn(line.theta, wanted.theta) < 1.5 * kThesisDegree &&
                 std::abs(sign * line.rho - wanted.rho) < 8;
      }
      EXPECT_TRUE(found) << round;
    }
  }
}

TEST(IsoscelesTriples, RecoversPosesFromExactLines) {
  const KnownTriangles known = drawn_triangles(7);
  base::Random random(8);
  for (std::size_t i = 0; i < known.triangles.size(); ++i) {
    const TrianglePose pose{{random.uniform(100, 500), random.uniform(100, 400)}, random.uniform(-3, 3)};
    const std::vector<KnownTriple> triples = isosceles_triples(lines_of(known.triangles[i], pose), known, 1);
    ASSERT_EQ(triples.size(), 1U) << i;
    EXPECT_EQ(triples[0].triangle, i);
    EXPECT_LT((triples[0].pose.centroid - pose.centroid).norm(), 1e-6);
    EXPECT_LT(std::abs(std::remainder(triples[0].pose.angle - pose.angle, 2 * std::numbers::pi)), 1e-6);
    EXPECT_LT(triples[0].mismatch, 1e-6);
  }
}

TEST(IsoscelesTriples, LeavesOutOtherAnglesAndHeights) {
  KnownTriangles known, other;
  known.triangles = {{"known", 50 * kThesisDegree, 60, ""}};
  other.triangles = {{"flatter", 45 * kThesisDegree, 60, ""}, {"higher", 50 * kThesisDegree, 66, ""}};
  for (const KnownTriangle& triangle : other.triangles)
    EXPECT_TRUE(isosceles_triples(lines_of(triangle, {{200, 200}, 1}), known, 1).empty()) << triangle.id;
}

TEST(ThesisTracker, FindsTrianglesThatLieOpen) {
  const TableView view = thesis_view();
  const KnownTriangles known = drawn_triangles(4);
  const std::unique_ptr<Tracker> tracker = make_thesis_tracker(known, view);
  base::Random random(12);
  int found = 0;
  for (int number = 0; number < 10; ++number) {
    const std::vector<TrianglePose> truth = scattered(known, view, random);
    DrawnTable table(view);
    for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
    const Frame frame = table.frame(3, std::uint64_t(number));
    const std::vector<Sighting> seen = tracker->see(frame.view(), 0).value();
    for (const Sighting& sighting : seen)
      found += (sighting.pose.centroid - truth[sighting.triangle].centroid).norm() < 2 &&
               std::abs(std::remainder(sighting.pose.angle - truth[sighting.triangle].angle,
                                       2 * std::numbers::pi)) < 3 * kThesisDegree;
  }
  EXPECT_GE(found, 37);  // of 40
}

TEST(ThesisTracker, LeavesOutEdgesToSkin) {
  // A hand with straight edges on a triangle: no line is seen where blue meets skin.
  const TableView view = thesis_view();
  KnownTriangles known;
  known.triangles = {{"one", 50 * kThesisDegree, 60, ""}};
  DrawnTable table(view);
  table.convex({{100, 100}, {500, 100}, {500, 400}, {100, 400}}, kPaperBlue);
  table.triangle(known.triangles[0], {{300, 250}, 1}, kHandSkin);
  const Frame frame = table.frame(2, 1);
  EXPECT_TRUE(make_thesis_tracker(known, view)->see(frame.view(), 0).value().empty());
}

TEST(ThesisTracker, NeedsAllThreeEdgesAndThePoseTrackerDoesNot) {
  const TableView view = thesis_view();
  const KnownTriangles known = drawn_triangles(6);
  const std::unique_ptr<Tracker> thesis = make_thesis_tracker(known, view);
  const std::unique_ptr<Tracker> pose = make_pose_tracker(known, view, false);
  base::Random random(31);
  int by_thesis = 0, by_pose = 0;
  for (int number = 0; number < 6; ++number) {
    const std::vector<TrianglePose> truth = scattered(known, view, random);
    DrawnTable table(view);
    for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      // A finger lies on the base.
      const auto corners = corners_of(known.triangles[i], truth[i]);
      const Vector2 along = (corners[2] - corners[1]).normalized(), up(-along.y(), along.x());
      table.convex({corners[1] - 5 * along - 6 * up, corners[2] + 5 * along - 6 * up,
                    corners[2] + 5 * along + 6 * up, corners[1] - 5 * along + 6 * up},
                   kHandSkin);
    }
    const Frame frame = table.frame(3, std::uint64_t(number));
    const auto count = [&](Tracker& tracker) {
      int good = 0;
      const std::vector<Sighting> seen = tracker.see(frame.view(), 0).value();
      for (const Sighting& sighting : seen)
        good += (sighting.pose.centroid - truth[sighting.triangle].centroid).norm() < 2;
      return good;
    };
    by_thesis += count(*thesis);
    by_pose += count(*pose);
  }
  EXPECT_GE(by_pose, 30);  // of 36
  EXPECT_LE(by_thesis, 3);
}

TEST(ThesisTracker, RefusesAFrameOfAnotherSizeAndSeesNothingInPlainOnes) {
  Frame frame;
  frame.width = 640, frame.height = 480;
  frame.bgr.assign(3 * 640 * 480, 120);
  const std::unique_ptr<Tracker> tracker = make_thesis_tracker(drawn_triangles(3), thesis_view());
  EXPECT_TRUE(tracker->see(frame.view(), 0).value().empty());
  frame.width = 1, frame.height = 1;
  EXPECT_FALSE(tracker->see(frame.view(), 0).has_value());
  const std::unique_ptr<Tracker> tiny =
      make_thesis_tracker(drawn_triangles(3), TableView::whole_frame(1, 1, 9, 9));
  EXPECT_TRUE(tiny->see(frame.view(), 0).value().empty());
}

}  // namespace
}  // namespace icome::cutout
