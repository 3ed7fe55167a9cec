#pragma once
// Solids made of primitives, in closed form, for the tests of meshing.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/contour/dual_contouring.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// Primitives combined from left to right.
class AnalyticSolid {
 public:
  enum class Join { Add, Cut, Keep };  // union, difference, intersection

  AnalyticSolid& join(Join how, const Primitive& primitive,
                      const Pose& solid_from_primitive = Pose::Identity()) {
    parts_.push_back({how, primitive, solid_from_primitive, solid_from_primitive.inverse()});
    return *this;
  }
  AnalyticSolid& add(const Primitive& primitive, const Pose& pose = Pose::Identity()) {
    return join(Join::Add, primitive, pose);
  }
  AnalyticSolid& cut(const Primitive& primitive, const Pose& pose = Pose::Identity()) {
    return join(Join::Cut, primitive, pose);
  }
  AnalyticSolid& keep(const Primitive& primitive, const Pose& pose = Pose::Identity()) {
    return join(Join::Keep, primitive, pose);
  }

  bool inside(const Vector3& point) const {
    bool in = false;
    for (const Part& part : parts_) {
      const bool in_part = geometry::inside(part.primitive, part.primitive_from_solid * point);
      if (part.how == Join::Add) in = in || in_part;
      if (part.how == Join::Cut) in = in && !in_part;
      if (part.how == Join::Keep) in = in && in_part;
    }
    return in;
  }

  /// By halving the segment, then the normal of the primitive whose surface is nearest there.
  SurfacePoint crossing(Vector3 inner, Vector3 outer) const {
    for (int step = 0; step < 48; ++step) {
      const Vector3 middle = (inner + outer) / 2;
      (inside(middle) ? inner : outer) = middle;
    }
    SurfacePoint found{inner, Vector3::UnitX()};
    double nearest = HUGE_VAL;
    for (const Part& part : parts_) {
      const Vector3 own = part.primitive_from_solid * inner;
      const double off = std::abs(signed_distance(part.primitive, own));
      if (off >= nearest) continue;
      nearest = off;
      const Vector3 normal = part.solid_from_primitive.linear() * scp_from_inside(part.primitive, own).normal;
      found.normal = part.how == Join::Cut ? Vector3(-normal) : normal;
    }
    return found;
  }

  /// The smallest distance from any primitive's surface: at most that to the solid's own.
  double off_primitives(const Vector3& point) const {
    double nearest = HUGE_VAL;
    for (const Part& part : parts_) {
      nearest =
          std::min(nearest, std::abs(signed_distance(part.primitive, part.primitive_from_solid * point)));
    }
    return nearest;
  }

  /// The primitives' surfaces that pass within `reach` of the point: 1 on a face, 2 on an edge.
  int surfaces_at(const Vector3& point, double reach) const {
    return static_cast<int>(std::count_if(parts_.begin(), parts_.end(), [&](const Part& part) {
      return std::abs(signed_distance(part.primitive, part.primitive_from_solid * point)) <= reach;
    }));
  }

  SampledSolid sampled(const Bounds& bounds) const {
    return {bounds, [this](const Vector3& point) { return inside(point); },
            [this](const Vector3& a, const Vector3& b) { return crossing(a, b); }};
  }

 private:
  struct Part {
    Join how;
    Primitive primitive;
    Pose solid_from_primitive, primitive_from_solid;
  };
  std::vector<Part> parts_;
};

/// The box around the origin with this half size along every axis.
inline Bounds cube_around_origin(double half) { return {Vector3::Constant(-half), Vector3::Constant(half)}; }

inline Pose pose_at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

inline Pose pose_turned(double angle, const Vector3& axis) {
  return Pose(Eigen::AngleAxisd(angle, axis.normalized()));
}

}  // namespace icome::geometry
