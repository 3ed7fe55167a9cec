#include "interaction/elements/element_frame.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"
#include "repeats.h"

namespace icome::interaction {
namespace {

using base::Vector3;

// The plane through the three points of thesis 5.7.2 (the third one corrected), by the general formulas for
// any plane, which share nothing with equations 5.1 to 5.6.
TEST(ElementFrame, AgreesWithThePlaneThroughItsThreePoints) {
  base::Random random(1);
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  for (int i = 0; i < repeats(100'000); ++i) {
    const double special[] = {0.0, kQuarter, -kQuarter, 2.0 * kQuarter};
    const double alpha = i % 10 == 0 ? special[i / 10 % 4] : random.uniform(-4.0, 4.0);
    const Vector3 centre(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const Vector3 point(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const ElementFrame frame{centre, alpha};
    const Vector3 up = Vector3(centre.x(), centre.y() + 1.0, centre.z()) - centre;
    const Vector3 side =
        Vector3(centre.x() + std::cos(alpha), centre.y(), centre.z() + std::sin(alpha)) - centre;
    const Vector3 normal = side.cross(up).normalized();
    const double distance = normal.dot(point - centre);
    ASSERT_NEAR(frame.front_distance(point), distance, 1e-12);
    const Vector3 foot = point - distance * normal;
    ASSERT_NEAR((frame.in_world(frame.projected(point)) - foot).norm(), 0.0, 1e-12);
    // Nothing else in the plane is nearer.
    const Vector3 other = foot + random.uniform(-0.1, 0.1) * up + random.uniform(-0.1, 0.1) * side;
    ASSERT_GE((point - other).norm(), std::abs(distance) - 1e-12);
    const base::Pose pose = frame.world_from_element();
    ASSERT_NEAR(pose.linear().determinant(), 1.0, 1e-12);
    ASSERT_NEAR((pose.inverse() * point).z(), distance, 1e-12);
  }
}

}  // namespace
}  // namespace icome::interaction
