#include "geometry/primitive/primitive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "base/random.h"
#include "geometry/closed_mesh.h"

namespace icome::geometry {
namespace primitive_test {
namespace {

constexpr double kPi = std::numbers::pi;

// ---- An independent account of each surface: parametric patches and the implicit solid ---------

/// A piece of surface over u, v in [0, 1]; a coordinate that goes round may leave that range.
struct Patch {
  std::function<Vector3(double, double)> at;
  bool u_goes_round = true;
  bool v_goes_round = false;
};

/// A shape, told a second time in other words than primitive.cpp.
struct Reference {
  Primitive primitive;
  double size;  // half of its longest side, m
  std::vector<Patch> patches;
  std::function<double(const Vector3&)> implicit;  // <= 0 inside; any scale
};

Vector3 around_axis(double rho, double turn, double z) {
  return {rho * std::cos(2 * kPi * turn), rho * std::sin(2 * kPi * turn), z};
}

Reference box_reference(const Vector3& half) {
  Reference reference{Box{half}, half.maxCoeff(), {}, [half](const Vector3& p) {
                        return p.cwiseAbs().cwiseQuotient(half).maxCoeff() - 1.0;
                      }};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      reference.patches.push_back({[=](double u, double v) {
                                     Vector3 p;
                                     p[axis] = side * half[axis];
                                     p[(axis + 1) % 3] = (2 * u - 1) * half[(axis + 1) % 3];
                                     p[(axis + 2) % 3] = (2 * v - 1) * half[(axis + 2) % 3];
                                     return p;
                                   },
                                   false});
    }
  }
  return reference;
}

Reference sphere_reference(double radius) {
  return {Sphere{radius},
          radius,
          {{[=](double u, double v) {
            return around_axis(radius * std::sin(kPi * v), u, radius * std::cos(kPi * v));
          }}},
          [=](const Vector3& p) { return p.squaredNorm() - radius * radius; }};
}

Reference frustum_reference(const Primitive& primitive, double bottom, double top, double height) {
  const double h = height / 2;
  return {
      primitive,
      std::max({bottom, top, h}),
      {{[=](double u, double v) { return around_axis(v * bottom, u, -h); }},
       {[=](double u, double v) { return around_axis(v * top, u, h); }},
       {[=](double u, double v) { return around_axis(bottom + v * (top - bottom), u, -h + v * height); }}},
      [=](const Vector3& p) {
        const double radius_there = bottom + (p.z() + h) / height * (top - bottom);
        return std::max(std::abs(p.z()) - h, std::sqrt(p.x() * p.x() + p.y() * p.y()) - radius_there);
      }};
}

Reference cylinder_reference(double radius, double height) {
  return frustum_reference(Cylinder{radius, height}, radius, radius, height);
}

Reference cone_reference(double bottom, double top, double height) {
  return frustum_reference(Cone{bottom, top, height}, bottom, top, height);
}

Reference torus_reference(double major, double minor) {
  return {Torus{major, minor},
          major + minor,
          {{[=](double u, double v) {
              return around_axis(major + minor * std::cos(2 * kPi * v), u, minor * std::sin(2 * kPi * v));
            },
            true, true}},
          [=](const Vector3& p) {
            const double from_core = std::sqrt(p.x() * p.x() + p.y() * p.y()) - major;
            return from_core * from_core + p.z() * p.z() - minor * minor;
          }};
}

Reference capsule_reference(double radius, double height) {
  const double h = height / 2;
  const auto cap = [=](double side) {
    return Patch{[=](double u, double v) {
      return around_axis(radius * std::sin(kPi / 2 * v), u, side * (h + radius * std::cos(kPi / 2 * v)));
    }};
  };
  return {
      Capsule{radius, height},
      radius + h,
      {cap(1.0), cap(-1.0), {[=](double u, double v) { return around_axis(radius, u, h * (2 * v - 1)); }}},
      [=](const Vector3& p) {
        const double beyond = std::max(0.0, std::abs(p.z()) - h);
        return p.x() * p.x() + p.y() * p.y() + beyond * beyond - radius * radius;
      }};
}

/// Several of each kind: slim, flat, equal-sided, and as small and as large as is likely.
std::vector<Reference> references() {
  return {box_reference({0.05, 0.1, 0.15}),
          box_reference({0.05, 0.05, 0.05}),
          box_reference({0.2, 0.001, 0.03}),
          sphere_reference(0.05),
          sphere_reference(3.0),
          sphere_reference(1e-4),
          cylinder_reference(0.05, 0.2),
          cylinder_reference(0.2, 0.01),
          cylinder_reference(0.01, 0.02),
          cone_reference(0.05, 0.0, 0.1),
          cone_reference(0.0, 0.05, 0.1),
          cone_reference(0.03, 0.08, 0.05),
          cone_reference(0.08, 0.03, 0.02),
          cone_reference(0.1, 0.0, 0.002),
          torus_reference(0.05, 0.02),
          torus_reference(0.05, 0.049),
          torus_reference(1.0, 0.01),
          capsule_reference(0.02, 0.1),
          capsule_reference(0.05, 0.01)};
}

/// Nearest point of a patch by search alone: the best of a grid, then steps that halve. The grid has
/// the middles of its cells, because at a pole (v = 0 or 1) all u are one point and no u is best.
class PatchSearch {
 public:
  explicit PatchSearch(const Patch& patch) : patch_(patch) {
    for (int k = 0; k < kSteps * kSteps; ++k)
      grid_.push_back(patch_.at(middle(k / kSteps), middle(k % kSteps)));
  }

  double distance(const Vector3& point) const {
    int best = 0;
    for (int k = 1; k < kSteps * kSteps; ++k) {
      if ((grid_[k] - point).squaredNorm() < (grid_[best] - point).squaredNorm()) best = k;
    }
    return refine(point, middle(best / kSteps), middle(best % kSteps));
  }

 private:
  static constexpr int kSteps = 24;

  static double middle(int cell) { return (cell + 0.5) / kSteps; }

  double refine(const Vector3& point, double u, double v) const {
    double least = (patch_.at(u, v) - point).squaredNorm();
    for (double step = 1.0 / kSteps; step > 1e-12;) {
      bool moved = false;
      for (const auto& [du, dv] : {std::pair{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
        const double next_u = patch_.u_goes_round ? u + du : std::clamp(u + du, 0.0, 1.0);
        const double next_v = patch_.v_goes_round ? v + dv : std::clamp(v + dv, 0.0, 1.0);
        const double candidate = (patch_.at(next_u, next_v) - point).squaredNorm();
        if (candidate < least) {
          least = candidate, u = next_u, v = next_v, moved = true;
        }
      }
      if (!moved) step /= 2;
    }
    return std::sqrt(least);
  }

  Patch patch_;
  std::vector<Vector3> grid_;
};

class SurfaceSearch {
 public:
  explicit SurfaceSearch(const Reference& reference) {
    for (const Patch& patch : reference.patches) patches_.emplace_back(patch);
  }
  double distance(const Vector3& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const PatchSearch& patch : patches_) least = std::min(least, patch.distance(point));
    return least;
  }

 private:
  std::vector<PatchSearch> patches_;
};

/// Points of all kinds: in and around the shape, far from it, and close to its surface.
std::vector<Vector3> points_around(const Reference& reference, int count) {
  base::Random random(7);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform();
    const Patch& patch = reference.patches[random.index(reference.patches.size())];
    const Vector3 on_surface = patch.at(u, random.uniform());
    const Vector3 offset = random.direction() * random.uniform();
    switch (i % 4) {
      case 0:
        points.push_back(reference.size * 1.5 * offset);
        break;
      case 1:
        points.push_back(reference.size * 30.0 * offset);
        break;
      case 2:
        points.push_back(on_surface * random.uniform());
        break;
      default:
        points.push_back(on_surface + reference.size * 0.01 * offset);
    }
  }
  return points;
}

std::string describe(const Reference& reference, const Vector3& point) {
  std::ostringstream text;
  text.precision(17);
  text << name(reference.primitive) << " at " << point.transpose();
  return text.str();
}

SurfacePoint scp(const Primitive& primitive, const Vector3& point) {
  return inside(primitive, point) ? scp_from_inside(primitive, point) : scp_from_outside(primitive, point);
}

// ---- Against search ----------------------------------------------------------------------------

TEST(Primitive, NearestPointIsAsNearAsSearchFinds) {
  int within = 0, outside = 0;
  for (const Reference& reference : references()) {
    const SurfaceSearch search(reference);
    for (const Vector3& point : points_around(reference, 500)) {
      SCOPED_TRACE(describe(reference, point));
      const double accuracy = 1e-12 * (reference.size + point.norm());
      const SurfacePoint nearest = scp(reference.primitive, point);
      const double expected = search.distance(point);
      // Points on the surface that are as near as any: these are nearest points.
      EXPECT_NEAR((nearest.point - point).norm(), expected, accuracy);
      EXPECT_LT(search.distance(nearest.point), 1e-10 * reference.size);
      const bool is_inside = reference.implicit(point) <= 0.0;
      (is_inside ? within : outside)++;
      EXPECT_EQ(inside(reference.primitive, point), is_inside);
      EXPECT_NEAR(signed_distance(reference.primitive, point), is_inside ? -expected : expected, accuracy);
    }
  }
  EXPECT_GT(within, 2000);
  EXPECT_GT(outside, 4000);
}

TEST(Primitive, SurfacePointIsOnTheSurfaceToRounding) {
  for (const Reference& reference : references()) {
    for (const Vector3& point : points_around(reference, 500)) {
      const SurfacePoint nearest = scp(reference.primitive, point);
      EXPECT_NEAR(signed_distance(reference.primitive, nearest.point), 0.0, 1e-15 * reference.size)
          << describe(reference, point);
    }
  }
}

TEST(Primitive, NormalIsUnitAndIsTheGradientOfDistance) {
  int compared = 0, skipped = 0;
  for (const Reference& reference : references()) {
    const double h = 1e-5 * reference.size;
    for (const Vector3& point : points_around(reference, 500)) {
      SCOPED_TRACE(describe(reference, point));
      const SurfacePoint nearest = scp(reference.primitive, point);
      EXPECT_NEAR(nearest.normal.norm(), 1.0, 1e-15);
      Vector3 gradient;
      for (int i = 0; i < 3; ++i) {
        const Vector3 step = h * Vector3::Unit(i);
        gradient[i] = (signed_distance(reference.primitive, point + step) -
                       signed_distance(reference.primitive, point - step)) /
                      (2 * h);
      }
      // Where several surface points are equally near, distance has no gradient; and next to an edge
      // or the core of the shape the difference is too coarse to see it.
      if (std::abs(gradient.norm() - 1.0) > 1e-6) {
        ++skipped;
        continue;
      }
      ++compared;
      EXPECT_NEAR((nearest.normal - gradient).norm(), 0.0, 1e-4);
    }
  }
  EXPECT_LT(skipped, compared / 20);
}

TEST(Primitive, FaceNormalIsPerpendicularToThePatch) {
  base::Random random(3);
  for (const Reference& reference : references()) {
    for (const Patch& patch : reference.patches) {
      for (int i = 0; i < 50; ++i) {
        const double u = random.uniform(0.01, 0.99), v = random.uniform(0.01, 0.99), h = 1e-6;
        const Vector3 along_u = patch.at(u + h, v) - patch.at(u - h, v);
        const Vector3 along_v = patch.at(u, v + h) - patch.at(u, v - h);
        if (along_u.norm() * along_v.norm() == 0.0) continue;  // the cap of a pointed cone
        const SurfacePoint nearest = scp(reference.primitive, patch.at(u, v));
        EXPECT_NEAR(nearest.normal.dot(along_u.normalized()), 0.0, 1e-8) << name(reference.primitive);
        EXPECT_NEAR(nearest.normal.dot(along_v.normalized()), 0.0, 1e-8) << name(reference.primitive);
        EXPECT_GT(reference.implicit(nearest.point + 1e-3 * reference.size * nearest.normal), 0.0);
      }
    }
  }
}

TEST(Primitive, BothQuestionsAnswerTheNearestPointWhicheverSideThePointIsOn) {
  for (const Reference& reference : references()) {
    for (const Vector3& point : points_around(reference, 100)) {
      EXPECT_EQ(scp_from_inside(reference.primitive, point).point,
                scp_from_outside(reference.primitive, point).point);
    }
  }
}

TEST(Primitive, MillimetresAnswerAsMetresDo) {
  const auto in_millimetres = [](const Primitive& primitive) -> Primitive {
    struct Scale {
      Primitive operator()(const Plane&) const { return Plane{}; }
      Primitive operator()(const Box& s) const { return Box{1000 * s.half}; }
      Primitive operator()(const Sphere& s) const { return Sphere{1000 * s.radius}; }
      Primitive operator()(const Cylinder& s) const { return Cylinder{1000 * s.radius, 1000 * s.height}; }
      Primitive operator()(const Cone& s) const {
        return Cone{1000 * s.bottom_radius, 1000 * s.top_radius, 1000 * s.height};
      }
      Primitive operator()(const Torus& s) const {
        return Torus{1000 * s.major_radius, 1000 * s.minor_radius};
      }
      Primitive operator()(const Capsule& s) const { return Capsule{1000 * s.radius, 1000 * s.height}; }
    };
    return std::visit(Scale{}, primitive);
  };
  for (const Reference& reference : references()) {
    const Primitive large = in_millimetres(reference.primitive);
    for (const Vector3& point : points_around(reference, 500)) {
      SCOPED_TRACE(describe(reference, point));
      const SurfacePoint small_answer = scp(reference.primitive, point),
                         large_answer = scp(large, 1000 * point);
      const double distance = signed_distance(reference.primitive, point);
      const double accuracy = 1e-12 * 1000 * (reference.size + point.norm());
      EXPECT_NEAR(signed_distance(large, 1000 * point), 1000 * distance, accuracy);
      EXPECT_LT((large_answer.point - 1000 * small_answer.point).norm(), accuracy);
      // The direction to a point close by is as good as that point's last bits.
      const double normal_accuracy = 1e-15 * (reference.size + point.norm()) / std::abs(distance);
      EXPECT_LT((large_answer.normal - small_answer.normal).norm(), 1e-12 + normal_accuracy);
    }
  }
}

// ---- Regions (5.5.3) ---------------------------------------------------------------------------

void expect_answer(const Primitive& primitive, const Vector3& point, const Vector3& expected_point,
                   const Vector3& expected_normal) {
  const SurfacePoint answer = scp(primitive, point);
  EXPECT_LT((answer.point - expected_point).norm(), 1e-15)
      << name(primitive) << " at " << point.transpose() << " gave " << answer.point.transpose();
  EXPECT_LT((answer.normal - expected_normal).norm(), 1e-14)
      << name(primitive) << " at " << point.transpose() << " gave " << answer.normal.transpose();
}

TEST(Primitive, BoxHas27Regions) {
  const Vector3 half(0.1, 0.2, 0.3);
  std::set<std::tuple<double, double, double>> answers;
  for (int region = 0; region < 27; ++region) {
    const int y = region / 3 % 3 - 1, z = region / 9 - 1;
    const Vector3 side(region % 3 - 1, y, z);
    if (side.isZero()) continue;
    // 0.01 beyond each face of the region, 0.01 off the middle along the others.
    const Vector3 middle = Vector3::Constant(0.01);
    const Vector3 beyond = side.cwiseProduct(half);
    Vector3 surface;
    for (int i = 0; i < 3; ++i) surface[i] = side[i] == 0.0 ? middle[i] : beyond[i];
    expect_answer(Box{half}, surface + 0.01 * side, surface, side.normalized());
    answers.insert({surface.x(), surface.y(), surface.z()});
  }
  EXPECT_EQ(answers.size(), 26u);
  EXPECT_TRUE(inside(Box{half}, {0.01, 0.01, 0.01}));
}

TEST(Primitive, BoxPyramidsInside) {
  const Box box{{0.1, 0.2, 0.3}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector3 point = Vector3::Constant(0.02), surface = point;
      surface[axis] = side * box.half[axis];
      point[axis] = side * (box.half[axis] - 0.03);
      expect_answer(box, point, surface, side * Vector3::Unit(axis));
    }
  }
}

TEST(Primitive, CylinderHasSixRegions) {
  const Cylinder cylinder{0.1, 0.4};
  const double diagonal = std::sqrt(0.5);
  expect_answer(cylinder, {0.0, -0.08, 0.1}, {0.0, -0.1, 0.1}, -Vector3::UnitY());     // within
  expect_answer(cylinder, {0.3, 0.0, -0.1}, {0.1, 0.0, -0.1}, Vector3::UnitX());       // side
  expect_answer(cylinder, {0.02, 0.03, 0.5}, {0.02, 0.03, 0.2}, Vector3::UnitZ());     // top
  expect_answer(cylinder, {0.02, 0.03, -0.5}, {0.02, 0.03, -0.2}, -Vector3::UnitZ());  // bottom
  expect_answer(cylinder, {0.0, 0.15, 0.25}, {0.0, 0.1, 0.2}, {0.0, diagonal, diagonal});
  expect_answer(cylinder, {0.0, 0.15, -0.25}, {0.0, 0.1, -0.2}, {0.0, diagonal, -diagonal});
}

TEST(Primitive, FrustumHasSixRegions) {
  // The profile's side runs from (0.4, -0.15) to (0, 0.15) for the cone: normal (0.6, 0.8).
  const Cone frustum{0.5, 0.1, 0.3};
  expect_answer(frustum, {0.0, 0.0, 0.149}, {0.0, 0.0, 0.15}, Vector3::UnitZ());
  expect_answer(frustum, {0.3 + 0.6, 0.0, 0.0 + 0.8}, {0.3, 0.0, 0.0}, {0.6, 0.0, 0.8});
  expect_answer(frustum, {0.05, 0.0, 1.0}, {0.05, 0.0, 0.15}, Vector3::UnitZ());
  expect_answer(frustum, {0.49, 0.0, -1.0}, {0.49, 0.0, -0.15}, -Vector3::UnitZ());
  expect_answer(frustum, {0.5 + 0.3, 0.0, -0.15 - 0.4}, {0.5, 0.0, -0.15}, {0.6, 0.0, -0.8});
  expect_answer(frustum, {0.1 + 0.005, 0.0, 0.15 + 0.012}, {0.1, 0.0, 0.15}, {5.0 / 13, 0.0, 12.0 / 13});
}

TEST(Primitive, PlaneIsTheHalfSpaceBelow) {
  EXPECT_TRUE(inside(Plane{}, {3.0, 4.0, 0.0}));
  EXPECT_FALSE(inside(Plane{}, {3.0, 4.0, 1e-300}));
  EXPECT_EQ(signed_distance(Plane{}, {3.0, 4.0, -2.0}), -2.0);
  expect_answer(Plane{}, {3.0, 4.0, -2.0}, {3.0, 4.0, 0.0}, Vector3::UnitZ());
  expect_answer(Plane{}, {3.0, 4.0, 2.0}, {3.0, 4.0, 0.0}, Vector3::UnitZ());
}

// ---- Degenerate places -------------------------------------------------------------------------

TEST(Primitive, EquallyNearPointsAreChosenAsStated) {
  const Vector3 origin = Vector3::Zero();
  expect_answer(Sphere{0.1}, origin, {0.0, 0.0, 0.1}, Vector3::UnitZ());
  expect_answer(Box{{0.1, 0.1, 0.1}}, origin, {0.1, 0.0, 0.0}, Vector3::UnitX());
  expect_answer(Box{{0.2, 0.1, 0.1}}, {-0.0, -0.0, -0.0}, {0.0, 0.1, 0.0}, Vector3::UnitY());
  expect_answer(Cylinder{0.1, 0.4}, origin, {0.1, 0.0, 0.0}, Vector3::UnitX());
  expect_answer(Cylinder{0.1, 0.02}, origin, {0.0, 0.0, 0.01}, Vector3::UnitZ());
  expect_answer(Cone{0.4, 0.1, 0.4}, {0.0, 0.0, -0.15}, {0.0, 0.0, -0.2}, -Vector3::UnitZ());
  expect_answer(Capsule{0.1, 0.4}, {0.0, 0.0, 0.1}, {0.1, 0.0, 0.1}, Vector3::UnitX());
  expect_answer(Torus{0.3, 0.1}, origin, {0.2, 0.0, 0.0}, -Vector3::UnitX());
  expect_answer(Torus{0.3, 0.1}, {0.0, 0.3, 0.0}, {0.0, 0.3, 0.1}, Vector3::UnitZ());
}

TEST(Primitive, OnEdgesTheNormalIsTheMeanOfTheFaces) {
  const double half_root = std::sqrt(0.5);
  const Box box{{0.1, 0.2, 0.3}};
  expect_answer(box, {0.1, 0.05, 0.0}, {0.1, 0.05, 0.0}, Vector3::UnitX());
  expect_answer(box, {0.1, -0.2, 0.0}, {0.1, -0.2, 0.0}, {half_root, -half_root, 0.0});
  expect_answer(box, {0.1, 0.2, -0.3}, {0.1, 0.2, -0.3}, Vector3(1.0, 1.0, -1.0).normalized());
  expect_answer(Cylinder{0.1, 0.4}, {0.0, 0.1, 0.2}, {0.0, 0.1, 0.2}, {0.0, half_root, half_root});
  expect_answer(Cylinder{0.1, 0.4}, {-0.1, 0.0, -0.2}, {-0.1, 0.0, -0.2}, {-half_root, 0.0, -half_root});
  const Vector3 rim_normal = (Vector3(0.6, 0.0, 0.8) - Vector3::UnitZ()).normalized();
  expect_answer(Cone{0.4, 0.0, 0.3}, {0.4, 0.0, -0.15}, {0.4, 0.0, -0.15}, rim_normal);
}

TEST(Primitive, ApexPointsAlongTheAxis) {
  const Cone up{0.4, 0.0, 0.3}, down{0.0, 0.4, 0.3};
  expect_answer(up, {0.0, 0.0, 0.15}, {0.0, 0.0, 0.15}, Vector3::UnitZ());
  expect_answer(up, {0.0, 0.0, 0.2}, {0.0, 0.0, 0.15}, Vector3::UnitZ());
  expect_answer(up, {0.03, 0.0, 0.19}, {0.0, 0.0, 0.15}, {0.6, 0.0, 0.8});
  expect_answer(down, {0.0, 0.0, -0.15}, {0.0, 0.0, -0.15}, -Vector3::UnitZ());
  expect_answer(down, {0.0, 0.0, -0.2}, {0.0, 0.0, -0.15}, -Vector3::UnitZ());
  // On the axis 0.05 below the apex the side, +x by choice, is 0.05 * cos(slope) = 0.04 away.
  EXPECT_NEAR(signed_distance(up, {0.0, 0.0, 0.1}), -0.04, 1e-15);
  expect_answer(up, {0.0, 0.0, 0.1}, {0.024, 0.0, 0.132}, {0.6, 0.0, 0.8});
}

TEST(Primitive, AnswersAreFiniteAndRepeatableEverywhere) {
  const double least = std::numeric_limits<double>::denorm_min();
  for (const Reference& reference : references()) {
    const Vector3 half = bounds(reference.primitive).max();
    for (const double x : {0.0, -0.0, least, -least, 1e-200, half.x(), -half.x(), 1e200}) {
      for (const double y : {0.0, -least, 1e-310, half.y(), -half.y(), 1e200}) {
        for (const double z : {0.0, least, half.z(), -half.z(), std::nextafter(half.z(), 1e9), -1e200}) {
          const Vector3 point(x, y, z);
          SCOPED_TRACE(describe(reference, point));
          const SurfacePoint answer = scp(reference.primitive, point);
          EXPECT_TRUE(answer.point.allFinite());
          EXPECT_NEAR(answer.normal.norm(), 1.0, 1e-15);
          EXPECT_TRUE(std::isfinite(signed_distance(reference.primitive, point)));
          EXPECT_EQ(scp(reference.primitive, point).point, answer.point);
        }
      }
    }
  }
}

// ---- Bounds and text ---------------------------------------------------------------------------

TEST(Primitive, BoundsHoldTheSurfaceTightly) {
  for (const Reference& reference : references()) {
    Bounds sampled;
    for (const Patch& patch : reference.patches) {
      for (int i = 0; i <= 64; ++i) {
        for (int j = 0; j <= 64; ++j) sampled.extend(patch.at(i / 64.0, j / 64.0));
      }
    }
    const Bounds stated = bounds(reference.primitive);
    EXPECT_LT((stated.max() - sampled.max()).cwiseAbs().maxCoeff(), 1e-15 * reference.size);
    EXPECT_LT((stated.min() - sampled.min()).cwiseAbs().maxCoeff(), 1e-15 * reference.size);
  }
  EXPECT_TRUE(bounds(Plane{}).contains(Vector3(1e300, -1e300, -1e300)));
  EXPECT_FALSE(bounds(Plane{}).contains(Vector3(0.0, 0.0, 1e-9)));
}

TEST(Primitive, ParsesEachKind) {
  EXPECT_EQ(std::get<Box>(*parse_primitive("box:0.1x0.2x0.3")).half, Vector3(0.05, 0.1, 0.15));
  EXPECT_EQ(std::get<Sphere>(*parse_primitive("sphere:5e-2")).radius, 0.05);
  const auto cylinder = std::get<Cylinder>(*parse_primitive("cylinder:0.1x2"));
  EXPECT_EQ(cylinder.radius, 0.1);
  EXPECT_EQ(cylinder.height, 2.0);
  const auto cone = std::get<Cone>(*parse_primitive("cone:0.1x2"));
  EXPECT_EQ(cone.bottom_radius, 0.1);
  EXPECT_EQ(cone.top_radius, 0.0);
  EXPECT_EQ(cone.height, 2.0);
  const auto frustum = std::get<Cone>(*parse_primitive("cone:0x0.1x2"));
  EXPECT_EQ(frustum.bottom_radius, 0.0);
  EXPECT_EQ(frustum.top_radius, 0.1);
  const auto torus = std::get<Torus>(*parse_primitive("torus:0.2x0.1"));
  EXPECT_EQ(torus.major_radius, 0.2);
  EXPECT_EQ(torus.minor_radius, 0.1);
  const auto capsule = std::get<Capsule>(*parse_primitive("capsule:0.1x0.3"));
  EXPECT_EQ(capsule.radius, 0.1);
  EXPECT_EQ(capsule.height, 0.3);
  EXPECT_TRUE(std::holds_alternative<Plane>(*parse_primitive("plane")));
}

TEST(Primitive, NameReadsBack) {
  for (const Reference& reference : references()) {
    const std::string text = name(reference.primitive);
    const auto again = parse_primitive(text);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->index(), reference.primitive.index());
    EXPECT_EQ(bounds(*again).max(), bounds(reference.primitive).max());
    EXPECT_EQ(name(*again), text);
  }
  EXPECT_EQ(name(Box{{0.05, 0.05, 0.05}}), "box:0.1x0.1x0.1");
  EXPECT_EQ(name(Plane{}), "plane");
}

TEST(Primitive, RefusesWithWhatWasExpected) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "expected one of plane, box:"},
      {"cube:1", "expected one of plane, box:"},
      {"Box:1x1x1", "expected one of"},
      {" sphere:1", "expected one of"},
      {"box", "0 sizes found; expected box:XxYxZ, sizes in metres"},
      {"box:", "\"\" is not a number; expected box:XxYxZ"},
      {"box:1x1", "2 sizes found; expected box:XxYxZ"},
      {"box:1x1x1x1", "4 sizes found"},
      {"box:1x1x", "\"\" is not a number"},
      {"box:1xx1", "\"\" is not a number"},
      {"sphere:1mm", "\"1mm\" is not a number; expected sphere:RADIUS"},
      {"sphere:1 ", "\"1 \" is not a number"},
      {"sphere:0", "between 1e-09 and 1000000 metres, not 0"},
      {"sphere:-1", "not -1"},
      {"sphere:nan", "not nan"},
      {"sphere:inf", "not inf"},
      {"sphere:1e999", "not inf"},
      {"sphere:1e-999", "metres"},
      {"sphere:2e6", "not 2000000"},
      {"sphere:1e-10", "not 1e-10"},
      {"cylinder:0x1", "not 0"},
      {"cone:0x1", "not 0"},
      {"cone:0x0x1", "not 0"},
      {"cone:1x1x0", "not 0"},
      {"cone:nanx0x1", "not nan"},
      {"cone:1", "expected cone:RADIUSxHEIGHT or cone:BOTTOM_RADIUSxTOP_RADIUSxHEIGHT"},
      {"torus:0.1x0.1", "minor radius must be less"},
      {"torus:0.1x0.2", "minor radius must be less"},
      {"capsule:0.1x0", "not 0"},
      {"plane:1", "1 size found; expected plane without sizes"},
      {"plane:", "is not a number"},
  };
  for (const auto& [text, complaint] : cases) {
    const auto parsed = parse_primitive(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_NE(parsed.error().message.find(complaint), std::string::npos)
        << text << ": " << parsed.error().message;
    EXPECT_EQ(parsed.error().message.find('"' + text + '"'), 0u) << parsed.error().message;
  }
}

// ---- Tessellation ------------------------------------------------------------------------------

/// The largest distance of vertices, edge middles and face centres from the surface.
double deviation(const TriangleMesh& mesh, const Primitive& primitive) {
  double largest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    for (const Vector3& point :
         {a, Vector3((a + b) / 2), Vector3((b + c) / 2), Vector3((c + a) / 2), Vector3((a + b + c) / 3)}) {
      largest = std::max(largest, std::abs(signed_distance(primitive, point)));
    }
  }
  return largest;
}

TEST(Primitive, TessellationIsClosedAndWithinTolerance) {
  for (const Reference& reference : references()) {
    for (const double share : {2.0, 0.1, 1e-2, 1e-3}) {
      const double tolerance = share * reference.size;
      SCOPED_TRACE(name(reference.primitive) + " to " + std::to_string(tolerance));
      const TriangleMesh mesh = tessellate(reference.primitive, tolerance);
      EXPECT_TRUE(is_closed(mesh));
      EXPECT_EQ(euler_characteristic(mesh), std::holds_alternative<Torus>(reference.primitive) ? 0 : 2);
      EXPECT_GT(volume(mesh), 0.0);
      EXPECT_LE(deviation(mesh, reference.primitive), tolerance * (1 + 1e-9));
      for (const Vector3& vertex : mesh.positions) {
        EXPECT_LE(signed_distance(reference.primitive, vertex), 1e-15 * reference.size);
      }
    }
  }
}

TEST(Primitive, TessellationFacesOut) {
  for (const Reference& reference : references()) {
    const TriangleMesh mesh = tessellate(reference.primitive, 1e-2 * reference.size);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vector3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
      const Vector3 normal = (b - a).cross(c - a).normalized();
      EXPECT_GT(normal.dot(scp(reference.primitive, (a + b + c) / 3).normal), 0.5)
          << name(reference.primitive);
    }
  }
}

TEST(Primitive, TessellationFillsTheSolid) {
  const double r = 0.05;
  EXPECT_NEAR(volume(tessellate(Sphere{r}, 1e-6)), 4.0 / 3 * kPi * r * r * r, 1e-7);
  EXPECT_NEAR(volume(tessellate(Torus{0.1, r}, 1e-6)), 2 * kPi * kPi * 0.1 * r * r, 1e-7);
  EXPECT_NEAR(volume(tessellate(Box{{0.1, 0.2, 0.3}}, 1e-6)), 8 * 0.006, 1e-15);
}

TEST(Primitive, TessellationStopsAtTwoMillionTriangles) {
  for (const Primitive& primitive :
       {Primitive(Sphere{1.0}), Primitive(Capsule{1.0, 1.0}), Primitive(Torus{1.0, 0.3}),
        Primitive(Torus{1e6, 1e-9}), Primitive(Cylinder{1.0, 1.0})}) {
    const TriangleMesh mesh = tessellate(primitive, 1e-300);
    EXPECT_LE(mesh.triangles.size(), 2'000'000u) << name(primitive);
    EXPECT_GE(mesh.triangles.size(), 1'900'000u) << name(primitive);
  }
}

TEST(Primitive, PlaneTessellatesToASquare) {
  const TriangleMesh mesh = tessellate(Plane{}, 1e-3);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(bounds(Plane{}).max().z(), 0.0);
  for (std::size_t t = 0; t < 2; ++t) {
    const Vector3 normal =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    EXPECT_LT((normal - Vector3(0.0, 0.0, 0.04)).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace primitive_test
}  // namespace icome::geometry
