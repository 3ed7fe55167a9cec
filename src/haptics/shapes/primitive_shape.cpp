#include "haptics/shapes/primitive_shape.h"

#include <cmath>
#include <limits>

#include "geometry/primitive/primitive_crossing.h"

namespace icome::haptics {
namespace {

using Kind = Element::Kind;

/// Takes a primitive apart into elements; numbers them in the order in which they are made.
class PrimitiveElements {
 public:
  PrimitiveElements(const GatherRequest& request, ElementSink& sink) : request_(request), sink_(sink) {
    const Vector3 margin = Vector3::Constant(request.reach + request.tip);
    wanted_ = Bounds(request.a.cwiseMin(request.b) - margin, request.a.cwiseMax(request.b) + margin);
  }

  void operator()(const geometry::Plane&) {
    Element plane = blank(Kind::Plane);
    add(plane, unlimited());
  }

  void operator()(const geometry::Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) add_box_face(box.half, axis, side);
    }
    if (request_.tip <= 0.0) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) add_box_edge(box.half, axis, corner);
    }
    for (int corner = 0; corner < 8; ++corner) add_box_corner(box.half, corner);
  }

  void operator()(const geometry::Sphere& sphere) { add_round(blank(Kind::Ball), sphere.radius); }

  void operator()(const geometry::Cylinder& cylinder) {
    Element side = blank(Kind::Rod);
    side.origin = {0.0, 0.0, -0.5 * cylinder.height};
    side.a = cylinder.height;
    add_round(side, cylinder.radius);
    add_cap(cylinder.radius, -0.5 * cylinder.height, -1.0);
    add_cap(cylinder.radius, 0.5 * cylinder.height, 1.0);
  }

  void operator()(const geometry::Cone& cone) {
    Element side = blank(Kind::ConeSide);
    side.origin = {0.0, 0.0, -0.5 * cone.height};
    side.a = cone.bottom_radius;
    side.b = std::hypot(cone.height, cone.bottom_radius - cone.top_radius);
    side.c = (cone.bottom_radius - cone.top_radius) / side.b;
    add_both(side, around(std::max(cone.bottom_radius, cone.top_radius), cone.height));
    add_cap(cone.bottom_radius, -0.5 * cone.height, -1.0);
    add_cap(cone.top_radius, 0.5 * cone.height, 1.0);
  }

  void operator()(const geometry::Torus& torus) {
    Element ring = blank(Kind::Ring);
    ring.a = torus.major_radius;
    add_round(ring, torus.minor_radius);
  }

  void operator()(const geometry::Capsule& capsule) {
    Element rod = blank(Kind::Capsule);
    rod.origin = {0.0, 0.0, -0.5 * capsule.height};
    rod.a = capsule.height;
    add_round(rod, capsule.radius);
  }

 private:
  bool both_sides() const { return request_.sides == TouchableSides::Both; }

  Element blank(Kind kind) {
    Element e;
    e.kind = kind;
    e.feature = feature_++;
    e.two_sided = both_sides();
    e.radius = e.tip = request_.tip;
    return e;
  }

  static Bounds unlimited() {
    const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-far, far};
  }

  /// The box of a solid of revolution about z.
  static Bounds around(double radius, double height) {
    const Vector3 half(radius, radius, 0.5 * height);
    return {-half, half};
  }

  void add(const Element& element, const Bounds& bounds) {
    if (bounds.intersects(wanted_)) sink_.add(element, bounds);
  }

  /// A curved piece from outside and, for a shell, from within.
  void add_both(Element element, const Bounds& bounds) {
    add(element, bounds);
    if (!both_sides()) return;
    element.feature = feature_++;
    element.inverted = true;
    element.radius -= 2.0 * element.tip;
    if (element.kind == Kind::ConeSide || element.radius > 0.0) add(element, bounds);
  }

  /// A piece that lies `radius` around a centre, axis or circle.
  void add_round(Element element, double radius) {
    element.radius = radius + request_.tip;
    const double rho = radius + (element.kind == Kind::Ring ? element.a : 0.0);
    const double along = element.kind == Kind::Ball || element.kind == Kind::Ring ? 0.0 : element.a;
    const Vector3 half(rho, rho, 0.5 * along + radius);
    add_both(element, Bounds(-half, half));
  }

  /// The flat end of a cylinder or cone at height z and, for a sphere tip, its rim.
  void add_cap(double radius, double z, double side) {
    if (radius > 0.0) {
      Element disc = blank(Kind::Disc);
      disc.origin = {0.0, 0.0, z};
      disc.axis = {0.0, 0.0, side};
      disc.a = radius;
      const Vector3 half(radius, radius, 0.0);
      add(disc, Bounds(disc.origin - half, disc.origin + half));
    }
    if (request_.tip <= 0.0) return;
    Element rim = blank(radius > 0.0 ? Kind::Ring : Kind::Ball);
    rim.origin = {0.0, 0.0, z};
    rim.a = radius;
    const Vector3 half(radius, radius, 0.0);
    add(rim, Bounds(rim.origin - half, rim.origin + half));
  }

  void add_box_face(const Vector3& half, int axis, double side) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    Element face = blank(Kind::Parallelogram);
    face.axis = side * Vector3::Unit(axis);
    face.origin = side * half[axis] * Vector3::Unit(axis);
    face.u = Vector3::Unit(next);
    face.v = Vector3::Unit(last);
    face.a = half[next];
    face.b = half[last];
    Vector3 extent = half;
    extent[axis] = 0.0;
    add(face, Bounds(face.origin - extent, face.origin + extent));
  }

  void add_box_edge(const Vector3& half, int axis, int corner) {
    Element edge = blank(Kind::Rod);
    edge.axis = Vector3::Unit(axis);
    edge.a = 2.0 * half[axis];
    edge.origin[axis] = -half[axis];
    edge.origin[(axis + 1) % 3] = (corner & 1 ? 1.0 : -1.0) * half[(axis + 1) % 3];
    edge.origin[(axis + 2) % 3] = (corner & 2 ? 1.0 : -1.0) * half[(axis + 2) % 3];
    add(edge, Bounds(edge.origin, edge.origin + edge.a * edge.axis));
  }

  void add_box_corner(const Vector3& half, int corner) {
    Element ball = blank(Kind::Ball);
    for (int axis = 0; axis < 3; ++axis) ball.origin[axis] = (corner >> axis & 1 ? 1.0 : -1.0) * half[axis];
    add(ball, Bounds(ball.origin, ball.origin));
  }

  const GatherRequest& request_;
  ElementSink& sink_;
  Bounds wanted_;
  std::uint32_t feature_ = 0;
};

}  // namespace

void PrimitiveShape::gather(const GatherRequest& request, ElementSink& sink) const {
  std::visit(PrimitiveElements(request, sink), primitive_);
}

std::optional<geometry::SurfacePoint> PrimitiveShape::way_out(const Vector3& position,
                                                              double /*time*/) const {
  if (!geometry::inside(primitive_, position)) return std::nullopt;
  return geometry::scp_from_inside(primitive_, position);
}

std::optional<geometry::SurfacePoint> PrimitiveShape::nearest(const Vector3& position, double limit,
                                                              TouchableSides /*sides*/) const {
  geometry::SurfacePoint place = geometry::scp_from_outside(primitive_, position);
  const Vector3 away = position - place.point;
  const double distance = away.norm();
  if (distance > limit) return std::nullopt;
  if (distance > 0.0) place.normal = away / distance;
  return place;
}

std::optional<ShapeHit> PrimitiveShape::cast(const Vector3& start, const Vector3& step,
                                             double /*time*/) const {
  const std::optional<double> t = geometry::first_crossing(primitive_, start, step);
  if (!t) return std::nullopt;
  // Rounding may have left the place off the surface; the normal is the nearest face's.
  const geometry::SurfacePoint place = geometry::scp_from_inside(primitive_, start + *t * step);
  return ShapeHit{*t, place.point, place.normal};
}

}  // namespace icome::haptics
