// Nothing is passed and nothing feels different for what lies far off: slow and fast tips, small and large
// things, near and far from the world's origin.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geometry/csg/csg_solid.h"
#include "haptics/contact_world.h"
#include "haptics/shapes/smooth_shape.h"

namespace icome::haptics {
namespace {

const Vector3 kFarAway(1e6, -4e5, 2e5);  // m

enum class CubeAs { ClosedForm, Facets, DrilledTree };

/// With a hole through it along z.
std::shared_ptr<const Shape> drilled_cube(double size) {
  geometry::CsgTree tree;
  const auto block = tree.add_leaf(geometry::Box{Vector3::Constant(0.5 * size)});
  const auto hole = tree.add_leaf(geometry::Cylinder{0.2 * size, 2.0 * size});
  tree.add(geometry::CsgOperator::Difference, block, hole);
  return std::make_shared<SmoothShape>(std::make_shared<const geometry::CsgSolid>(tree));
}

/// A cube of this size (m) about the origin; as a tree, a drilled one.
std::shared_ptr<const Shape> cube(double size, CubeAs as) {
  if (as == CubeAs::DrilledTree) return drilled_cube(size);
  if (as == CubeAs::Facets) return shape_of(shared(box_mesh(Vector3::Constant(size))));
  return shape_of(geometry::Box{Vector3::Constant(0.5 * size)});
}

// The tip sinks into the top of a cube, from just above until it is well inside.
TEST(ScpScale, HoldsSlowAndFastTipsOnThingsOfEverySize) {
  for (const CubeAs as : {CubeAs::ClosedForm, CubeAs::Facets, CubeAs::DrilledTree}) {
    for (double size = 1e-4; size < 2e7; size *= 10.0) {
      const double fine = 1e-9 * size;
      for (double speed = 1e-9; speed <= 5.0; speed *= 31.6) {  // m a tick
        if (speed > 0.4 * size) continue;
        Toucher toucher(HapticScene::compile({object(1, cube(size, as))}));
        const double top = 0.5 * size;
        double tip = top + std::max(3.3 * speed, 2.0 * fine);
        const double step = std::max(speed, 0.05 * fine);  // slower than this takes too many ticks to arrive
        toucher.step({0.3 * size, 0.05 * size, tip});
        for (int i = 0; i < 200 && tip > top - 0.3 * size; ++i) {
          tip -= step;
          const ScpState& state = toucher.step({0.3 * size, 0.05 * size, tip});
          ASSERT_GE(state.scp.z(), top - fine) << size << " m at " << speed << " m a tick, tick " << i;
          if (tip < top - fine) {
            ASSERT_TRUE(state.touching) << size << " m at " << speed << " m a tick, tick " << i;
          }
        }
        ASSERT_LT(tip, top - fine) << size << " " << speed;
      }
    }
  }
}

TEST(ScpScale, HoldsASlowTipOnALargeBoxSoon) {
  Toucher toucher(HapticScene::compile({object(1, shape_of(geometry::Box{Vector3(1000.0, 1000.0, 5.0)}))}));
  for (int i = 0; i < 10'000; ++i) {
    const double tip = 5.0 + 2e-6 - 1e-7 * i;
    ASSERT_GE(toucher.step({12.0, 3.0, tip}).scp.z(), 5.0 - 1e-6) << i;
  }
  EXPECT_TRUE(toucher.solver.state().touching);
}

TEST(ScpScale, PutsATipThatBeginsInsideOntoTheSurfaceOfThingsOfEverySize) {
  for (const CubeAs as : {CubeAs::ClosedForm, CubeAs::Facets, CubeAs::DrilledTree}) {
    for (double size = 1e-4; size < 2e7; size *= 10.0) {
      for (const double share : {1e-7, 1e-4, 0.1}) {
        for (const Vector3& place : {Vector3(0.0, 0.0, 0.0), kFarAway}) {
          if (place.norm() * 1e-12 > 1e-3 * share * size) continue;  // numbers have no digits for that depth
          Pose pose = Pose::Identity();
          pose.translation() = place;
          Toucher toucher(HapticScene::compile({object(1, cube(size, as), pose)}));
          const Vector3 top(0.35 * size, 0.05 * size, 0.5 * size);
          const Vector3 tip = place + top - Vector3(0.0, 0.0, share * size);
          toucher.step(tip);
          const ScpState& state = toucher.step(tip);
          ASSERT_TRUE(state.touching) << size << " " << share << " " << place.norm();
          EXPECT_LT((state.scp - place - top).norm(), 1e-9 * size + 1e-14 * place.norm())
              << size << " " << share << " " << place.norm();
        }
      }
    }
  }
}

struct Followed {
  Vector3 tip;
  Vector3 scp;
};

/// Where the SCP goes when a tip wanders about a thing 0.1 m large: relative to where that stands.
std::vector<Followed> wander(const std::vector<HapticObject>& objects, const Vector3& middle, double radius) {
  Toucher toucher(HapticScene::compile(objects), radius);
  Random random(5);
  std::vector<Followed> trace;
  Vector3 tip = Vector3(0.02, 0.03, 0.09);
  Vector3 goal = Vector3::Zero();
  for (int i = 0; i < 4000; ++i) {
    if ((goal - tip).norm() < 2e-4) goal = 0.06 * random.direction();
    tip += 2e-4 * (goal - tip).normalized();
    trace.push_back({tip, toucher.step(middle + tip).scp - middle});
  }
  return trace;
}

/// Of the ticks in which the tip is not deep: from the middle of a ball a step of rounding leads anywhere.
double farthest_apart(const std::vector<Followed>& one, const std::vector<Followed>& other) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if ((one[i].scp - one[i].tip).norm() < 0.005)
      farthest = std::max(farthest, (one[i].scp - other[i].scp).norm());
  }
  return farthest;
}

TEST(ScpScale, FeelsTheSameAloneBesideWhatIsFarOffAndFarOff) {
  const std::vector<std::shared_ptr<const Shape>> shapes = {
      cube(0.1, CubeAs::ClosedForm),           cube(0.1, CubeAs::Facets),
      shape_of(primitive("sphere:0.05")),      shape_of(primitive("cone:0.05x0.1")),
      shape_of(primitive("torus:0.04x0.015")), cube(0.1, CubeAs::DrilledTree)};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const bool tree = i + 1 == shapes.size();  // for a point alone
    for (const double radius : tree ? std::vector{0.0} : std::vector{0.0, 0.001}) {
      Random random(3);
      const Pose turned = random_pose(random, 0.0);
      Pose far = turned;
      far.translation() += kFarAway;
      Pose beside = Pose::Identity();
      beside.translation() = kFarAway;
      const auto alone = wander({object(1, shapes[i], turned)}, Vector3::Zero(), radius);
      const auto with_far =
          wander({object(1, shapes[i], turned), object(2, cube(0.1, CubeAs::ClosedForm), beside)},
                 Vector3::Zero(), radius);
      const auto with_mountain =
          wander({object(1, shapes[i], turned), object(2, cube(1e5, CubeAs::Facets), beside)},
                 Vector3::Zero(), radius);
      const auto carried = wander({object(1, shapes[i], far)}, kFarAway, radius);
      EXPECT_LE(farthest_apart(alone, with_far), 1e-9) << i << " " << radius;
      EXPECT_LE(farthest_apart(alone, with_mountain), 1e-9) << i << " " << radius;
      EXPECT_LE(farthest_apart(alone, carried), 1e-9) << i << " " << radius;
    }
  }
}

}  // namespace
}  // namespace icome::haptics
