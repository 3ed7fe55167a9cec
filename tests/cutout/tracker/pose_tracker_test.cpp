#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutout/drawn_table.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {
namespace {

using base::Matrix3;
using base::Vector2;

constexpr double kDegree = std::numbers::pi / 180;

TableView plain_view() { return TableView::whole_frame(640, 480, 640, 480); }

/// A camera that looks from the side through a lens that bends.
TableView slanted_view() {
  Lens lens{600, 600, 320, 240, -0.12, 0.03, 0.0005, -0.0004, 0};
  Matrix3 pixels_from_mm;
  pixels_from_mm << 0.9, 0.05, 30, -0.02, 0.8, 45, 1e-5, -2e-4, 1;
  return TableView::seen_by(lens, pixels_from_mm, 640, 480, 600, 480).value();
}

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

const Sighting* sighting_of(const std::vector<Sighting>& seen, std::size_t triangle) {
  for (const Sighting& sighting : seen)
    if (sighting.triangle == triangle) return &sighting;
  return nullptr;
}

Frame plain_frame(int width, int height, int blue, int green, int red) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.bgr.resize(3 * std::size_t(width) * std::size_t(height));
  for (std::size_t i = 0; i < frame.bgr.size(); i += 3) {
    frame.bgr[i] = std::uint8_t(blue);
    frame.bgr[i + 1] = std::uint8_t(green);
    frame.bgr[i + 2] = std::uint8_t(red);
  }
  return frame;
}

void expect_all_near(const std::vector<Sighting>& seen, const std::vector<TrianglePose>& truth,
                     double most_mm, double most_degrees) {
  ASSERT_EQ(seen.size(), truth.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].triangle, i);
    EXPECT_LT((seen[i].pose.centroid - truth[i].centroid).norm(), most_mm) << i;
    EXPECT_LT(turn_between(seen[i].pose.angle, truth[i].angle) / kDegree, most_degrees) << i;
  }
}

class PoseTrackerOnViews : public testing::TestWithParam<int> {};

TEST_P(PoseTrackerOnViews, FindsTwelveTrianglesToAFractionOfAPixel) {
  const TableView view = GetParam() == 0 ? plain_view() : slanted_view();
  const KnownTriangles known = drawn_triangles(GetParam() == 0 ? 12 : 8);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  base::Random random(7);
  double squares = 0, turn_squares = 0;
  int count = 0;
  for (int number = 0; number < 6; ++number) {
    const std::vector<TrianglePose> truth = scattered(known, view, random);
    DrawnTable table(view);
    for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
    const Frame frame = table.frame(3, std::uint64_t(number));
    const std::vector<Sighting> seen = tracker->see(frame.view(), number).value();
    expect_all_near(seen, truth, 0.3, 0.4);
    for (const Sighting& sighting : seen) {
      EXPECT_GT(sighting.confidence, 0.75);
      squares += (sighting.pose.centroid - truth[sighting.triangle].centroid).squaredNorm();
      turn_squares += std::pow(turn_between(sighting.pose.angle, truth[sighting.triangle].angle), 2);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.05);  // mm; a pixel is about one
  EXPECT_LT(std::sqrt(turn_squares / count) / kDegree, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Views, PoseTrackerOnViews, testing::Values(0, 1));

TEST(PoseTracker, FindsTrianglesWhoseCornersAreHidden) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(5);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  base::Random random(11);
  for (int number = 0; number < 4; ++number) {
    const std::vector<TrianglePose> truth = scattered(known, view, random);
    DrawnTable table(view);
    for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
    for (std::size_t i = 0; i < truth.size(); ++i)
      for (const Vector2& corner : corners_of(known.triangles[i], truth[i]))
        table.disc(corner, 11, kHandSkin);
    const Frame frame = table.frame(3, std::uint64_t(number));
    expect_all_near(tracker->see(frame.view(), number).value(), truth, 0.5, 0.8);
  }
}

TEST(PoseTracker, FindsATriangleByTwoOfItsEdges) {
  // The base and both of its corners are hidden.
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(4);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  for (std::size_t i = 0; i < known.triangles.size(); ++i) {
    const TrianglePose truth{{300, 240}, 0.4 + 1.3 * double(i)};
    DrawnTable table(view);
    table.triangle(known.triangles[i], truth);
    const auto corners = corners_of(known.triangles[i], truth);
    const Vector2 along = (corners[2] - corners[1]).normalized(), up(-along.y(), along.x());
    table.convex({corners[1] - 20 * along - 12 * up, corners[2] + 20 * along - 12 * up,
                  corners[2] + 20 * along + 12 * up, corners[1] - 20 * along + 12 * up},
                 kHandSkin);
    const Frame frame = table.frame(2, i);
    const std::vector<Sighting> seen = tracker->see(frame.view(), 0).value();
    ASSERT_EQ(seen.size(), 1U) << i;
    EXPECT_EQ(seen[0].triangle, i);
    EXPECT_LT((seen[0].pose.centroid - truth.centroid).norm(), 1.0);
    EXPECT_LT(turn_between(seen[0].pose.angle, truth.angle) / kDegree, 1.0);
    EXPECT_LT(seen[0].confidence, 0.8);
  }
}

TEST(PoseTracker, LooksBeyondSkinButNotBeyondRed) {
  // A triangle whose apex is cut off: red lies where blue must be. Under a hand, the same might be whole.
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(1);
  const TrianglePose truth{{320, 240}, 0.7};
  const auto corners = corners_of(known.triangles[0], truth);
  const Vector2 base = (corners[1] + corners[2]) / 2, to_apex = corners[0] - base;
  const Vector2 across(-to_apex.y(), to_apex.x());
  const std::vector<Vector2> cap = {base + 0.45 * to_apex - across, base + 0.45 * to_apex + across,
                                    base + 1.2 * to_apex + across, base + 1.2 * to_apex - across};
  for (const bool skin : {true, false}) {
    DrawnTable table(view);
    table.triangle(known.triangles[0], truth);
    table.convex(cap, skin ? kHandSkin : kTableRed);
    const Frame frame = table.frame(2, 3);
    const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
    EXPECT_EQ(tracker->see(frame.view(), 0).value().size(), skin ? 1U : 0U);
  }
}

TEST(PoseTracker, SeesNoTriangleInAStripOfBlue) {
  // A sleeve: two long edges and an end, none of which encloses a triangle.
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(7);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  for (int i = 0; i < 8; ++i) {
    const double turn = 0.35 * i;
    const Vector2 along(std::cos(turn), std::sin(turn)), up(-along.y(), along.x()), middle(320, 240);
    DrawnTable table(view);
    table.convex(
        {middle - 30 * up, middle + 30 * up, middle + 400 * along + 45 * up, middle + 400 * along - 45 * up},
        kPaperBlue);
    const Frame frame = table.frame(3, std::uint64_t(i));
    EXPECT_TRUE(tracker->see(frame.view(), 0).value().empty()) << i;
  }
}

TEST(PoseTracker, TellsTrianglesOfOneAngleByTheirHeight) {
  KnownTriangles known;
  known.triangles = {{"small", 50 * kDegree, 50, ""}, {"large", 50 * kDegree, 55, ""}};
  const TableView view = plain_view();
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  const std::vector<TrianglePose> truth = {{{200, 200}, 0.3}, {{420, 260}, -2.0}};
  DrawnTable table(view);
  for (std::size_t i = 0; i < 2; ++i) table.triangle(known.triangles[i], truth[i]);
  const Frame frame = table.frame(3, 1);
  expect_all_near(tracker->see(frame.view(), 0).value(), truth, 0.3, 0.4);
}

TEST(PoseTracker, SeesAnEquilateralTriangleInOneOfItsThreeTurns) {
  KnownTriangles known;
  known.triangles = {{"three-fold", 60 * kDegree, 60, ""}};
  const TableView view = plain_view();
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  const TrianglePose truth{{320, 240}, 0.2};
  DrawnTable table(view);
  table.triangle(known.triangles[0], truth);
  const Frame frame = table.frame(3, 1);
  const std::vector<Sighting> seen = tracker->see(frame.view(), 0).value();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT((seen[0].pose.centroid - truth.centroid).norm(), 0.3);
  const double third = std::remainder(seen[0].pose.angle - truth.angle, 2 * std::numbers::pi / 3);
  EXPECT_LT(std::abs(third) / kDegree, 0.4);
}

TEST(PoseTracker, SeesBlueOnRedOnly) {
  // Red triangles on blue have all edges the other way round.
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(4);
  base::Random random(3);
  const std::vector<TrianglePose> truth = scattered(known, view, random);
  DrawnTable table(view, kPaperBlue);
  for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i], kTableRed);
  const Frame frame = table.frame(3, 1);
  EXPECT_TRUE(make_pose_tracker(known, view, false)->see(frame.view(), 0).value().empty());
}

TEST(PoseTracker, FindsTrianglesInFallingLight) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(6);
  base::Random random(23);
  const std::vector<TrianglePose> truth = scattered(known, view, random);
  DrawnTable table(view);
  for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
  Frame frame = table.frame(2, 1);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        std::uint8_t& value = frame.bgr[3 * (std::size_t(y) * 640 + std::size_t(x)) + std::size_t(channel)];
        value = std::uint8_t(value * (1.0 - 0.6 * x / 640.0));
      }
  expect_all_near(make_pose_tracker(known, view, false)->see(frame.view(), 0).value(), truth, 0.3, 0.4);
}

/// The frame as cameras and video files keep it (4:2:0): brightness of each pixel, colour of each four, which
/// is repeated or, to the nearest quarters, interpolated.
Frame with_halved_colours(const Frame& frame, bool interpolated) {
  const auto at = [&](int x, int y, int c) {
    x = std::clamp(x, 0, frame.width - 1), y = std::clamp(y, 0, frame.height - 1);
    return double(
        frame.bgr[3 * (std::size_t(y) * std::size_t(frame.width) + std::size_t(x)) + std::size_t(c)]);
  };
  const auto brightness = [&](int x, int y) {
    return 0.114 * at(x, y, 0) + 0.587 * at(x, y, 1) + 0.299 * at(x, y, 2);
  };
  const auto of_four = [&](int i, int j, int c) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const int x = std::clamp(2 * i + k % 2, 0, frame.width - 1),
                y = std::clamp(2 * j + k / 2, 0, frame.height - 1);
      sum += at(x, y, c) - brightness(x, y);
    }
    return sum / 4;
  };
  Frame halved = frame;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const int i = x / 2, j = y / 2, di = x % 2 ? 1 : -1, dj = y % 2 ? 1 : -1;
      double blue = 0, red = 0;
      for (const int c : {0, 2}) {
        double value = of_four(i, j, c);
        if (interpolated)
          value = (9 * value + 3 * of_four(i + di, j, c) + 3 * of_four(i, j + dj, c) +
                   of_four(i + di, j + dj, c)) /
                  16;
        (c == 0 ? blue : red) = value;
      }
      const double grey = brightness(x, y);
      const double green = -(0.114 * blue + 0.299 * red) / 0.587;
      const double channels[] = {grey + blue, grey + green, grey + red};
      for (std::size_t c = 0; c < 3; ++c)
        halved.bgr[3 * (std::size_t(y) * std::size_t(frame.width) + std::size_t(x)) + c] =
            std::uint8_t(std::lround(std::clamp(channels[c], 0.0, 255.0)));
    }
  return halved;
}

/// The corners of a triangle whose edges lie farther out by that much, mm.
std::vector<Vector2> widened(const std::array<Vector2, 3>& corners, double by) {
  std::array<double, 3> opposite{};
  for (std::size_t i = 0; i < 3; ++i) opposite[i] = (corners[(i + 1) % 3] - corners[(i + 2) % 3]).norm();
  const double around = opposite[0] + opposite[1] + opposite[2];
  const Vector2 middle =
      (opposite[0] * corners[0] + opposite[1] * corners[1] + opposite[2] * corners[2]) / around;
  const Vector2 one = corners[1] - corners[0], other = corners[2] - corners[0];
  const double inner_radius = std::abs(one.x() * other.y() - one.y() * other.x()) / around;
  std::vector<Vector2> wide;
  for (const Vector2& corner : corners) wide.push_back(middle + (1 + by / inner_radius) * (corner - middle));
  return wide;
}

TEST(PoseTracker, FindsTrianglesThatAllLookALittleLargerThanTheListSays) {
  const TableView view = TableView::whole_frame(640, 480, 640, 480);
  const KnownTriangles known = drawn_triangles(8);
  base::Random random(43);
  std::size_t found = 0;
  constexpr int kFrames = 6;
  for (int i = 0; i < kFrames; ++i) {
    const double by = i % 2 == 0 ? 0.8 : -0.8;  // mm, which are pixels here
    const std::vector<TrianglePose> truth = scattered(known, view, random);
    DrawnTable table(view);
    for (std::size_t t = 0; t < truth.size(); ++t)
      table.convex(widened(corners_of(known.triangles[t], truth[t]), by), kPaperBlue);
    const auto seen = make_pose_tracker(known, view, false)->see(table.frame(1, std::uint64_t(i)).view(), 0);
    ASSERT_TRUE(seen);
    found += seen->size();
    for (const Sighting& sighting : *seen)
      EXPECT_LT((sighting.pose.centroid - truth[sighting.triangle].centroid).norm(), 0.2);
  }
  EXPECT_GE(found, std::size_t(0.95 * kFrames * 8));
}

TEST(PoseTracker, FindsTrianglesWhoseColoursAreKeptAtHalfTheSize) {
  const TableView view = TableView::whole_frame(640, 480, 640, 480);
  const KnownTriangles known = drawn_triangles(8);
  for (const bool interpolated : {true, false}) {
    base::Random random(41);
    std::size_t found = 0;
    double squares = 0;
    constexpr int kFrames = 8;
    for (int i = 0; i < kFrames; ++i) {
      const std::vector<TrianglePose> truth = scattered(known, view, random);
      DrawnTable table(view);
      for (std::size_t t = 0; t < truth.size(); ++t) table.triangle(known.triangles[t], truth[t]);
      const Frame frame = with_halved_colours(table.frame(1, std::uint64_t(i)), interpolated);
      const auto seen = make_pose_tracker(known, view, false)->see(frame.view(), 0);
      ASSERT_TRUE(seen);
      for (const Sighting& sighting : *seen) {
        const double off = (sighting.pose.centroid - truth[sighting.triangle].centroid).norm();
        EXPECT_LT(off, 1.0);
        squares += off * off;
        ++found;
      }
    }
    EXPECT_GE(found, std::size_t(0.97 * kFrames * 8)) << interpolated;
    EXPECT_LT(std::sqrt(squares / double(found)), 0.25) << interpolated;
  }
}

TEST(PoseTracker, FollowsTrianglesThatMove) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(3);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
  for (int number = 0; number < 30; ++number) {
    const double t = number / 30.0;
    const std::vector<TrianglePose> truth = {
        {{120 + 350 * t, 120}, 0.5 + 3 * t},
        {{320 + 80 * std::cos(5 * t), 330 + 80 * std::sin(5 * t)}, -5 * t},
        {{520, 120 + 200 * t * t}, 2}};
    DrawnTable table(view);
    for (std::size_t i = 0; i < 3; ++i) table.triangle(known.triangles[i], truth[i]);
    const Frame frame = table.frame(3, std::uint64_t(number));
    std::vector<TrianglePose> expected = truth;
    for (TrianglePose& pose : expected) pose.angle = std::remainder(pose.angle, 2 * std::numbers::pi);
    expect_all_near(tracker->see(frame.view(), t).value(), expected, 0.3, 0.4);
  }
}

TEST(PoseTracker, HoldsStillWhatLiesStill) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(4);
  base::Random random(5);
  const std::vector<TrianglePose> truth = scattered(known, view, random);
  DrawnTable table(view);
  for (std::size_t i = 0; i < truth.size(); ++i) table.triangle(known.triangles[i], truth[i]);
  const std::unique_ptr<Tracker> follows = make_pose_tracker(known, view, true);
  const std::unique_ptr<Tracker> searches = make_pose_tracker(known, view, false);
  double steps_followed = 0, steps_searched = 0;
  std::vector<Sighting> last_followed, last_searched;
  for (int number = 0; number < 20; ++number) {
    const Frame frame = table.frame(6, std::uint64_t(number));
    const std::vector<Sighting> followed = follows->see(frame.view(), number / 30.0).value();
    const std::vector<Sighting> searched = searches->see(frame.view(), number / 30.0).value();
    ASSERT_EQ(followed.size(), 4U);
    ASSERT_EQ(searched.size(), 4U);
    for (std::size_t i = 0; i < 4 && number > 5; ++i) {
      steps_followed += (followed[i].pose.centroid - last_followed[i].pose.centroid).norm();
      steps_searched += (searched[i].pose.centroid - last_searched[i].pose.centroid).norm();
      EXPECT_LT((followed[i].pose.centroid - truth[i].centroid).norm(), 0.1);
    }
    last_followed = followed;
    last_searched = searched;
  }
  EXPECT_LT(steps_followed, 0.5 * steps_searched);
}

TEST(PoseTracker, ReportsNothingThatIsHiddenForLong) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(2);
  const std::vector<TrianglePose> truth = {{{200, 240}, 1}, {{440, 240}, 2}};
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
  for (int number = 0; number < 30; ++number) {
    DrawnTable table(view);
    for (std::size_t i = 0; i < 2; ++i) table.triangle(known.triangles[i], truth[i]);
    const bool hidden = number >= 10 && number < 20;
    if (hidden) table.disc(truth[0].centroid, 90, kHandSkin);
    const Frame frame = table.frame(3, std::uint64_t(number));
    const std::vector<Sighting> seen = tracker->see(frame.view(), number / 30.0).value();
    if (number >= 15 && number < 20) {
      ASSERT_EQ(seen.size(), 1U) << number;
      EXPECT_EQ(seen[0].triangle, 1U);
    } else if (number < 10 || number >= 23) {
      EXPECT_EQ(seen.size(), 2U) << number;
    }
  }
}

TEST(PoseTracker, KeepsWhichIsWhichWhenLookAlikesCross) {
  // Two triangles of nearly one shape; each passes over the path of the other, one above the other for a
  // while.
  KnownTriangles known;
  known.triangles = {{"one", 50 * kDegree, 60, ""}, {"other", 51 * kDegree, 61, ""}};
  const TableView view = TableView::whole_frame(420, 180, 420, 180);
  for (const double apart : {0.0, 18.0, 40.0}) {
    const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
    int both = 0;
    for (int number = 0; number < 60; ++number) {
      const double t = number / 30.0;
      const std::vector<TrianglePose> truth = {{{70 + 140 * t, 75}, 1 + 0.5 * t},
                                               {{350 - 140 * t, 75 + apart}, 1.4 - 0.5 * t}};
      DrawnTable table(view);
      for (std::size_t i = 0; i < 2; ++i) table.triangle(known.triangles[i], truth[i]);
      const Frame frame = table.frame(3, std::uint64_t(number));
      const std::vector<Sighting> seen = tracker->see(frame.view(), t).value();
      both += seen.size() == 2;
      for (const Sighting& sighting : seen)
        EXPECT_LT((sighting.pose.centroid - truth[sighting.triangle].centroid).norm(), 12)
            << apart << " at " << number;
    }
    EXPECT_GT(both, 40) << apart;
  }
}

TEST(PoseTracker, FindsATriangleAgainThatWasMovedInTheDark) {
  const TableView view = plain_view();
  const KnownTriangles known = drawn_triangles(3);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
  for (int number = 0; number < 12; ++number) {
    std::vector<TrianglePose> truth = {{{120, 120}, 1}, {{440, 240}, 2}, {{200, 360}, 0}};
    if (number >= 6) truth[0] = {{420, 90}, -2};
    DrawnTable table(view);
    for (std::size_t i = 0; i < 3; ++i) table.triangle(known.triangles[i], truth[i]);
    const Frame frame = table.frame(3, std::uint64_t(number));
    const std::vector<Sighting> seen = tracker->see(frame.view(), number / 30.0).value();
    if (number != 6) expect_all_near(seen, truth, 0.3, 0.4);
  }
}

TEST(PoseTracker, AdaptsToColoursThatSlowlyChange) {
  // The table fades until what is red for a tracker that begins then is red no longer.
  const TableView view = TableView::whole_frame(320, 240, 320, 240);
  const KnownTriangles known = drawn_triangles(2);
  const std::vector<TrianglePose> truth = {{{90, 120}, 1}, {{230, 120}, 2}};
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
  for (int number = 0; number <= 40; ++number) {
    const double faded = 90 * number / 40.0;
    DrawnTable table(view, {40 + faded, 35 + faded, 190});
    for (std::size_t i = 0; i < 2; ++i) table.triangle(known.triangles[i], truth[i]);
    const Frame frame = table.frame(3, std::uint64_t(number));
    expect_all_near(tracker->see(frame.view(), number).value(), truth, 0.3, 0.4);
    if (number == 40) {
      EXPECT_TRUE(make_pose_tracker(known, view)->see(frame.view(), 0).value().empty());
      tracker->forget();  // also what it learnt of colours
      EXPECT_TRUE(tracker->see(frame.view(), number + 1).value().empty());
    }
  }
}

TEST(PoseTracker, RefusesAFrameOfAnotherSize) {
  const Frame frame = plain_frame(320, 240, 0, 0, 200);
  const auto seen = make_pose_tracker(drawn_triangles(1), plain_view())->see(frame.view(), 0);
  ASSERT_FALSE(seen.has_value());
  EXPECT_NE(seen.error().message.find("320 x 240"), std::string::npos);
  EXPECT_NE(seen.error().message.find("640 x 480"), std::string::npos);
}

/// Frames that show nothing, in sizes from a pixel to more than any camera's.
class PoseTrackerBounds : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PoseTrackerBounds, SeesNothingInPlainColours) {
  const auto [width, height] = GetParam();
  const TableView view = TableView::whole_frame(width, height, 640, 480);
  for (const bool tracks : {false, true}) {
    const std::unique_ptr<Tracker> tracker = make_pose_tracker(drawn_triangles(12), view, tracks);
    for (const auto& [blue, green, red] :
         {std::tuple(200, 70, 30), std::tuple(30, 30, 200), std::tuple(0, 0, 0), std::tuple(255, 255, 255)}) {
      const Frame frame = plain_frame(width, height, blue, green, red);
      EXPECT_TRUE(tracker->see(frame.view(), 0).value().empty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PoseTrackerBounds,
                         testing::Values(std::pair(1, 1), std::pair(1, 480), std::pair(640, 1),
                                         std::pair(7, 9), std::pair(17, 33), std::pair(7680, 4320)));

TEST(PoseTracker, IsNotMisledByNoise) {
  const TableView view = plain_view();
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(drawn_triangles(12), view, false);
  base::Random random(1);
  for (const int cell : {1, 3, 8}) {
    // Squares of red and blue at random, of `cell` pixels.
    Frame frame = plain_frame(640, 480, 30, 30, 200);
    for (int y = 0; y < 480; y += cell)
      for (int x = 0; x < 640; x += cell)
        if (random.uniform() < 0.5)
          for (int j = y; j < std::min(480, y + cell); ++j)
            for (int i = x; i < std::min(640, x + cell); ++i) {
              const std::size_t at = 3 * (std::size_t(j) * 640 + std::size_t(i));
              frame.bgr[at] = 200, frame.bgr[at + 2] = 30;
            }
    const std::vector<Sighting> seen = tracker->see(frame.view(), 0).value();
    for (const Sighting& sighting : seen)
      ADD_FAILURE() << "triangle " << sighting.triangle << " in squares of " << cell;
  }
}

TEST(PoseTracker, ManagesAThousandKnownTriangles) {
  KnownTriangles known;
  base::Random random(9);
  for (int i = 0; i < 1000; ++i)
    known.triangles.push_back(
        {std::to_string(i), random.uniform(20, 85) * kDegree, random.uniform(30, 90), ""});
  const TableView view = plain_view();
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view, false);
  const TrianglePose truth{{320, 240}, 1};
  DrawnTable table(view);
  table.triangle(known.triangles[17], truth);
  const Frame frame = table.frame(2, 1);
  const std::vector<Sighting> seen = tracker->see(frame.view(), 0).value();
  // One of nearly the same shape may be taken for it.
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_LT((seen[0].pose.centroid - truth.centroid).norm(), 3);
  EXPECT_NE(sighting_of(seen, seen[0].triangle), nullptr);
}

TEST(PoseTracker, IsBoundedOnATableFullOfTriangles) {
  const TableView view = TableView::whole_frame(1280, 960, 640, 480);
  KnownTriangles known;
  base::Random random(2);
  for (int i = 0; i < 1000; ++i)
    known.triangles.push_back(
        {std::to_string(i), random.uniform(30, 80) * kDegree, random.uniform(10, 20), ""});
  DrawnTable table(view);
  for (const KnownTriangle& triangle : known.triangles)
    table.triangle(triangle, {{random.uniform(0, 640), random.uniform(0, 480)}, random.uniform(-3, 3)});
  const Frame frame = table.frame(2, 1);
  const std::unique_ptr<Tracker> tracker = make_pose_tracker(known, view);
  for (int number = 0; number < 2; ++number) {
    const std::vector<Sighting> seen = tracker->see(frame.view(), number / 30.0).value();
    for (const Sighting& sighting : seen)
      EXPECT_TRUE(sighting.pose.centroid.allFinite() && std::isfinite(sighting.pose.angle));
  }
}

}  // namespace
}  // namespace icome::cutout
