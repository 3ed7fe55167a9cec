#include "geometry/primitive/primitive_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/random.h"

namespace icome::geometry {
namespace {

const std::vector<std::string>& crossed_primitives() {
  static const std::vector<std::string> kAll = {
      "box:1x2x3",    "sphere:1",      "cylinder:1x2", "cylinder:0.01x2", "cone:1x2",
      "cone:1x0.3x2", "cone:0.2x1x1",  "cone:0x1x1",   "torus:1x0.3",     "torus:1x0.01",
      "capsule:1x2",  "capsule:0.2x3", "plane",        "cone:1x1x2",      "box:1x1x0.0001"};
  return kAll;
}

Primitive named_primitive(const std::string& text) { return *parse_primitive(text); }

/// The first change of side along the way, by looking at many places of it.
std::optional<double> sampled_crossing(const Primitive& primitive, const Vector3& start, const Vector3& step,
                                       int samples) {
  const bool first = inside(primitive, start);
  for (int i = 1; i <= samples; ++i) {
    double a = double(i - 1) / samples, b = double(i) / samples;
    if (inside(primitive, start + b * step) == first) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (a + b);
      (inside(primitive, start + middle * step) == first ? a : b) = middle;
    }
    return b;
  }
  return std::nullopt;
}

TEST(PrimitiveCrossing, IsWhereSamplesChangeSides) {
  constexpr int kSamples = 1000;
  for (const std::string& name : crossed_primitives()) {
    const Primitive primitive = named_primitive(name);
    base::Random random(7);
    int met = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3 start = random.uniform(0.0, 4.0) * random.direction();
      // Most of them past some place of the surface.
      const Vector3 near = scp_from_outside(primitive, random.uniform(0.0, 2.0) * random.direction()).point;
      const Vector3 step = 1.7 * (near + random.uniform(0.0, 0.02) * random.direction() - start);
      const auto exact = first_crossing(primitive, start, step);
      const auto sampled = sampled_crossing(primitive, start, step, kSamples);
      if (exact) {
        EXPECT_NEAR(signed_distance(primitive, start + *exact * step), 0.0, 1e-10) << name;
      }
      if (!sampled) continue;
      ++met;
      ASSERT_TRUE(exact) << name << " " << i;
      // Samples step over thin parts; what they find must not be there before.
      EXPECT_LE(*exact, *sampled + 1e-9) << name << " " << i;
      if (*exact < *sampled - 1e-9) {
        const double before =
            sampled_crossing(primitive, start, (*exact + 0.5 / kSamples) * step, 200'000).value_or(2.0);
        EXPECT_LE(before * (*exact + 0.5 / kSamples), *exact + 1e-9) << name << " " << i;
      }
    }
    EXPECT_GT(met, 30) << name;
  }
}

TEST(PrimitiveCrossing, IsTheSameAtEveryScaleAndFromAfar) {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const Primitive small = Cone{0.5 * scale, 0.2 * scale, 1.0 * scale};
    const Primitive one = Cone{0.5, 0.2, 1.0};
    const Vector3 start(3.0, 1.0, 0.4), step(-6.0, -2.1, -0.7);
    EXPECT_NEAR(first_crossing(small, scale * start, scale * step).value(),
                first_crossing(one, start, step).value(), 1e-12);
  }
  // From a million sizes away only the start's own rounding is left.
  const Vector3 direction = Vector3(1.0, 2.0, -0.3).normalized();
  const Vector3 start = -1e6 * direction;
  const double t = first_crossing(Sphere{1.0}, start, 2e6 * direction).value();
  EXPECT_NEAR(2e6 * t, 1e6 - 1.0, 1e-9);
  EXPECT_NEAR(
      2e6 * first_crossing(Torus{1.0, 0.2}, start, 2e6 * direction).value(),
      1e6 + 2e6 * first_crossing(Torus{1.0, 0.2}, -2.0 * direction, 4e6 * direction).value() * 2.0 - 2.0,
      1e-8);
}

TEST(PrimitiveCrossing, FromWithinItIsTheWayOut) {
  EXPECT_DOUBLE_EQ(first_crossing(Sphere{1.0}, Vector3::Zero(), Vector3(4, 0, 0)).value(), 0.25);
  EXPECT_DOUBLE_EQ(first_crossing(Box{Vector3(1, 2, 3)}, Vector3::Zero(), Vector3(0, 8, 0)).value(), 0.25);
  EXPECT_DOUBLE_EQ(first_crossing(Cylinder{1.0, 2.0}, Vector3::Zero(), Vector3(0, 0, -4)).value(), 0.25);
  EXPECT_DOUBLE_EQ(first_crossing(Capsule{1.0, 2.0}, Vector3::Zero(), Vector3(0, 0, 4)).value(), 0.5);
  EXPECT_DOUBLE_EQ(first_crossing(Plane{}, Vector3(0, 0, -1), Vector3(1, 0, 2)).value(), 0.5);
  EXPECT_NEAR(first_crossing(Torus{1.0, 0.25}, Vector3(1, 0, 0), Vector3(1, 0, 0)).value(), 0.25, 1e-12);
  // Within the wall's hollow, towards the far side of the ring.
  EXPECT_NEAR(first_crossing(Torus{1.0, 0.25}, Vector3(0, 0, 0), Vector3(-3, 0, 0)).value(), 0.25, 1e-12);
}

TEST(PrimitiveCrossing, StraightAlongAnAxis) {
  EXPECT_DOUBLE_EQ(first_crossing(Cone{1.0, 0.0, 2.0}, Vector3(0, 0, 3), Vector3(0, 0, -4)).value(), 0.5);
  EXPECT_DOUBLE_EQ(first_crossing(Cone{1.0, 0.0, 2.0}, Vector3(0, 0, -3), Vector3(0, 0, 4)).value(), 0.5);
  EXPECT_DOUBLE_EQ(first_crossing(Cylinder{1.0, 2.0}, Vector3(0.5, 0, 3), Vector3(0, 0, -4)).value(), 0.5);
  EXPECT_FALSE(first_crossing(Cylinder{1.0, 2.0}, Vector3(1.5, 0, 3), Vector3(0, 0, -4)));
  EXPECT_FALSE(first_crossing(Torus{1.0, 0.25}, Vector3(0, 0, 3), Vector3(0, 0, -6)));
  // Along the side of the cone's extension beyond its tip, and its far nappe.
  EXPECT_FALSE(first_crossing(Cone{1.0, 0.0, 2.0}, Vector3(3, 0, 2), Vector3(-6, 0, 0)));
}

TEST(PrimitiveCrossing, GrazingWaysMeetOrMissByAHair) {
  for (const double offset : {-1e-9, 1e-9}) {
    EXPECT_EQ(first_crossing(Sphere{1.0}, Vector3(-3, 1.0 + offset, 0), Vector3(6, 0, 0)).has_value(),
              offset < 0.0);
    EXPECT_EQ(
        first_crossing(Box{Vector3(1, 1, 1)}, Vector3(-3, 1.0 + offset, 0), Vector3(6, 0, 0)).has_value(),
        offset < 0.0);
    EXPECT_EQ(first_crossing(Torus{1.0, 0.2}, Vector3(-3, 0, 0.2 + offset), Vector3(6, 0, 0)).has_value(),
              offset < 0.0);
    EXPECT_EQ(first_crossing(Capsule{1.0, 2.0}, Vector3(1.0 + offset, 0, -5), Vector3(0, 0, 10)).has_value(),
              offset < 0.0);
  }
}

TEST(PrimitiveCrossing, NoWayMeetsNothing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  for (const std::string& name : crossed_primitives()) {
    const Primitive primitive = named_primitive(name);
    EXPECT_FALSE(first_crossing(primitive, Vector3::Zero(), Vector3::Zero())) << name;
    EXPECT_FALSE(first_crossing(primitive, Vector3(none, 0, 0), Vector3(1, 0, 0))) << name;
    EXPECT_FALSE(first_crossing(primitive, Vector3(0, 0, 0.1), Vector3(endless, 0, 0))) << name;
    EXPECT_FALSE(first_crossing(primitive, Vector3(10, 10, 10), Vector3(1, 1, 1))) << name;
  }
}

}  // namespace
}  // namespace icome::geometry
