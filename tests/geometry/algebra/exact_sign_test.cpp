#include "geometry/algebra/exact_sign.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::geometry {
namespace {

using base::Vector3;
__extension__ using Whole = __int128;  // holds every determinant here without rounding

int sign_of(Whole value) { return (value > 0) - (value < 0); }

/// Whole numbers, small ones for many that are in line or in a plane, large ones for bits that doubles lose.
Vector3 lattice_point(base::Random& random, double cell, double fine) {
  Vector3 point;
  for (double& coordinate : point)
    coordinate = std::round(random.uniform(-3.0, 3.0)) * cell + std::round(random.uniform(-1.0, 1.0) * fine);
  return point;
}

std::array<Whole, 3> less(const Vector3& a, const Vector3& b) {
  return {Whole(a[0]) - Whole(b[0]), Whole(a[1]) - Whole(b[1]), Whole(a[2]) - Whole(b[2])};
}

TEST(ExactSign, IsThatOfTheDeterminantInWholeNumbers) {
  base::Random random(1);
  int flat = 0, wrong_in_doubles = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double cell = i % 3 == 0 ? 1.0 : std::ldexp(1.0, 36);
    const double fine = i % 4 == 0 ? 2.0 : 0.0;
    const Vector3 a = lattice_point(random, cell, fine), b = lattice_point(random, cell, fine),
                  c = lattice_point(random, cell, fine), d = lattice_point(random, cell, fine);
    const auto u = less(b, a), v = less(c, a), w = less(d, a);
    const Whole turn = u[0] * v[1] - u[1] * v[0];
    const Whole volume = u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                         u[2] * (v[0] * w[1] - v[1] * w[0]);
    ASSERT_EQ(turn_sign(a.head<2>(), b.head<2>(), c.head<2>()), sign_of(turn)) << i;
    ASSERT_EQ(side_sign(a, b, c, d), sign_of(volume)) << i;
    flat += volume == 0 ? 1 : 0;
    const double in_doubles = (b - a).cross(c - a).dot(d - a);
    wrong_in_doubles += (in_doubles > 0.0) - (in_doubles < 0.0) != sign_of(volume) ? 1 : 0;
  }
  EXPECT_GT(flat, 10'000);
  EXPECT_GT(wrong_in_doubles, 10);
}

TEST(ExactSign, TellsAPointOneBitOffALineOrAPlane) {
  base::Random random(2);
  for (int i = 0; i < 10'000; ++i) {
    // Twice and three times a vector are on its line, without rounding.
    const Vector3 a(std::ldexp(std::round(random.uniform(1.0, 1e6)), -30),
                    std::ldexp(std::round(random.uniform(1.0, 1e6)), -30), 0.0);
    const Vector3 b = 2.0 * a;
    Vector3 c = 3.0 * a;
    EXPECT_EQ(turn_sign(a.head<2>(), b.head<2>(), c.head<2>()), 0);
    EXPECT_EQ(side_sign(a, b, Vector3(0.0, 0.0, 1.0), c), 0);
    c.y() = std::nextafter(c.y(), 1e9);
    EXPECT_EQ(turn_sign(a.head<2>(), b.head<2>(), c.head<2>()), 1);
    EXPECT_EQ(turn_sign(b.head<2>(), a.head<2>(), c.head<2>()), -1);
    // To the left of the line, seen from above: the side from which a, b, and what is above turn clockwise.
    EXPECT_EQ(side_sign(a, b, Vector3(0.0, 0.0, 1.0), c), -1);
    EXPECT_EQ(side_sign(b, a, Vector3(0.0, 0.0, 1.0), c), 1);
  }
}

}  // namespace
}  // namespace icome::geometry
