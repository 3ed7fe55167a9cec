#include "geometry/csg/csg_offset.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/csg/csg_edges.h"
#include "geometry/straight_way_out.h"
#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

using Kind = CsgAtom::Kind;

constexpr double kMostTurn = 0.3;  // rad, of one walk round a tube
constexpr double kInTouch = 1e-9;  // of the bounds: a ball that overlaps by less is at the surface
constexpr int kMostPushes = 8;     // from one piece to the next

/// The reason why the surface at a distance is not known in closed form; empty where it is.
std::string reason_against(const CsgProgram& program, double radius) {
  const Bounds& box = program.bounds();
  if (!box.min().allFinite() || !box.max().allFinite()) return "the solid has no bounds";
  for (const CsgAtom& atom : program.atoms()) {
    if (atom.kind == Kind::Custom) return "it has primitives of their own";
    if (!has_offset(atom)) return "curved primitives are stretched";
    if (atom.kind != Kind::Torus || atom.subtracted) continue;
    if (const auto rest = offset(atom, radius); rest && rest->b >= rest->a)
      return "the hole of a torus is too narrow for the tip";
  }
  return {};
}

/// A step around a tube towards a goal, from the place with the normal `out`.
Vector3 step_round(const Vector3& out, const Vector3& pull, double radius) {
  const Vector3 along = pull - out.dot(pull) * out;
  const double length = along.norm(), most = kMostTurn * radius;
  return length > most ? Vector3(along * (most / length)) : along;
}

}  // namespace

base::Result<std::shared_ptr<const CsgOffset>> CsgOffset::create(const CsgTree& tree, double radius) {
  CsgFaces walls(tree, 0.0);
  if (const std::string reason = reason_against(walls.program(), radius); !reason.empty())
    return base::fail(reason);
  auto edges = csg_edges(walls);
  if (!edges) return base::fail("faces nearly touch each other over a wide part");
  return std::shared_ptr<const CsgOffset>(
      new CsgOffset(std::move(walls), CsgFaces(tree, radius), std::move(*edges)));
}

CsgOffset::CsgOffset(CsgFaces walls, CsgFaces faces, std::vector<CurveArc> edges)
    : walls_(std::move(walls)), faces_(std::move(faces)) {
  std::vector<Eigen::Vector3f> centres;
  for (const CurveArc& arc : edges) centres.emplace_back(arc.bounds().center().cast<float>());
  const Vector3 margin = Vector3::Constant(radius());
  for (const std::uint32_t i : hilbert_order(centres)) {
    edges_.push_back(edges[i]);
    const Bounds box = edges[i].bounds();
    edge_boxes_.push_back(float_box(Bounds(box.min() - margin, box.max() + margin)));
  }
  edge_tree_ = BoxTree(edge_boxes_);
}

Bounds CsgOffset::bounds() const {
  const Bounds& box = walls_.program().bounds();
  if (box.isEmpty()) return box;
  return {box.min() - Vector3::Constant(radius()), box.max() + Vector3::Constant(radius())};
}

void CsgOffset::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                     PieceVisitor visit) const {
  bool more = true;
  faces_.near(a, b, reach, [&](std::uint32_t face, const Bounds& box) {
    more = visit(face, box);
    return more;
  });
  if (!more) return;
  // Boxes of tubes as thick as a tip are loose: by them alone, everything around would be near.
  const double within = radius() + reach + kInTouch * radius();
  edge_tree_.near(SegmentQuery(a, b, reach), [&](std::uint32_t i) {
    if (edges_[i].least_distance(a, b) > within) return true;
    const FloatBox& box = edge_boxes_[i];
    return visit(faces_.count() + i,
                 Bounds(Vector3(box.lo[0], box.lo[1], box.lo[2]), Vector3(box.hi[0], box.hi[1], box.hi[2])));
  });
}

SurfacePlace CsgOffset::on_tube(std::uint32_t piece, double s, const Vector3& normal) const {
  return {edge(piece).at(s) + radius() * normal, normal, piece, s, 0.0};
}

std::optional<SurfaceHit> CsgOffset::first_hit(std::uint32_t piece, const Vector3& start, const Vector3& step,
                                               bool from_behind, double /*time*/, double slack) const {
  if (is_face(piece)) return faces_.first_hit(piece, start, step, from_behind, slack);
  if (from_behind) return std::nullopt;
  const auto touch = edge(piece).first_touch(radius(), start, step, slack);
  if (!touch) return std::nullopt;
  const Vector3 away = start + touch->t * step - edge(piece).at(touch->s);
  if (away.isZero(0.0)) return std::nullopt;
  return SurfaceHit{touch->t, on_tube(piece, touch->s, away.normalized())};
}

SurfacePlace CsgOffset::nearest_local(const SurfacePlace& from, const Vector3& goal, double /*time*/) const {
  if (is_face(from.piece)) return faces_.nearest_local(from, goal);
  const CurveArc& arc = edge(from.piece);
  const double s_from = arc.nearest(from.point, from.u);
  const Vector3 out = (from.point - arc.at(s_from)).normalized();
  const double s = arc.nearest(goal, s_from);
  const Vector3 away = goal - arc.at(s);
  if (const double length = away.norm(); length > 0.0 && away.dot(out) >= std::cos(kMostTurn) * length)
    return on_tube(from.piece, s, away / length);
  const Vector3 round = from.point + step_round(out, goal - from.point, radius());
  const double s_round = arc.nearest(round, s_from);
  SurfacePlace place = on_tube(from.piece, s_round, (round - arc.at(s_round)).normalized());
  place.reached = round == from.point;
  return place;
}

bool CsgOffset::covers(const SurfacePlace& place, const Vector3& /*above*/, double /*time*/,
                       double slack) const {
  return !is_face(place.piece) || faces_.covers(place, slack);
}

/// Calls `visit(place)` for each place of the centre in which a ball around the point, which is not in the
/// solid, would clear one of the faces and edges that it reaches into; until it returns false.
template <typename Visit>
void CsgOffset::overlapped(const Vector3& point, Visit&& visit) const {
  const double slack = kInTouch * bounds().sizes().maxCoeff();
  bool more = true;
  walls_.near(point, point, radius(), [&](std::uint32_t face, const Bounds&) {
    const SurfacePlace foot = walls_.nearest(face, point);
    const double height = foot.normal.dot(point - foot.point);
    const bool reached = height >= 0.0 && (point - foot.point).norm() < radius() - slack;
    if (reached && walls_.covers(foot, slack))
      more = visit(SurfacePlace{foot.point + radius() * foot.normal, foot.normal});
    return more;
  });
  if (!more) return;
  edge_tree_.near(SegmentQuery(point, point, 0.0), [&](std::uint32_t i) {
    const Vector3 foot = edges_[i].at(edges_[i].nearest(point));
    const double distance = (point - foot).norm();
    if (distance <= 0.0 || distance >= radius() - slack) return true;
    const Vector3 away = (point - foot) / distance;
    return visit(SurfacePlace{foot + radius() * away, away});
  });
}

bool CsgOffset::overlaps(const Vector3& point) const {
  bool found = false;
  overlapped(point, [&](const SurfacePlace&) {
    found = true;
    return false;
  });
  return found;
}

bool CsgOffset::inside(const Vector3& point, double /*time*/) const {
  return walls_.program().inside(point) || overlaps(point);
}

// Moves from piece to piece where a ball overlaps a little; else along straight lines.
std::optional<SurfacePlace> CsgOffset::way_out(const Vector3& point, double time) const {
  if (!inside(point, time)) return std::nullopt;
  const double clear = 2.0 * kInTouch * bounds().sizes().maxCoeff();
  Vector3 at = point;
  for (int i = 0; i < kMostPushes && !walls_.program().inside(at); ++i) {
    std::optional<SurfacePlace> farthest;
    overlapped(at, [&](const SurfacePlace& place) {
      if (!farthest || (place.point - at).norm() > (farthest->point - at).norm()) farthest = place;
      return true;
    });
    if (!farthest) return std::nullopt;
    at = farthest->point + clear * farthest->normal;
    if (!inside(at, time)) return SurfacePlace{at, farthest->normal};
  }
  return straight_way_out(point, bounds(), radius(), 20.0 * kInTouch * bounds().sizes().maxCoeff(),
                          [&](const Vector3& centre) { return inside(centre, time); });
}

std::size_t CsgOffset::bytes() const {
  return sizeof(*this) + walls_.bytes() + faces_.bytes() + edge_tree_.bytes() +
         edges_.capacity() * sizeof(CurveArc) + edge_boxes_.capacity() * sizeof(FloatBox);
}

}  // namespace icome::geometry
