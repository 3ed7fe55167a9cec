#include "geometry/csg/csg_atom.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/decompositions.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

constexpr double kSimilar = 1e-12;       // relative tolerance of transforms that keep angles
constexpr double kMaxTurn = 0.3;         // rad, of one walk
constexpr int kMaxWalk = 24;             // steps
constexpr double kClose = 0.1;           // of the tightest bend: goals so near the surface have one foot
constexpr double kArrived = 1e-15;       // a step this small, relative to the place's coordinates, is none
constexpr double kAlmost = 1e-6;         // of the longest step: allowed for the last step of a slow walk
constexpr double kApex = 1e-7;           // of the goal's distance: a place so near a cone's apex is at it
constexpr double kSideRounding = 1e-12;  // of coordinates: the accuracy of distances
constexpr double kCustomStride = 0.02;   // of a custom primitive's size

/// The part of a vector across z.
Vector3 across(const Vector3& v) { return {v.x(), v.y(), 0.0}; }

/// A unit vector along `v`, whose length is given; one in the plane z = 0 where that is 0.
Vector3 direction(const Vector3& v, double length) {
  return length > 0.0 ? Vector3(v / length) : Vector3::UnitX();
}

/// The point nearest to `point` on the axis of a capsule.
Vector3 spine(const CsgAtom& capsule, const Vector3& point) {
  return {0.0, 0.0, std::clamp(point.z(), -capsule.b, capsule.b)};
}

/// The point nearest to `point` on the circle in the middle of a torus's tube.
Vector3 core(const CsgAtom& torus, const Vector3& point) {
  const Vector3 out = across(point);
  return torus.a * direction(out, out.norm());
}

/// Is the apex of a cone nearer to `point` than its side is? Only for points beyond the apex.
bool beyond_apex(const CsgAtom& cone, const Vector3& point) {
  const double radius = across(point).norm();
  return radius * cone.b * cone.b < -(cone.a + cone.b * point.z());
}

/// The unit normal that in the tree's frame, which may be stretched, points from the apex to `point`.
Vector3 beyond_normal(const CsgAtom& cone, const Vector3& point) {
  const Vector3 way = cone.metric * (point - apex(cone));
  const double length = way.norm();
  return length > 0.0 ? Vector3(way / length) : way_out_of_apex(cone);
}

Vector3 gradient(const CsgAtom& atom, const Vector3& point) {
  switch (atom.kind) {
    case Kind::Plane:
      return Vector3::UnitZ();
    case Kind::Sphere:
      return direction(point, point.norm());
    case Kind::Cylinder:
      return direction(across(point), across(point).norm());
    case Kind::ConeSide: {
      if (beyond_apex(atom, point)) return beyond_normal(atom, point);
      const Vector3 out = direction(across(point), across(point).norm());
      return (out - atom.b * Vector3::UnitZ()) / std::hypot(1.0, atom.b);
    }
    case Kind::Torus: {
      const Vector3 arm = point - core(atom, point);
      const double length = arm.norm();
      return length > 0.0 ? Vector3(arm / length) : Vector3::UnitZ();
    }
    case Kind::Capsule: {
      const Vector3 arm = point - spine(atom, point);
      return direction(arm, arm.norm());
    }
    case Kind::Mesh:
    case Kind::Custom:
      break;
  }
  return retract(atom, point).normal;
}

/// The derivative of the gradient along the unit tangent `along` at a place of the surface with `normal`.
Vector3 bend(const CsgAtom& atom, const Vector3& point, const Vector3& along) {
  switch (atom.kind) {
    case Kind::Sphere:
      return along / atom.a;
    case Kind::Capsule:
      if (std::abs(point.z()) > atom.b) return along / atom.a;
      [[fallthrough]];
    case Kind::Cylinder:
    case Kind::ConeSide: {
      const Vector3 out = across(point);
      const double radius = out.norm();
      if (radius <= 0.0) return Vector3::Zero();
      const Vector3 around = Vector3::UnitZ().cross(out / radius);
      return around *
             (around.dot(along) / (radius * std::hypot(1.0, atom.kind == Kind::ConeSide ? atom.b : 0.0)));
    }
    case Kind::Torus: {
      // The curvature around the tube is by its own radius, around the axis by the distance from it.
      const Vector3 out = across(point);
      const double radius = out.norm();
      if (radius <= 0.0) return along / atom.b;
      const Vector3 outward = out / radius;
      const Vector3 around = Vector3::UnitZ().cross(outward);
      const double turn = around.dot(along);
      const Vector3 tube = along - around * turn;
      const double lean = gradient(atom, point).dot(outward);
      return tube / atom.b + around * (turn * lean / radius);
    }
    default:
      return Vector3::Zero();
  }
}

/// The two unit vectors that span the tangent plane.
struct Tangents {
  explicit Tangents(const Vector3& normal) : u(normal.unitOrthogonal()), v(normal.cross(u)) {}
  Vector3 u, v;
};

/// One Newton step along the surface that reduces the distance to `goal` in the tree's frame, with the
/// surface's own curvature where that makes a minimum, without it elsewhere.
Vector3 downhill(const CsgAtom& atom, const SurfacePoint& at, const Vector3& goal) {
  const Tangents tangent(at.normal);
  const Vector3 pull = atom.metric * (at.point - goal);
  const double press = -at.normal.dot(pull);
  const base::Vector2 slope(tangent.u.dot(pull), tangent.v.dot(pull));
  Eigen::Matrix2d flat;
  const Vector3 metric_u = atom.metric * tangent.u;
  const Vector3 metric_v = atom.metric * tangent.v;
  flat << tangent.u.dot(metric_u), tangent.u.dot(metric_v), tangent.u.dot(metric_v), tangent.v.dot(metric_v);
  Eigen::Matrix2d bent = flat;
  const Vector3 bend_u = press * bend(atom, at.point, tangent.u);
  const Vector3 bend_v = press * bend(atom, at.point, tangent.v);
  bent(0, 0) += tangent.u.dot(bend_u);
  bent(0, 1) += tangent.u.dot(bend_v);
  bent(1, 0) += tangent.v.dot(bend_u);
  bent(1, 1) += tangent.v.dot(bend_v);
  const double least = 1e-5;
  const bool minimum = bent.determinant() > least * flat.determinant() && bent.trace() > least * flat.trace();
  const base::Vector2 step = -(minimum ? bent : flat).inverse() * slope;
  return tangent.u * step.x() + tangent.v * step.y();
}

RealRoots quadratic(double c0, double c1, double c2) {
  const std::array<double, 3> c{c0, c1, c2};
  return real_roots(c, 0.0, 1.0);
}

RealRoots torus_crossings(const CsgAtom& atom, const Vector3& start, const Vector3& step) {
  // (|p|^2 + a^2 - b^2)^2 = 4 a^2 (x^2 + y^2)
  const double s0 = start.squaredNorm() + atom.a * atom.a - atom.b * atom.b;
  const double s1 = 2.0 * start.dot(step);
  const double s2 = step.squaredNorm();
  const double four = 4.0 * atom.a * atom.a;
  const Vector3 flat_start = across(start);
  const Vector3 flat_step = across(step);
  const std::array<double, 5> c{
      s0 * s0 - four * flat_start.squaredNorm(), 2.0 * s0 * s1 - 2.0 * four * flat_start.dot(flat_step),
      s1 * s1 + 2.0 * s0 * s2 - four * flat_step.squaredNorm(), 2.0 * s1 * s2, s2 * s2};
  return real_roots(c, 0.0, 1.0);
}

RealRoots cone_crossings(const CsgAtom& atom, const Vector3& start, const Vector3& step) {
  const double r0 = atom.a + atom.b * start.z();
  const double r1 = atom.b * step.z();
  const Vector3 flat_start = across(start);
  const Vector3 flat_step = across(step);
  RealRoots both = quadratic(flat_start.squaredNorm() - r0 * r0, 2.0 * (flat_start.dot(flat_step) - r0 * r1),
                             flat_step.squaredNorm() - r1 * r1);
  RealRoots roots;
  for (const double t : both.all()) {
    if (r0 + t * r1 >= 0.0) roots.add(t);  // beyond the apex is the other nappe
  }
  return roots;
}

RealRoots cylinder_crossings(double radius, const Vector3& start, const Vector3& step) {
  const Vector3 flat_start = across(start);
  const Vector3 flat_step = across(step);
  return quadratic(flat_start.squaredNorm() - radius * radius, 2.0 * flat_start.dot(flat_step),
                   flat_step.squaredNorm());
}

RealRoots sphere_crossings(double radius, const Vector3& start, const Vector3& step) {
  return quadratic(start.squaredNorm() - radius * radius, 2.0 * start.dot(step), step.squaredNorm());
}

/// A convex body has one crossing in and one out, on its side or one of its ends; on a seam they come twice.
RealRoots capsule_crossings(const CsgAtom& atom, const Vector3& start, const Vector3& step) {
  RealRoots roots;
  const auto height = [&](double t) { return start.z() + t * step.z(); };
  const auto take = [&](double t) {
    if (roots.count == roots.t.size()) return;
    unsigned place = roots.count++;
    for (; place > 0 && roots.t[place - 1] > t; --place) roots.t[place] = roots.t[place - 1];
    roots.t[place] = t;
  };
  const RealRoots side = cylinder_crossings(atom.a, start, step);
  for (const double t : side.all()) {
    if (std::abs(height(t)) <= atom.b) take(t);
  }
  for (const double end : {-atom.b, atom.b}) {
    const RealRoots ball = sphere_crossings(atom.a, start - end * Vector3::UnitZ(), step);
    for (const double t : ball.all()) {
      if (std::abs(height(t)) >= atom.b && (height(t) > 0.0) == (end > 0.0)) take(t);
    }
  }
  return roots;
}

Affine3 placed(const Affine3& tree_from_leaf, const Vector3& origin, const Vector3& axis) {
  Affine3 leaf_from_atom = Affine3::Identity();
  leaf_from_atom.linear() = base::rotation_between(Vector3::UnitZ(), axis).toRotationMatrix();
  leaf_from_atom.translation() = origin;
  return tree_from_leaf * leaf_from_atom;
}

/// Adds the atoms of a primitive.
class PrimitiveAtoms {
 public:
  PrimitiveAtoms(const Affine3& tree_from_leaf, std::vector<CsgAtom>& into)
      : tree_from_leaf_(tree_from_leaf), into_(into) {}

  void operator()(const Plane&) { add_plane(Vector3::Zero(), Vector3::UnitZ()); }
  void operator()(const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0})
        add_plane(side * box.half[axis] * Vector3::Unit(axis), side * Vector3::Unit(axis));
    }
  }
  void operator()(const Sphere& sphere) { add(Kind::Sphere, sphere.radius, 0.0); }
  void operator()(const Cylinder& cylinder) {
    add(Kind::Cylinder, cylinder.radius, 0.0);
    add_ends(cylinder.height);
  }
  void operator()(const Cone& cone) {
    if (cone.bottom_radius == cone.top_radius) return (*this)(Cylinder{cone.bottom_radius, cone.height});
    add(Kind::ConeSide, 0.5 * (cone.bottom_radius + cone.top_radius),
        (cone.top_radius - cone.bottom_radius) / cone.height);
    add_ends(cone.height);
  }
  void operator()(const Torus& torus) { add(Kind::Torus, torus.major_radius, torus.minor_radius); }
  void operator()(const Capsule& capsule) { add(Kind::Capsule, capsule.radius, 0.5 * capsule.height); }

 private:
  void add(Kind kind, double a, double b) { into_.emplace_back(kind, a, b, tree_from_leaf_); }
  void add_plane(const Vector3& origin, const Vector3& normal) {
    into_.emplace_back(Kind::Plane, 0.0, 0.0, placed(tree_from_leaf_, origin, normal));
  }
  void add_ends(double height) {
    add_plane({0.0, 0.0, -0.5 * height}, -Vector3::UnitZ());
    add_plane({0.0, 0.0, 0.5 * height}, Vector3::UnitZ());
  }

  const Affine3& tree_from_leaf_;
  std::vector<CsgAtom>& into_;
};

}  // namespace

CsgAtom::CsgAtom(Kind atom_kind, double size_a, double size_b, const Affine3& tree_from_frame)
    : kind(atom_kind),
      a(size_a),
      b(size_b),
      tree_from_atom(tree_from_frame),
      atom_from_tree(tree_from_frame.inverse()),
      normal_map(atom_from_tree.linear().transpose()),
      metric(tree_from_frame.linear().transpose() * tree_from_frame.linear()) {
  most_stretch = std::sqrt(atom_from_tree.linear().squaredNorm());
  const double scale = metric.trace() / 3.0;
  similar = (metric - scale * Matrix3::Identity()).cwiseAbs().maxCoeff() <= kSimilar * scale;
}

std::vector<CsgAtom> atoms(const CsgLeaf& leaf) {
  std::vector<CsgAtom> result;
  if (const auto* primitive = std::get_if<Primitive>(&leaf.shape())) {
    std::visit(PrimitiveAtoms(leaf.tree_from_shape(), result), *primitive);
  } else if (const auto* mesh = std::get_if<std::shared_ptr<const MeshSolid>>(&leaf.shape())) {
    result.emplace_back(Kind::Mesh, 0.0, 0.0, leaf.tree_from_shape());
    result.back().mesh = *mesh;
  } else {
    result.emplace_back(Kind::Custom, 0.0, 0.0, leaf.tree_from_shape());
    result.back().custom = std::get<std::shared_ptr<const CsgPrimitive>>(leaf.shape());
  }
  return result;
}

bool has_offset(const CsgAtom& atom) {
  if (atom.kind == Kind::Plane || atom.kind == Kind::Mesh) return true;
  return atom.similar && atom.kind != Kind::Custom;
}

std::optional<CsgAtom> offset(const CsgAtom& atom, double distance) {
  CsgAtom result = atom;
  const double scaled = distance * atom.normal_map.col(2).norm();
  switch (atom.kind) {
    case Kind::Plane:
      result.tree_from_atom.pretranslate(distance * tree_normal(atom, Vector3::UnitZ()));
      result.atom_from_tree = result.tree_from_atom.inverse();
      return result;
    case Kind::ConeSide:
      result.a += scaled * std::hypot(1.0, atom.b);
      return result;
    case Kind::Torus:
      result.b += scaled;
      return result.b > 0.0 ? std::optional(result) : std::nullopt;
    case Kind::Sphere:
    case Kind::Cylinder:
    case Kind::Capsule:
      result.a += scaled;
      return result.a > 0.0 ? std::optional(result) : std::nullopt;
    default:
      return result;
  }
}

double signed_distance(const CsgAtom& atom, const Vector3& point) {
  switch (atom.kind) {
    case Kind::Plane:
      return point.z();
    case Kind::Sphere:
      return point.norm() - atom.a;
    case Kind::Cylinder:
      return across(point).norm() - atom.a;
    case Kind::ConeSide:
      if (beyond_apex(atom, point)) return (point - apex(atom)).norm();
      return (across(point).norm() - atom.a - atom.b * point.z()) / std::hypot(1.0, atom.b);
    case Kind::Torus:
      return (point - core(atom, point)).norm() - atom.b;
    case Kind::Capsule:
      return (point - spine(atom, point)).norm() - atom.a;
    case Kind::Mesh:
    case Kind::Custom:
      break;
  }
  const bool within = atom.custom->inside(point);
  const SurfacePoint near =
      within ? atom.custom->scp_from_inside(point) : atom.custom->scp_from_outside(point);
  const double distance = (near.point - point).norm();
  return within ? -distance : distance;
}

AtomHeight height_in_tree(const CsgAtom& atom, const Vector3& point) {
  const double distance = signed_distance(atom, point);
  const Vector3 normal = atom.normal_map * retract(atom, point).normal;
  const double stretch = normal.norm();
  return {distance / stretch, normal / stretch};
}

double tightest_bend(const CsgAtom& atom, const Vector3& point) {
  switch (atom.kind) {
    case Kind::Sphere:
    case Kind::Capsule:
      return atom.a;
    case Kind::Cylinder:
    case Kind::ConeSide:
      return across(point).norm() * std::hypot(1.0, atom.kind == Kind::ConeSide ? atom.b : 0.0);
    case Kind::Torus:
      return std::min(atom.b, across(point).norm());
    case Kind::Custom:
      return kCustomStride / kMaxTurn * atom.custom->bounds().sizes().maxCoeff();
    default:
      return std::numeric_limits<double>::infinity();
  }
}

std::optional<bool> side_of(const CsgAtom& atom, const Bounds& box) {
  const Vector3 centre = atom.atom_from_tree * box.center();
  const Vector3 half = atom.atom_from_tree.linear().cwiseAbs() * (0.5 * box.sizes());
  const double rounding = kSideRounding * centre.cwiseAbs().maxCoeff();
  if (atom.kind == Kind::Mesh) {
    if (atom.mesh->tree.nearest(centre, half.norm() + rounding)) return std::nullopt;
    return atom.mesh->tree.encloses(centre);
  }
  const double reach = (atom.kind == Kind::Plane ? half.z() : half.norm()) + rounding;
  const double distance = signed_distance(atom, centre);
  if (std::abs(distance) <= reach) return std::nullopt;
  return distance < 0.0;
}

SurfacePoint retract(const CsgAtom& atom, const Vector3& point) {
  if (atom.kind == Kind::Custom) {
    return atom.custom->inside(point) ? atom.custom->scp_from_inside(point)
                                      : atom.custom->scp_from_outside(point);
  }
  const Vector3 normal = gradient(atom, point);
  if (atom.kind == Kind::ConeSide && beyond_apex(atom, point)) return {apex(atom), normal};
  return {point - signed_distance(atom, point) * normal, normal};
}

RealRoots crossings(const CsgAtom& atom, const Vector3& start, const Vector3& step) {
  switch (atom.kind) {
    case Kind::Plane: {
      RealRoots root;
      const double t = -start.z() / step.z();
      if (t >= 0.0 && t <= 1.0) root.add(t);
      return root;
    }
    case Kind::Sphere:
      return sphere_crossings(atom.a, start, step);
    case Kind::Cylinder:
      return cylinder_crossings(atom.a, start, step);
    case Kind::Capsule:
      return capsule_crossings(atom, start, step);
    case Kind::ConeSide:
      return cone_crossings(atom, start, step);
    case Kind::Torus:
      return torus_crossings(atom, start, step);
    case Kind::Mesh:
    case Kind::Custom:
      break;
  }
  return {};
}

WalkEnd walk(const CsgAtom& atom, const Vector3& from, const Vector3& goal) {
  const SurfacePoint start = retract(atom, from);
  SurfacePoint at = start;
  bool begun_there = false;  // next to the goal
  if (atom.kind == Kind::ConeSide) {
    // To and from its apex a cone is straight, however much the normals turn.
    const double height = std::abs(from.z() - apex(atom).z());
    const bool at_apex = across(from).norm() <= kApex * (goal - apex(atom)).norm() &&
                         height <= kApex * (goal - apex(atom)).norm();
    if (at_apex || (atom.similar && beyond_apex(atom, goal))) return {retract(atom, goal), true};
  }
  const double radius = tightest_bend(atom, start.point);
  // Normals are alike all round the top of a torus, where the distance must count as well.
  const auto within = [&](const SurfacePoint& place, double turn) {
    return place.normal.dot(start.normal) >= std::cos(turn) &&
           (atom.kind != Kind::Torus || (place.point - start.point).norm() <= turn * radius);
  };
  if (atom.kind != Kind::Custom) {
    const SurfacePoint there = retract(atom, goal);
    const bool close = (there.point - goal).norm() <= kClose * radius;
    if (atom.similar && within(there, close ? 2.0 * kMaxTurn : kMaxTurn)) return {there, true};
    begun_there = close && within(there, 2.0 * kMaxTurn);
    if (begun_there) at = there;
  }
  bool reached = false;
  for (int i = 0; i < kMaxWalk && !reached; ++i) {
    Vector3 step = downhill(atom, at, goal);
    const double length = step.norm();
    const double longest = 0.5 * kMaxTurn * tightest_bend(atom, at.point);
    if (length > longest) step *= longest / length;
    at = retract(atom, at.point + step);
    if (atom.kind == Kind::ConeSide && at.point == apex(atom)) return {retract(atom, goal), true};
    reached = length <= kArrived * at.point.cwiseAbs().maxCoeff();
    if (!begun_there && !within(at, kMaxTurn)) break;
    if (i + 1 == kMaxWalk) reached = length <= kAlmost * longest;
  }
  return {at, reached};
}

}  // namespace icome::geometry
