#include "geometry/csg/csg_faces.h"

#include <algorithm>
#include <cmath>

#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

constexpr int kMaxTrace = 400;        // steps of a sphere trace
constexpr double kTraceShare = 1e-9;  // of the way: a trace so near has arrived
constexpr double kMargin = 1e-9;      // boxes are this much larger than what they hold, relatively

/// The bounds of a plane's section through a box; empty when the plane misses the box.
Bounds plane_in_box(const Vector3& origin, const Vector3& normal, const Bounds& box) {
  Bounds result;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Vector3 from = box.min();
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      if ((corner & 1) != 0) from[next] = box.max()[next];
      if ((corner & 2) != 0) from[last] = box.max()[last];
      Vector3 to = from;
      to[axis] = box.max()[axis];
      const double a = normal.dot(from - origin);
      const double b = normal.dot(to - origin);
      if (a == 0.0) result.extend(from);
      if (b == 0.0) result.extend(to);
      if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0))
        result.extend(Vector3(from + (to - from) * (a / (a - b))));
    }
  }
  return result;
}

Bounds grown(const Bounds& box) {
  if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) return box;
  const double size = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Vector3 margin = Vector3::Constant(kMargin * size);
  return {box.min() - margin, box.max() + margin};
}

/// Finds the places at which a segment goes through one face.
class FacePassage {
 public:
  FacePassage(const CsgAtom& atom, bool inwards, const Vector3& start, const Vector3& step, double slack)
      : atom_(atom), inwards_(inwards), start_(start), step_(step), slack_(slack) {}

  /// Calls `accept(t, point, atom_normal)` for passages in the wanted direction, rising t, until it
  /// returns true; the t, or nothing.
  template <typename Accept>
  std::optional<double> first(Accept&& accept) const {
    const Vector3 start = atom_.atom_from_tree * start_;
    const Vector3 step = atom_.atom_from_tree.linear() * step_;
    if (const SurfacePoint here = retract(atom_, start);
        leads_through(tree_normal(atom_, here.normal)) && starts_there(start, here)) {
      if (accept(0.0, start_, tree_normal(atom_, here.normal))) return 0.0;
    }
    if (atom_.kind == Kind::Custom) return trace(start, step, accept);
    const RealRoots hits = crossings(atom_, start, step);
    for (const double t : hits.all()) {
      const Vector3 normal = tree_normal(atom_, retract(atom_, start + t * step).normal);
      if (leads_through(normal) && accept(t, start_ + t * step_, normal)) return t;
    }
    return std::nullopt;
  }

  /// The t at which the segment goes through a triangle of a mesh, if `accept` returns true; else nothing.
  template <typename Accept>
  std::optional<double> first(const PlacedTriangle& triangle, Accept&& accept) const {
    const double fall = triangle.normal.dot(step_);
    if (!leads_through(triangle.normal) || fall == 0.0) return std::nullopt;
    const double height = triangle.normal.dot(start_ - triangle.corners[0]);
    double t = -height / fall;
    if (std::abs(height) <= slack_) t = std::max(t, 0.0);
    if (t < 0.0 || t > 1.0 || !accept(t, start_ + t * step_, triangle.normal)) return std::nullopt;
    return t;
  }

 private:
  bool leads_through(const Vector3& normal) const { return (normal.dot(step_) < 0.0) == inwards_; }

  bool starts_there(const Vector3& start, const SurfacePoint& here) const {
    const double distance = std::abs(signed_distance(atom_, start));
    return distance <= slack_ * (atom_.normal_map * here.normal).norm();
  }

  /// Sphere tracing: each step is as long as the distance allows.
  template <typename Accept>
  std::optional<double> trace(const Vector3& start, const Vector3& step, Accept&& accept) const {
    const double length = step.norm();
    if (length <= 0.0) return std::nullopt;
    const double near = std::max(kTraceShare * length, slack_ * atom_.most_stretch);
    double t = 0.0;
    double before = signed_distance(atom_, start);
    for (int i = 0; i < kMaxTrace && t < 1.0; ++i) {
      const double ahead = std::max(std::abs(before), near) / length;
      const double next = std::min(1.0, t + ahead);
      const double after = signed_distance(atom_, start + next * step);
      if ((before > 0.0) != (after > 0.0) && (before > 0.0) == inwards_) {
        const double there = t + (next - t) * before / (before - after);
        const Vector3 normal = tree_normal(atom_, retract(atom_, start + there * step).normal);
        if (accept(there, start_ + there * step_, normal)) return there;
      }
      t = next;
      before = after;
    }
    if (t >= 1.0) return std::nullopt;
    // Out of steps, close along the surface: stopping there is safe.
    const Vector3 normal = tree_normal(atom_, retract(atom_, start + t * step).normal);
    return accept(t, start_ + t * step_, normal) ? std::optional(t) : std::nullopt;
  }

  const CsgAtom& atom_;
  bool inwards_;
  const Vector3& start_;
  const Vector3& step_;
  double slack_;
};

Bounds around_plane(const CsgAtom& atom, const Bounds& relevant) {
  if (!relevant.min().allFinite() || !relevant.max().allFinite()) return relevant;
  return plane_in_box(atom.tree_from_atom.translation(), tree_normal(atom, Vector3::UnitZ()), relevant);
}

}  // namespace

PlacedTriangle::PlacedTriangle(const CsgAtom& atom, std::uint32_t triangle, double shift) {
  const TriangleMesh& mesh = atom.mesh->mesh;
  for (int i = 0; i < 3; ++i) corners[i] = atom.tree_from_atom * mesh.corner(triangle, i);
  normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  if (atom.tree_from_atom.linear().determinant() < 0.0) normal = -normal;  // mirrored
  for (Vector3& corner : corners) corner += shift * normal;
}

bool PlacedTriangle::covers(const Vector3& point, double slack) const {
  const Vector3 face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (int i = 0; i < 3; ++i) {
    const Vector3 inward = face.cross(corners[(i + 1) % 3] - corners[i]).normalized();
    if (inward.dot(point - corners[i]) < -slack) return false;
  }
  return true;
}

CsgFaces::CsgFaces(const CsgTree& csg, double tip) : program_(csg), tip_(tip) {
  std::vector<Face> unsorted;
  std::vector<Bounds> bounds;
  const auto take = [&](std::uint32_t atom, std::uint32_t triangle, const Bounds& box) {
    if (box.isEmpty()) return;
    unsorted.push_back({atom, triangle});
    const Bounds larger = grown(box);
    bounds.emplace_back(larger.min() - Vector3::Constant(tip_), larger.max() + Vector3::Constant(tip_));
  };
  for (std::uint32_t i = 0; i < program_.atoms().size(); ++i) {
    const CsgAtom& atom = program_.atoms()[i];
    if (tip_ > 0.0) {
      const auto rest = offset(atom, atom.subtracted ? -tip_ : tip_);
      rests_.push_back(rest.value_or(atom));
      if (!rest) continue;
    }
    const Bounds& relevant = program_.relevant(i);
    if (relevant.isEmpty()) continue;
    if (atom.kind == Kind::Mesh) {
      for (std::uint32_t t = 0; t < atom.mesh->mesh.triangles.size(); ++t) {
        Bounds box;
        for (const Vector3& corner : PlacedTriangle(atom, t, 0.0).corners) box.extend(corner);
        take(i, t, box.intersection(relevant));
      }
    } else {
      take(i, 0, atom.kind == Kind::Plane ? around_plane(atom, relevant) : relevant);
    }
  }
  sort(unsorted, bounds);
}

void CsgFaces::sort(const std::vector<Face>& unsorted, const std::vector<Bounds>& bounds) {
  std::vector<Eigen::Vector3f> centres;
  for (const Bounds& box : bounds) {
    const Vector3 centre = box.center();
    centres.emplace_back(centre.allFinite() ? Eigen::Vector3f(centre.cast<float>())
                                            : Eigen::Vector3f::Zero());
  }
  for (const std::uint32_t i : hilbert_order(centres)) {
    faces_.push_back(unsorted[i]);
    boxes_.push_back(float_box(bounds[i]));
  }
  tree_ = BoxTree(boxes_);
}

Bounds CsgFaces::box(std::uint32_t face) const {
  const FloatBox& it = boxes_[face];
  return {Vector3(it.lo[0], it.lo[1], it.lo[2]), Vector3(it.hi[0], it.hi[1], it.hi[2])};
}

/// Does the surface run along the face below the point? `normal` points out of the solid.
bool CsgFaces::trimmed_in(std::uint32_t face, const Vector3& point, const Vector3& normal,
                          double slack) const {
  const Vector3 foot = point - tip_ * normal;
  const CsgAtom& whole = program_.atoms()[faces_[face].atom];
  if (whole.kind == Kind::Mesh && !PlacedTriangle(whole, faces_[face].triangle, 0.0).covers(foot, slack))
    return false;
  // Below a cone's offset beyond the apex there is nothing of the cone.
  if (tip_ > 0.0 && whole.kind == Kind::ConeSide &&
      std::abs(signed_distance(whole, whole.atom_from_tree * foot)) > slack * whole.most_stretch)
    return false;
  return program_.on_surface(faces_[face].atom, foot, sign(face) * normal, slack);
}

SurfacePlace CsgFaces::place(std::uint32_t face, const Vector3& point, const Vector3& atom_normal) const {
  return {point, sign(face) * atom_normal, face, 0.0, 0.0};
}

void CsgFaces::near(const Vector3& a, const Vector3& b, double reach,
                    SmoothSurface::PieceVisitor visit) const {
  tree_.near(SegmentQuery(a, b, reach), [&](std::uint32_t face) { return visit(face, box(face)); });
}

std::optional<SurfaceHit> CsgFaces::first_hit(std::uint32_t face, const Vector3& start, const Vector3& step,
                                              bool from_behind, double slack) const {
  const CsgAtom& atom = this->atom(face);
  SurfaceHit hit{};
  const auto accept = [&](double t, const Vector3& point, const Vector3& atom_normal) {
    hit = {t, place(face, point, atom_normal)};
    return trimmed_in(face, point, hit.place.normal, slack);
  };
  const FacePassage passage(atom, atom.subtracted == from_behind, start, step, slack);
  const auto met = atom.kind == Kind::Mesh
                       ? passage.first(PlacedTriangle(atom, faces_[face].triangle, shift(face)), accept)
                       : passage.first(accept);
  if (!met) return std::nullopt;
  return hit;
}

SurfacePlace CsgFaces::nearest_local(const SurfacePlace& from, const Vector3& goal) const {
  const CsgAtom& atom = this->atom(from.piece);
  if (atom.kind == Kind::Mesh || atom.kind == Kind::Plane) {
    Vector3 origin = atom.tree_from_atom.translation();
    Vector3 normal;
    if (atom.kind == Kind::Mesh) {
      const PlacedTriangle triangle(atom, faces_[from.piece].triangle, shift(from.piece));
      origin = triangle.corners[0];
      normal = triangle.normal;
    } else {
      normal = tree_normal(atom, Vector3::UnitZ());
    }
    return place(from.piece, goal - normal * normal.dot(goal - origin), normal);
  }
  const WalkEnd there = walk(atom, atom.atom_from_tree * from.point, atom.atom_from_tree * goal);
  SurfacePlace found =
      place(from.piece, atom.tree_from_atom * there.place.point, tree_normal(atom, there.place.normal));
  found.reached = there.reached;
  return found;
}

bool CsgFaces::covers(const SurfacePlace& place, double slack) const {
  return trimmed_in(place.piece, place.point, place.normal, slack);
}

SurfacePlace CsgFaces::nearest(std::uint32_t face, const Vector3& point) const {
  SurfacePlace place = nearest_local({point, Vector3::UnitZ(), face, 0.0, 0.0}, point);
  if (const CsgAtom& it = atom(face); it.kind == Kind::Mesh)
    place.point = nearest_point(PlacedTriangle(it, faces_[face].triangle, shift(face)).corners, point);
  return place;
}

std::size_t CsgFaces::bytes() const {
  return program_.bytes() + tree_.bytes() + rests_.capacity() * sizeof(CsgAtom) +
         faces_.capacity() * sizeof(Face) + boxes_.capacity() * sizeof(FloatBox);
}

}  // namespace icome::geometry
