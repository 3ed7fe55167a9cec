#include "apps/touch/surface_probe.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "geometry/primitive/primitive_crossing.h"
#include "geometry/tree/hilbert.h"

namespace icome::apps {
namespace {

using base::Vector3;

// Share of a surface that must face one way for it to count as a sheet: 1 is flat, a half sphere has 0.5.
constexpr double kSheet = 0.7;

/// A place of a body's surface, in its own frame.
struct BodyHit {
  double parameter;  // along the line of sight, in [0, 1]
  Vector3 point;     // m
  Vector3 normal;    // unit, out of the solid or towards the front
};

// Twice the triangle's area as a vector along its normal.
Vector3 area_vector(const geometry::TriangleMesh& mesh, std::size_t triangle) {
  const Vector3& first = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - first).cross(mesh.corner(triangle, 2) - first);
}

/// Sums over the triangles of a mesh, in its own frame: twice the areas, as vectors and as numbers.
struct AreaSum {
  Vector3 vector = Vector3::Zero();
  double area = 0.0;

  AreaSum() = default;
  explicit AreaSum(const geometry::TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vector3 part = area_vector(mesh, i);
      vector += part;
      area += part.norm();
    }
  }
};

double box_area(const base::Bounds& box) {
  const Vector3 size = box.sizes();
  return 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

std::optional<BodyHit> hit_on(const geometry::Primitive& primitive, const Vector3& from, const Vector3& to) {
  const auto t = geometry::first_crossing(primitive, from, to - from);
  if (!t) return std::nullopt;
  const geometry::SurfacePoint place = geometry::scp_from_inside(primitive, from + *t * (to - from));
  return BodyHit{*t, place.point, place.normal};
}

std::optional<BodyHit> hit_on(const haptics::SmoothShape& solid, const Vector3& from, const Vector3& to) {
  const auto hit = solid.cast(from, to - from, 0.0);
  if (!hit) return std::nullopt;
  return BodyHit{hit->t, hit->point, hit->normal};
}

std::optional<BodyHit> hit_on(TouchEye& eye, const Vector3& from, const Vector3& to) {
  const auto hit = eye.tree().first_hit(from, to);
  if (!hit) return std::nullopt;
  return BodyHit{hit->parameter, hit->point, area_vector(*eye.mesh(), hit->triangle).normalized()};
}

/// The first hit on a body. Needs no triangles where a line of sight has a closed form, or an exact answer. A
/// half-space is hit only in the square that pictures show of it, so that the hand stays there.
std::optional<BodyHit> first_hit(const TouchBody& body, const Vector3& from, const Vector3& to) {
  if (body.solid) return hit_on(*body.solid, from, to);
  return body.primitive && !is_half_space(body) ? hit_on(*body.primitive, from, to)
                                                : hit_on(*body.eye, from, to);
}

ProbedPoint probed(const TouchBody& body, const BodyHit& hit, const Vector3& from) {
  const Vector3 point = body.world_from_body * hit.point;
  Vector3 normal = body.world_from_body.linear() * hit.normal;
  if (!body.closed && normal.dot(from - point) < 0.0) normal = -normal;
  return {point, normal};
}

}  // namespace

SurfaceProbe::SurfaceProbe(const std::vector<TouchModel>& models) {
  std::vector<const TouchBody*> bodies;
  std::vector<Eigen::Vector3f> places;
  for (const TouchModel& model : models) {
    for (const TouchBody& body : model.bodies) {
      const base::Bounds box = apps::bounds(body);
      if (box.isEmpty()) continue;
      bodies.push_back(&body);
      places.emplace_back(box.center().cast<float>());
      bounds_.extend(box);
    }
  }
  std::vector<geometry::FloatBox> boxes;
  for (const std::uint32_t index : geometry::hilbert_order(places)) {
    bodies_.push_back(bodies[index]);
    boxes.push_back(geometry::float_box(apps::bounds(*bodies[index])));
  }
  boxes_ = geometry::BoxTree(boxes);
  find_front();
}

void SurfaceProbe::find_front() {
  AreaSum sum;
  std::map<const geometry::TriangleMesh*, AreaSum> of_mesh;  // clones share meshes
  for (const TouchBody* body : bodies_) {
    if (is_half_space(*body)) {
      front_ = body->world_from_body.linear() * Vector3::UnitZ();
      return;
    }
    if ((body->solid && body->closed) || body->primitive) {  // it has no front, however large it is
      sum.area += box_area(own_bounds(*body));
      continue;
    }
    const geometry::TriangleMesh& mesh = *body->eye->mesh();
    const auto [found, fresh] = of_mesh.try_emplace(&mesh);
    if (fresh) found->second = AreaSum(mesh);
    sum.vector += body->world_from_body.linear() * found->second.vector;
    sum.area += found->second.area;
  }
  if (sum.vector.norm() > kSheet * sum.area) front_ = sum.vector.normalized();
}

std::optional<ProbedPoint> SurfaceProbe::look(const Vector3& from, const Vector3& to) const {
  std::optional<ProbedPoint> best;
  double first = std::numeric_limits<double>::infinity();
  boxes_.near(geometry::SegmentQuery(from, to, 0.0), [&](std::uint32_t slot) {
    const TouchBody& body = *bodies_[slot];
    const base::Pose body_from_world = body.world_from_body.inverse();
    const auto hit = first_hit(body, body_from_world * from, body_from_world * to);
    if (hit && hit->parameter < first) {
      first = hit->parameter;
      best = probed(body, *hit, from);
    }
    return true;
  });
  return best;
}

}  // namespace icome::apps
