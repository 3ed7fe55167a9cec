#include "geometry/implicit/implicit_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/implicit/implicit_crossing.h"
#include "geometry/implicit/implicit_pieces.h"
#include "geometry/implicit/implicit_walk.h"
#include "geometry/implicit/implicit_way_out.h"
#include "geometry/segment.h"

namespace icome::geometry {
namespace {

constexpr std::uint32_t kSides = 6;  // pieces 1 to 6

bool is_side(std::uint32_t piece) { return piece >= 1 && piece <= kSides; }
/// The formula's pieces by their numbers in ImplicitPieces (index) and here (piece).
std::size_t index_of(std::uint32_t piece) { return piece == 0 ? 0 : piece - kSides; }
std::uint32_t piece_of(std::size_t index) { return std::uint32_t(index == 0 ? 0 : index + kSides); }

Eigen::Index axis_of(std::uint32_t side_piece) { return (side_piece - 1) / 2; }
double direction_of(std::uint32_t side_piece) { return side_piece % 2 == 0 ? 1.0 : -1.0; }

Vector3 side_normal(std::uint32_t piece) {
  Vector3 normal = Vector3::Zero();
  normal[axis_of(piece)] = direction_of(piece);
  return normal;
}

double side_level(const Bounds& box, std::uint32_t piece) {
  return (direction_of(piece) > 0.0 ? box.max() : box.min())[axis_of(piece)];
}

/// The part of a side that the solid may reach at some time; empty if it never does.
Bounds side_part(const Formula& formula, const Bounds& box, std::uint32_t piece) {
  constexpr int kParts = 16;
  const Eigen::Index axis = axis_of(piece), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto edge = [&](Eigen::Index along, int i) {
    return i == kParts ? box.max()[along] : box.min()[along] + box.sizes()[along] * i / kParts;
  };
  Bounds part;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      Bounds cell;
      cell.min()[axis] = cell.max()[axis] = side_level(box, piece);
      cell.min()[u] = edge(u, i), cell.max()[u] = edge(u, i + 1);
      cell.min()[v] = edge(v, j), cell.max()[v] = edge(v, j + 1);
      if (sign_in_box(formula, cell) <= 0) part.extend(cell);
    }
  }
  return part;
}

std::string box_complaint(const Bounds& box) {
  if (!box.min().allFinite() || !box.max().allFinite()) {
    return "the box around an implicit surface needs finite bounds";
  }
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Vector3 sizes = box.max() - box.min();
  if (!(sizes.minCoeff() > 0.0)) {
    return "the box around an implicit surface is empty: each lower bound must be below the upper one";
  }
  if (!sizes.allFinite() || !std::isfinite(sizes.squaredNorm())) {
    return "the box around an implicit surface is too large to compute with";
  }
  if (sizes.minCoeff() < 1e-9 * std::max(largest, sizes.maxCoeff())) {
    return "the box around an implicit surface is too thin for its size or its distance from the origin";
  }
  return {};
}

bool is_within(const Bounds& box, const Vector3& point, double reach) {
  return ((point - box.min()).array() >= -reach).all() && ((box.max() - point).array() >= -reach).all();
}

}  // namespace

struct ImplicitSurface::Parts {
  ImplicitPieces pieces;
  std::array<Bounds, kSides> sides;  // the parts that count of pieces 1 to 6
  Bounds bounds;
  double size;  // m, of the box

  Parts(FormulaPieces read, const Bounds& box)
      : pieces(std::move(read), box), bounds(pieces.bounds()), size(box.diagonal().norm()) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      sides[i] = side_part(pieces.whole(), box, i + 1);
      bounds.extend(sides[i]);
    }
  }

  const Formula& formula() const { return pieces.whole(); }
  ImplicitWalk walk(std::uint32_t piece, double time) const {
    return {pieces.formula(index_of(piece)), time, size};
  }
};

ImplicitSurface::ImplicitSurface(std::unique_ptr<const Parts> parts, const Bounds& box)
    : parts_(std::move(parts)), box_(box) {}

ImplicitSurface::~ImplicitSurface() = default;

base::Result<std::shared_ptr<const ImplicitSurface>> ImplicitSurface::create(const std::string& formula,
                                                                             const Bounds& box) {
  if (const std::string complaint = box_complaint(box); !complaint.empty()) return base::fail(complaint);
  auto read = FormulaPieces::parse(formula, FormulaPieces::Ends::GoOn);
  if (!read) return base::fail(read.error().message);
  if (!read->whole.uses_place()) {
    return base::fail("the formula does not depend on x, y or z, so it has no surface");
  }
  auto parts = std::make_unique<const Parts>(std::move(*read), box);
  if (parts->pieces.bounds().isEmpty()) {
    const bool negative = parts->formula().value(box.center(), 0.0) < 0.0;
    return base::fail(
        fmt::format("there is no surface: the formula is {} everywhere in the box; the solid "
                    "is where it is negative, so change the formula or the box",
                    negative ? "negative" : "positive or undefined"));
  }
  return std::shared_ptr<const ImplicitSurface>(new ImplicitSurface(std::move(parts), box));
}

ImplicitSurface::Value ImplicitSurface::value(const Vector3& point, double time) const {
  const Formula::Slope at = parts_->formula().slope(point, time);
  return {at.value, at.gradient, at.rate};
}

double ImplicitSurface::value_at(const Vector3& point, double time) const {
  return parts_->formula().value(point, time);
}

Bounds ImplicitSurface::bounds() const { return parts_->bounds; }

bool ImplicitSurface::changes() const { return parts_->formula().uses_time(); }

std::size_t ImplicitSurface::bytes() const {
  return sizeof(*this) + sizeof(Parts) - sizeof(ImplicitPieces) + parts_->pieces.bytes();
}

void ImplicitSurface::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                           PieceVisitor visit) const {
  for (std::size_t i = 0; i < parts_->pieces.size(); ++i) {
    const auto visit_cell = [&](const Bounds& part) { return visit(piece_of(i), part); };
    if (!parts_->pieces.cells(i).near(a, b, reach, visit_cell)) return;
  }
  for (std::uint32_t piece = 1; piece <= kSides; ++piece) {
    const Bounds& part = parts_->sides[piece - 1];
    if (part.isEmpty() || !part_within(part, a, b - a, reach)) continue;
    if (!visit(piece, part)) return;
  }
}

bool ImplicitSurface::inside(const Vector3& point, double time) const {
  return box_.contains(point) && value_at(point, time) < 0.0;
}

std::optional<SurfacePlace> ImplicitSurface::way_out(const Vector3& point, double time) const {
  if (!inside(point, time)) return std::nullopt;
  std::optional<SurfacePlace> nearest;
  double distance = std::numeric_limits<double>::infinity();
  if (const auto out = implicit_way_out(parts_->pieces, box_, point, time)) {
    nearest = SurfacePlace{out->place.point, out->place.normal, piece_of(out->piece)};
    distance = (out->place.point - point).norm();
  }
  for (std::uint32_t piece = 1; piece <= kSides; ++piece) {
    const SurfacePlace place = nearest_local({point, side_normal(piece), piece}, point, time);
    const double height = std::fabs(point[axis_of(piece)] - side_level(box_, piece));
    if (height < distance && parts_->formula().value(place.point, time) < 0.0) {
      nearest = place;
      distance = height;
    }
  }
  return nearest;
}

std::optional<SurfaceHit> ImplicitSurface::first_hit(std::uint32_t piece, const Vector3& start,
                                                     const Vector3& step, bool from_behind, double time,
                                                     double slack) const {
  return is_side(piece) ? hit_of_side(piece, start, step, from_behind, time, slack)
                        : hit_of_formula(piece, start, step, from_behind, time, slack);
}

std::optional<SurfaceHit> ImplicitSurface::hit_of_formula(std::uint32_t piece, const Vector3& start,
                                                          const Vector3& step, bool from_behind, double time,
                                                          double slack) const {
  const auto stay = part_within(box_, start, step, slack);
  if (!stay) return std::nullopt;
  const auto [first, last] = *stay;
  const ImplicitPieces& pieces = parts_->pieces;
  const std::size_t index = index_of(piece);
  const ImplicitWalk walk = parts_->walk(piece, time);
  const auto place_at = [&](double t) -> SurfacePlace {
    const Vector3 point = start + t * step;
    // At a jump of f, or at the beginning of its values, there is no gradient: then the surface faces along
    // the line on which it is met.
    const Vector3 facing = from_behind ? step : -step;
    return {point, walk.normal(point).value_or(facing.stableNormalized()), piece};
  };
  const auto counts = [&](double t, bool jump) {
    const SurfacePlace place = place_at(t);
    if (jump && pieces.border_at(place.point, time, slack)) return pieces.is_border(index);
    return pieces.covers(index, place.point, place.normal, time, slack);
  };
  const auto t = first_crossing(pieces.formula(index),
                                {start, step, first, last, time, slack, from_behind, first == 0.0}, counts);
  if (!t) return std::nullopt;
  return SurfaceHit{*t, place_at(*t)};
}

std::optional<SurfaceHit> ImplicitSurface::hit_of_side(std::uint32_t piece, const Vector3& start,
                                                       const Vector3& step, bool from_behind, double time,
                                                       double slack) const {
  const Eigen::Index axis = axis_of(piece);
  const double outwards = direction_of(piece) * (from_behind ? -1.0 : 1.0);
  const double height = outwards * (start[axis] - side_level(box_, piece));
  const double change = outwards * step[axis];
  if (!(change < 0.0) || !(height >= -slack)) return std::nullopt;
  const auto at = [&](double t) -> std::optional<SurfaceHit> {
    SurfacePlace place{start + t * step, side_normal(piece), piece};
    if (t > 0.0) place.point[axis] = side_level(box_, piece);
    if (!covers(place, start, time, slack)) return std::nullopt;
    return SurfaceHit{t, place};
  };
  // From within slack, a way that stays within it does not get through.
  if (height + change >= (height <= slack ? -slack : 0.0)) return std::nullopt;
  if (height <= slack) {
    if (const auto now = at(0.0)) return now;
  }
  return height > 0.0 ? at(height / -change) : std::nullopt;
}

SurfacePlace ImplicitSurface::nearest_local(const SurfacePlace& from, const Vector3& goal,
                                            double time) const {
  if (is_side(from.piece)) {
    SurfacePlace place{goal, side_normal(from.piece), from.piece};
    place.point[axis_of(from.piece)] = side_level(box_, from.piece);
    return place;
  }
  const auto place = parts_->walk(from.piece, time).descend(from.point, goal);
  return {place.point, place.normal, from.piece, 0.0, 0.0, place.reached};
}

bool ImplicitSurface::covers(const SurfacePlace& place, const Vector3& /*above*/, double time,
                             double slack) const {
  if (!is_within(box_, place.point, slack)) return false;
  if (!is_side(place.piece)) {
    return parts_->pieces.covers(index_of(place.piece), place.point, place.normal, time, slack);
  }
  const Formula::Slope at = parts_->formula().slope(place.point, time);
  if (at.value <= 0.0) return true;
  return at.value <= slack * at.gradient.norm();
}

double ImplicitSurface::normal_speed(const SurfacePlace& place, double time) const {
  if (is_side(place.piece) || !changes()) return 0.0;
  const Formula::Slope at = parts_->pieces.formula(index_of(place.piece)).slope(place.point, time);
  const double speed = -at.rate / at.gradient.norm();
  return std::isfinite(speed) ? speed : 0.0;
}

}  // namespace icome::geometry
