#pragma once
#include <cmath>
#include <numbers>

#include "geometry/primitive/primitive.h"
#include "world/collision/collisions.h"
#include "world/sample_world.h"

namespace icome::interaction {

using base::Affine3;
using base::Vector3;
using world::add_object;
using world::at;
using world::CollisionIndex;
using world::ObjectId;

inline world::GeometryPointer solid(const geometry::Primitive& it) {
  return std::make_shared<world::PrimitiveGeometry>(it);
}
inline world::GeometryPointer tessellated(const geometry::Primitive& it, double tolerance = 0.01) {
  return std::make_shared<world::MeshGeometry>(geometry::tessellate(it, tolerance));
}
inline Affine3 turned(double angle, const Vector3& axis) {
  return Affine3(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// A closed solid turned about the y axis: radii (> 0) at heights from below to above, m.
inline world::GeometryPointer lathe(const std::vector<std::pair<double, double>>& profile,
                                    std::uint32_t around) {
  geometry::TriangleMesh mesh;
  for (const auto& [radius, height] : profile) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.positions.emplace_back(radius * std::cos(angle), height, -radius * std::sin(angle));
    }
  }
  const auto rings = std::uint32_t(profile.size());
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = ring * around + i, b = ring * around + (i + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  const auto bottom = std::uint32_t(mesh.positions.size());
  mesh.positions.emplace_back(0.0, profile.front().second, 0.0);
  mesh.positions.emplace_back(0.0, profile.back().second, 0.0);
  const std::uint32_t last = (rings - 1) * around;
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    mesh.triangles.push_back({bottom, next, i});
    mesh.triangles.push_back({bottom + 1, last + i, last + next});
  }
  return std::make_shared<world::MeshGeometry>(std::move(mesh));
}

/// 0.3 m high; its foot, at y = 0 of its own frame, is a disc of 5 cm.
inline world::GeometryPointer vase() {
  return lathe({{0.05, 0.0}, {0.09, 0.08}, {0.10, 0.15}, {0.05, 0.24}, {0.07, 0.30}}, 48);
}

/// Boxes, spheres, meshes, stretched solids and sheets, anywhere within 1 m of the middle.
struct Clutter {
  world::World world;
  world::IdSource ids{1};
  std::vector<ObjectId> objects;

  ObjectId add(world::GeometryPointer shape, const Affine3& place, ObjectId parent = {}) {
    objects.push_back(add_object(world, ids, "", std::move(shape), parent, place));
    return objects.back();
  }
  static Affine3 anywhere(base::Random& random) {
    return Affine3(Eigen::Translation3d(random.uniform() * random.direction())) *
           turned(random.uniform(0.0, 3.0), random.direction());
  }
  static world::GeometryPointer any_shape(base::Random& random) {
    const double size = random.uniform(0.02, 0.15);
    switch (random.index(6)) {
      case 0:
        return solid(geometry::Box{{size, 0.5 * size, random.uniform(0.001, size)}});
      case 1:
        return solid(geometry::Sphere{size});
      case 2:
        return tessellated(geometry::Torus{size, 0.4 * size}, 0.2 * size);
      case 3:
        return tessellated(geometry::Cone{size, 0.0, size}, 0.2 * size);
      case 4:
        return solid(geometry::Box{{3.0 * size, 3.0 * size, 1e-5}});  // a plate thinner than any step
      default: {
        geometry::TriangleMesh sheet;
        sheet.positions = {{0, 0, 0}, {4 * size, 0, 0}, {4 * size, 4 * size, 0}, {0, 4 * size, 0}};
        sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
        return std::make_shared<world::MeshGeometry>(std::move(sheet));
      }
    }
  }
  void fill(base::Random& random, int count) {
    for (int i = 0; i < count; ++i) {
      Affine3 place = anywhere(random);
      if (i % 7 == 0) place = place * Eigen::Scaling(1.0, random.uniform(0.5, 2.0), 1.0);
      add(any_shape(random), place);
    }
  }
};

}  // namespace icome::interaction
