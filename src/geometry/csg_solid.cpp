#include "geometry/csg_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box_tree.h"
#include "geometry/csg_program.h"
#include "geometry/hilbert.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

constexpr int kMaxTrace = 400;        // steps of a sphere trace
constexpr double kTraceShare = 1e-9;  // of the way: how near a trace comes before it counts as there
constexpr double kMargin = 1e-9;      // boxes are this much larger than what they hold, relatively

/// The box around where a plane passes through a box; empty when it does not.
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

/// A triangle of a mesh atom in the tree's frame.
struct PlacedTriangle {
  PlacedTriangle(const CsgAtom& atom, std::uint32_t triangle) {
    const TriangleMesh& mesh = atom.mesh->mesh;
    for (int i = 0; i < 3; ++i) corners[i] = atom.tree_from_atom * mesh.corner(triangle, i);
    normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (atom.tree_from_atom.linear().determinant() < 0.0) normal = -normal;  // mirrored
  }

  bool covers(const Vector3& point, double slack) const {
    const Vector3 face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (int i = 0; i < 3; ++i) {
      const Vector3 inward = face.cross(corners[(i + 1) % 3] - corners[i]).normalized();
      if (inward.dot(point - corners[i]) < -slack) return false;
    }
    return true;
  }

  Corners corners;
  Vector3 normal;  // unit, out of the mesh
};

}  // namespace

/// The faces and the program that trims them.
class CsgSolid::Compiled {
 public:
  explicit Compiled(const CsgTree& csg) : program(csg) {
    std::vector<Face> unsorted;
    std::vector<Bounds> bounds;
    const auto take = [&](std::uint32_t atom, std::uint32_t triangle, const Bounds& box) {
      if (box.isEmpty()) return;
      unsorted.push_back({atom, triangle});
      bounds.push_back(grown(box));
    };
    for (std::uint32_t i = 0; i < program.atoms().size(); ++i) {
      const CsgAtom& atom = program.atoms()[i];
      const Bounds& relevant = program.relevant(i);
      if (relevant.isEmpty()) continue;
      if (atom.kind == Kind::Mesh) {
        for (std::uint32_t t = 0; t < atom.mesh->mesh.triangles.size(); ++t) {
          Bounds box;
          for (const Vector3& corner : PlacedTriangle(atom, t).corners) box.extend(corner);
          take(i, t, box.intersection(relevant));
        }
      } else if (atom.kind == Kind::Plane && relevant.min().allFinite() && relevant.max().allFinite()) {
        take(i, 0,
             plane_in_box(atom.tree_from_atom.translation(), tree_normal(atom, Vector3::UnitZ()), relevant));
      } else {
        take(i, 0, relevant);
      }
    }
    sort(unsorted, bounds);
  }

  struct Face {
    std::uint32_t atom;
    std::uint32_t triangle;  // of a mesh
  };

  const CsgAtom& atom(std::uint32_t face) const { return program.atoms()[faces[face].atom]; }
  double sign(std::uint32_t face) const { return atom(face).subtracted ? -1.0 : 1.0; }

  /// Does the surface run along the face there? `normal` points out of the solid.
  bool covers(std::uint32_t face, const Vector3& point, const Vector3& normal, double slack) const {
    if (atom(face).kind == Kind::Mesh &&
        !PlacedTriangle(atom(face), faces[face].triangle).covers(point, slack))
      return false;
    return program.on_surface(faces[face].atom, point, sign(face) * normal, slack);
  }

  SurfacePlace place(std::uint32_t face, const Vector3& point, const Vector3& atom_normal) const {
    return {point, sign(face) * atom_normal, face, 0.0, 0.0};
  }

  CsgProgram program;
  std::vector<Face> faces;      // in the tree's order
  std::vector<FloatBox> boxes;  // of the faces
  BoxTree tree;

 private:
  void sort(const std::vector<Face>& unsorted, const std::vector<Bounds>& bounds) {
    std::vector<Eigen::Vector3f> centres;
    for (const Bounds& box : bounds) {
      const Vector3 centre = box.center();
      centres.emplace_back(centre.allFinite() ? Eigen::Vector3f(centre.cast<float>())
                                              : Eigen::Vector3f::Zero());
    }
    for (const std::uint32_t i : hilbert_order(centres)) {
      faces.push_back(unsorted[i]);
      boxes.push_back(float_box(bounds[i]));
    }
    tree = BoxTree(boxes);
  }
};

namespace {

/// Finds where a segment goes through one face.
class FacePassage {
 public:
  FacePassage(const CsgAtom& atom, bool inwards, const Vector3& start, const Vector3& step, double slack)
      : atom_(atom), inwards_(inwards), start_(start), step_(step), slack_(slack) {}

  /// Calls `accept(t, point, atom_normal)` for passages in the wanted direction, rising t, until it
  /// returns true; the t, or nothing.
  template <typename Accept>
  std::optional<double> first(std::uint32_t triangle, Accept&& accept) const {
    if (atom_.kind == Kind::Mesh) return through_triangle(PlacedTriangle(atom_, triangle), accept);
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

 private:
  bool leads_through(const Vector3& normal) const { return (normal.dot(step_) < 0.0) == inwards_; }

  bool starts_there(const Vector3& start, const SurfacePoint& here) const {
    const double distance = std::abs(signed_distance(atom_, start));
    return distance <= slack_ * (atom_.normal_map * here.normal).norm();
  }

  template <typename Accept>
  std::optional<double> through_triangle(const PlacedTriangle& triangle, Accept&& accept) const {
    const double fall = triangle.normal.dot(step_);
    if (!leads_through(triangle.normal) || fall == 0.0) return std::nullopt;
    const double height = triangle.normal.dot(start_ - triangle.corners[0]);
    double t = -height / fall;
    if (std::abs(height) <= slack_) t = std::max(t, 0.0);
    if (t < 0.0 || t > 1.0 || !accept(t, start_ + t * step_, triangle.normal)) return std::nullopt;
    return t;
  }

  /// Steps as far as the distance allows.
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
    // Out of steps close along the surface: to stop is safe.
    const Vector3 normal = tree_normal(atom_, retract(atom_, start + t * step).normal);
    return accept(t, start_ + t * step_, normal) ? std::optional(t) : std::nullopt;
  }

  const CsgAtom& atom_;
  bool inwards_;
  const Vector3& start_;
  const Vector3& step_;
  double slack_;
};

}  // namespace

CsgSolid::CsgSolid(const CsgTree& tree) : compiled_(std::make_unique<const Compiled>(tree)) {}
CsgSolid::~CsgSolid() = default;

Bounds CsgSolid::bounds() const { return compiled_->program.bounds(); }

void CsgSolid::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                    PieceVisitor visit) const {
  compiled_->tree.near(SegmentQuery(a, b, reach), [&](std::uint32_t face) {
    const FloatBox& box = compiled_->boxes[face];
    return visit(face,
                 Bounds(Vector3(box.lo[0], box.lo[1], box.lo[2]), Vector3(box.hi[0], box.hi[1], box.hi[2])));
  });
}

bool CsgSolid::inside(const Vector3& point, double /*time*/) const {
  return compiled_->program.inside(point);
}

std::optional<SurfaceEntry> CsgSolid::entry(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                            bool from_behind, double /*time*/, double slack) const {
  const CsgAtom& atom = compiled_->atom(piece);
  const bool inwards = atom.subtracted == from_behind;
  SurfaceEntry entry{};
  const auto accept = [&](double t, const Vector3& point, const Vector3& atom_normal) {
    entry = {t, compiled_->place(piece, point, atom_normal)};
    return compiled_->covers(piece, point, entry.place.normal, slack);
  };
  const FacePassage passage(atom, inwards, start, step, slack);
  if (!passage.first(compiled_->faces[piece].triangle, accept)) return std::nullopt;
  return entry;
}

SurfacePlace CsgSolid::foot(const SurfacePlace& from, const Vector3& goal, double /*time*/) const {
  const CsgAtom& atom = compiled_->atom(from.piece);
  if (atom.kind == Kind::Mesh || atom.kind == Kind::Plane) {
    Vector3 origin = atom.tree_from_atom.translation();
    Vector3 normal;
    if (atom.kind == Kind::Mesh) {
      const PlacedTriangle triangle(atom, compiled_->faces[from.piece].triangle);
      origin = triangle.corners[0];
      normal = triangle.normal;
    } else {
      normal = tree_normal(atom, Vector3::UnitZ());
    }
    return compiled_->place(from.piece, goal - normal * normal.dot(goal - origin), normal);
  }
  const WalkEnd there = walk(atom, atom.atom_from_tree * from.point, atom.atom_from_tree * goal);
  SurfacePlace place = compiled_->place(from.piece, atom.tree_from_atom * there.place.point,
                                        tree_normal(atom, there.place.normal));
  place.reached = there.reached;
  return place;
}

bool CsgSolid::covers(const SurfacePlace& place, const Vector3& /*above*/, double /*time*/,
                      double slack) const {
  return compiled_->covers(place.piece, place.point, place.normal, slack);
}

std::optional<SurfacePlace> CsgSolid::way_out(const Vector3& point, double time) const {
  if (!inside(point)) return std::nullopt;
  const double slack = 1e-12 * point.cwiseAbs().maxCoeff();
  std::optional<SurfacePlace> best;
  // The nearest place of a solid's surface, seen from within, lies on a face.
  compiled_->tree.nearest(point, std::numeric_limits<double>::infinity(), [&](std::uint32_t face) {
    const double limit = best ? (best->point - point).squaredNorm() : std::numeric_limits<double>::infinity();
    SurfacePlace place = foot({point, Vector3::UnitZ(), face, 0.0, 0.0}, point, time);
    if (const CsgAtom& atom = compiled_->atom(face); atom.kind == Kind::Mesh)
      place.point = nearest_point(PlacedTriangle(atom, compiled_->faces[face].triangle).corners, point);
    const double squared = (place.point - point).squaredNorm();
    if (squared >= limit || !compiled_->covers(face, place.point, place.normal, slack)) return limit;
    best = place;
    return squared;
  });
  return best ? best : straight_out(point);
}

/// The nearest way out along some straight lines.
std::optional<SurfacePlace> CsgSolid::straight_out(const Vector3& point) const {
  const Bounds box = bounds();
  const double far = 2.0 * (box.min().allFinite() && box.max().allFinite() ? box.sizes().norm() : 1.0);
  std::optional<SurfacePlace> best;
  for (int i = 0; i < 27; ++i) {
    const Vector3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (direction.isZero(0.0)) continue;
    const Vector3 step = direction.normalized() * far;
    near(point, point + step, 0.0, 0.0, [&](std::uint32_t face, const Bounds&) {
      const auto exit = entry(face, point, step, true, 0.0, 0.0);
      if (exit && (!best || (exit->place.point - point).norm() < (best->point - point).norm()))
        best = exit->place;
      return true;
    });
  }
  return best;
}

std::optional<SurfacePoint> CsgSolid::crossing(const Vector3& a, const Vector3& b) const {
  std::optional<SurfaceEntry> first;
  const Vector3 step = b - a;
  const double slack = 1e-12 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  near(a, b, slack, 0.0, [&](std::uint32_t face, const Bounds&) {
    for (const bool from_behind : {false, true}) {
      const auto there = entry(face, a, step, from_behind, 0.0, slack);
      if (there && (!first || there->t < first->t)) first = there;
    }
    return true;
  });
  if (!first) return std::nullopt;
  return SurfacePoint{first->place.point, first->place.normal};
}

const CsgProgram& CsgSolid::program() const { return compiled_->program; }

std::size_t CsgSolid::bytes() const {
  return sizeof(*this) + compiled_->program.bytes() + compiled_->tree.bytes() +
         compiled_->faces.capacity() * sizeof(Compiled::Face) +
         compiled_->boxes.capacity() * sizeof(FloatBox);
}

}  // namespace icome::geometry
