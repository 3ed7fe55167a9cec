#include "geometry/sweep/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/polygon_triangulation.h"

namespace icome::geometry {
namespace {

using Ring = std::vector<Vector2>;

double area_of(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// Counter-clockwise; clockwise with the corners turned round.
Ring square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}
Ring turned_round(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

/// As a sheet and as a solid: the right area and volume, closed, one hole through it for each hole.
void expect_solid(const Outline& outline) {
  double area = area_of(outline.rim);
  for (const Ring& hole : outline.holes) area += area_of(hole);
  const auto sheet = solid_of_outlines({&outline, 1}, 0.0), solid = solid_of_outlines({&outline, 1}, 2.0);
  ASSERT_TRUE(sheet) << sheet.error().message;
  ASSERT_TRUE(solid) << solid.error().message;
  EXPECT_NEAR(surface_area(*sheet), area, 1e-12 * area);
  for (std::size_t t = 0; t < sheet->triangles.size(); ++t) {
    const Vector3 across =
        (sheet->corner(t, 1) - sheet->corner(t, 0)).cross(sheet->corner(t, 2) - sheet->corner(t, 0));
    EXPECT_GE(across.z(), 0.0);
  }
  EXPECT_TRUE(is_closed(*solid));
  EXPECT_EQ(euler_characteristic(*solid), 2 - 2 * int(outline.holes.size()));
  EXPECT_NEAR(volume(*solid), 2.0 * area, 1e-12 * area);
}

TEST(Outline, WithHolesInRowsAndColumns) {
  Outline outline{square(0, 0, 100)};
  for (int i = 0; i < 49; ++i)
    outline.holes.push_back(turned_round(square(4.0 + 14.0 * (i % 7), 4.0 + 14.0 * (i / 7), 8.0)));
  expect_solid(outline);
  std::reverse(outline.holes.begin(), outline.holes.end());
  expect_solid(outline);
}

TEST(Outline, WithAHoleThatNearlyFillsIt) {
  expect_solid({square(0, 0, 10), {turned_round(square(1, 1, 8))}});
  // Seen from the hole, all but the inner corners of the rim are hidden.
  expect_solid({{{0, 0}, {30, 0}, {30, 30}, {20, 30}, {20, 14}, {18, 15}, {20, 12}, {20, 10}, {0, 10}},
                {turned_round(square(3, 3, 4)), turned_round(square(21, 2, 7))}});
}

TEST(Outline, WithRandomStarsForHoles) {
  base::Random random(77);
  for (int round = 0; round < 100; ++round) {
    const auto star = [&](double x, double y, double size) {
      Ring ring;
      const int corners = 3 + int(random.index(12));
      for (int i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * (i + random.uniform(0.0, 0.7)) / corners;
        const double radius = size * random.uniform(0.3, 1.0);
        ring.emplace_back(std::round(x + radius * std::cos(angle)), std::round(y + radius * std::sin(angle)));
      }
      return ring;
    };
    Outline outline{square(-5000, -5000, 10000)};
    for (int i = 0; i < 16; ++i) {
      if (random.index(3) == 0) continue;
      Ring hole = star(-3750.0 + 2500.0 * (i % 4), -3750.0 + 2500.0 * (i / 4), 1200.0);
      if (area_of(hole) > 0.0) outline.holes.push_back(turned_round(std::move(hole)));
    }
    expect_solid(outline);
  }
}

TEST(Outline, SeveralArePiecesOfTheirOwn) {
  const std::vector<Outline> two{{square(0, 0, 2), {turned_round(square(0.5, 0.5, 1))}}, {square(2, 0, 2)}};
  const auto solid = solid_of_outlines(two, 1.0);
  ASSERT_TRUE(solid);
  EXPECT_TRUE(is_closed(*solid));
  EXPECT_EQ(euler_characteristic(*solid), 2);
  EXPECT_NEAR(volume(*solid), 3.0 + 4.0, 1e-14);
  EXPECT_TRUE(solid_of_outlines({}, 1.0)->triangles.empty());
}

TEST(Outline, RefusesRingsThatAreNone) {
  const auto refused = [](const Outline& outline, const std::string& why) {
    const auto made = solid_of_outlines({&outline, 1}, 1.0);
    ASSERT_FALSE(made) << why;
    EXPECT_NE(made.error().message.find(why), std::string::npos) << made.error().message;
  };
  refused({}, "3 corners");
  refused({{{0, 0}, {1, 0}}}, "3 corners");
  refused({square(0, 0, 9), {{{1, 1}, {2, 1}}}}, "3 corners");
  refused({square(0, 0, 9), {turned_round(square(20, 1, 1))}}, "not within its rim");
  refused({{{0, 0}, {1, 0}, {0, std::numeric_limits<double>::quiet_NaN()}}}, "finite");
  refused({square(0, 0, 9), {{{1, 1}, {1, HUGE_VAL}, {2, 1}}}}, "finite");
  refused({Ring(kMaximumPolygonCorners + 1, Vector2::Zero())}, "at most");
  refused({square(0, 0, 9), std::vector<Ring>(4000, square(1, 1, 1))}, "at most");
}

}  // namespace
}  // namespace icome::geometry
