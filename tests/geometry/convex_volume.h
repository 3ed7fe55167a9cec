#pragma once
// The volume of what sets of convex polyhedra leave under set algebra, in closed form: a judge of meshes that
// shares nothing with how these are made.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// All points with normal * x <= offset.
struct HalfSpace {
  Vector3 normal;  // unit
  double offset;   // m
};

using ConvexBody = std::vector<HalfSpace>;

/// The half-spaces of a convex mesh, each plane once.
inline ConvexBody convex_body(const TriangleMesh& mesh, const base::Affine3& placing) {
  ConvexBody body;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 a = placing * mesh.corner(t, 0), b = placing * mesh.corner(t, 1),
                  c = placing * mesh.corner(t, 2);
    Vector3 normal = (b - a).cross(c - a).normalized();
    if (placing.linear().determinant() < 0.0) normal = -normal;
    body.push_back({normal, normal.dot(a)});
  }
  return body;
}

/// The part of a polygon that lies in the half-space.
inline std::vector<Vector3> clipped(const std::vector<Vector3>& polygon, const HalfSpace& by) {
  std::vector<Vector3> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = by.normal.dot(a) - by.offset, at_b = by.normal.dot(b) - by.offset;
    if (at_a <= 0.0) result.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0))
      result.emplace_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return result;
}

/// By its faces' distances from the origin. Precondition: it is limited, within 100 m.
inline double convex_volume(const ConvexBody& body) {
  constexpr double kSamePlane = 1e-9, kFar = 200.0;
  // Of bodies that lie against each other rounding might leave one side of the flat face that they share.
  const auto opposite = [](const HalfSpace& one, const HalfSpace& other) {
    return (one.normal + other.normal).norm() < kSamePlane && one.offset + other.offset < kSamePlane;
  };
  for (const HalfSpace& one : body) {
    if (std::any_of(body.begin(), body.end(), [&](const HalfSpace& other) { return opposite(one, other); }))
      return 0.0;
  }
  double volume = 0.0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const HalfSpace& face = body[i];
    const auto same = [&](const HalfSpace& other) {
      return (face.normal - other.normal).norm() < kSamePlane &&
             std::abs(face.offset - other.offset) < kSamePlane;
    };
    if (std::any_of(body.begin(), body.begin() + std::ptrdiff_t(i), same)) continue;
    const Vector3 u = face.normal.unitOrthogonal(), v = face.normal.cross(u),
                  middle = face.offset * face.normal;
    std::vector<Vector3> polygon{middle + kFar * (u + v), middle + kFar * (v - u), middle - kFar * (u + v),
                                 middle + kFar * (u - v)};
    for (const HalfSpace& other : body) {
      if (!same(other)) polygon = clipped(polygon, other);
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vector3 twice = (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
      volume += face.offset * twice.dot(face.normal) / 6.0;
    }
  }
  return volume;
}

/// Of the points for which `holds` is true, given as bits in which bodies a point lies: by inclusion and
/// exclusion over all sets of bodies. Nothing outside of all bodies may be held. Precondition: few bodies.
inline double set_volume(const std::vector<ConvexBody>& bodies,
                         const std::function<bool(std::uint32_t)>& holds) {
  double volume = 0.0;
  for (std::uint32_t set = 1; set < 1U << bodies.size(); ++set) {
    int factor = 0;
    for (std::uint32_t part = set;; part = (part - 1) & set) {
      if (holds(part)) factor += (std::popcount(set ^ part) & 1) != 0 ? -1 : 1;
      if (part == 0) break;
    }
    if (factor == 0) continue;
    ConvexBody shared;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if ((set >> i & 1U) != 0) shared.insert(shared.end(), bodies[i].begin(), bodies[i].end());
    }
    volume += factor * convex_volume(shared);
  }
  return volume;
}

}  // namespace icome::geometry
