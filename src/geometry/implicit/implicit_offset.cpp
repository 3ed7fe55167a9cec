#include "geometry/implicit/implicit_offset.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/implicit/implicit_walk.h"
#include "geometry/straight_way_out.h"

namespace icome::geometry {
namespace {

// A piece is the number of a part, and the conditions that are active there.
constexpr unsigned kPartBits = 32 - kActiveBits;
constexpr std::uint32_t kPartMask = (std::uint32_t{1} << kPartBits) - 1;

constexpr double kMostRoundTurn = 0.3;  // rad, of one walk round an edge or a corner
constexpr double kSurfaceDepth = 1e-9;  // of the size: a ball that overlaps by less is at the surface
constexpr double kTouchShare = 0.1;     // of the slack: a ball so near has arrived
constexpr double kOffFoot = 1e-6;       // of a distance: a place so little beside its foot is at it
constexpr int kMostAdvances = 64;
constexpr int kMostPartPushes = 16;  // from one part to the next

std::uint32_t part_of(std::uint32_t piece) { return piece & kPartMask; }
ActiveSet active_of(std::uint32_t piece) { return piece >> kPartBits; }
std::uint32_t piece_of_part(std::uint32_t part, ActiveSet active) { return part | active << kPartBits; }

/// One unit vector turned towards another, no farther than one walk may turn.
Vector3 turned_towards(const Vector3& from, const Vector3& to) {
  const double cosine = from.dot(to);
  if (cosine >= std::cos(kMostRoundTurn)) return to;
  const Vector3 across = (to - cosine * from).stableNormalized();
  if (!across.allFinite() || across.isZero(0.0)) return from;
  return std::cos(kMostRoundTurn) * from + std::sin(kMostRoundTurn) * across;
}

/// The first t > 0 at which a + b t - c t^2 is no longer positive.
double first_fall(double a, double b, double c) {
  const double square = b * b + 4.0 * a * c;
  if (b < 0.0)
    return square < 0.0 ? std::numeric_limits<double>::infinity() : 2.0 * a / (std::sqrt(square) - b);
  return c <= 0.0 ? std::numeric_limits<double>::infinity()
                  : (b + std::sqrt(std::max(0.0, square))) / (2.0 * c);
}

/// The share of `step` over which a ball's centre surely stays clear of a part, from a centre for which the
/// nearest place of the part is known.
double clear_share(const ImplicitPart::Nearest& nearest, const Vector3& centre, const Vector3& step,
                   double radius) {
  constexpr double kSteepBowl = 0.05;  // of a sphere around the centre
  const double distance = nearest.distance, length = step.norm();
  const Vector3 out = (centre - nearest.place) / distance;
  const double gap = distance - radius, along = out.dot(step);
  const base::Matrix3& bowl = nearest.bowl;
  const double corner = bowl(0, 0) * bowl(1, 1) - bowl(0, 1) * bowl(1, 0);
  if (bowl(0, 0) > kSteepBowl && corner > kSteepBowl * bowl(0, 0) &&
      bowl.determinant() > kSteepBowl * corner) {
    // With w from the nearest place to another one, distance^2 + w'bowl w - 2 w.s + 2 distance out.s + s^2
    // bounds its square from the centre moved by s; it is least for w = bowl^-1 s.
    const double bent = step.dot(bowl.inverse() * step) - step.squaredNorm();
    return first_fall(std::max(0.0, gap * (distance + radius)), 2.0 * distance * along, bent);
  }
  // All of the part lies below a plane a little above the place.
  const double above = 0.5 * std::max(0.0, nearest.spread) / distance * nearest.width * nearest.width;
  if (gap <= above) return gap / length;
  return along < 0.0 ? (gap - above) / -along : std::numeric_limits<double>::infinity();
}

}  // namespace

base::Result<std::shared_ptr<const ImplicitOffset>> ImplicitOffset::create(const std::string& formula,
                                                                           const Bounds& box, double radius) {
  auto walls = ImplicitSurface::create(formula, box);
  if (!walls) return base::fail(walls.error().message);
  auto parts = ImplicitParts::create(formula, box, radius);
  if (!parts) return base::fail(parts.error().message);
  return std::shared_ptr<const ImplicitOffset>(new ImplicitOffset(*walls, std::move(*parts), radius));
}

ImplicitOffset::ImplicitOffset(std::shared_ptr<const ImplicitSurface> walls, ImplicitParts parts,
                               double radius)
    : walls_(std::move(walls)), parts_(std::move(parts)), radius_(radius) {
  static_assert(kPartBits >= 16);
}

Bounds ImplicitOffset::bounds() const {
  const Bounds& box = parts_.bounds();
  if (box.isEmpty()) return box;
  return {box.min() - Vector3::Constant(radius_), box.max() + Vector3::Constant(radius_)};
}

ImplicitPart ImplicitOffset::part(std::uint32_t piece, double time) const {
  return {parts_, part_of(piece), time};
}

double ImplicitOffset::in_touch() const { return kSurfaceDepth * parts_.box().diagonal().norm(); }

void ImplicitOffset::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                          PieceVisitor visit) const {
  parts_.rests().near(SegmentQuery(a, b, reach), [&](std::uint32_t i) {
    const FloatBox& box = parts_.centres(i);
    return visit(piece_of_part(i, 0),
                 Bounds(Vector3(box.lo[0], box.lo[1], box.lo[2]), Vector3(box.hi[0], box.hi[1], box.hi[2])));
  });
}

SurfacePlace ImplicitOffset::rest_on(std::uint32_t piece, const Vector3& place, const Vector3& normal) const {
  return {place + radius_ * normal, normal, piece};
}

std::optional<SurfaceHit> ImplicitOffset::first_hit(std::uint32_t piece, const Vector3& start,
                                                    const Vector3& step, bool from_behind, double time,
                                                    double slack) const {
  const double length = step.norm();
  if (from_behind || !(length > 0.0)) return std::nullopt;
  const ImplicitPart part = this->part(piece, time);
  if (part.keeps_off(start, start + step, radius_ + slack)) return std::nullopt;
  double t = 0.0;
  for (int i = 0; i < kMostAdvances && t <= 1.0; ++i) {
    const Vector3 centre = start + t * step;
    const auto nearest = part.nearest(centre, radius_, radius_ + (1.0 - t) * length + slack);
    if (!nearest) return std::nullopt;
    const std::uint32_t met = piece_of_part(part_of(piece), nearest->active);
    if (nearest->distance <= 0.0) return SurfaceHit{t, rest_on(met, centre, -step / length)};
    const Vector3 out = (centre - nearest->place) / nearest->distance;
    const bool arrived = nearest->distance - radius_ <= kTouchShare * slack;
    if (arrived && (t > 0.0 || out.dot(step) < 0.0)) return SurfaceHit{t, rest_on(met, nearest->place, out)};
    const double least = kTouchShare * slack / length;  // on the way out
    t += std::max(clear_share(*nearest, centre, step, radius_), least);
  }
  if (t > 1.0) return std::nullopt;
  // Out of work, close along the part: stopping there is safe.
  const Vector3 centre = start + t * step;
  const auto nearest = part.nearest(centre, radius_, 2.0 * radius_ + length);
  if (!nearest || nearest->distance <= 0.0) return std::nullopt;
  return SurfaceHit{t, rest_on(piece_of_part(part_of(piece), nearest->active), nearest->place,
                               (centre - nearest->place) / nearest->distance)};
}

/// The part in which the same conditions are active at a place that a walk has come to; `piece` itself where
/// there is none.
std::uint32_t ImplicitOffset::moved_to(std::uint32_t piece, const Vector3& place) const {
  const std::uint32_t old = part_of(piece);
  if (parts_.part(old).cell.contains(place)) return piece;
  const auto before = parts_.conditions(old);
  std::uint32_t found = piece;
  parts_.cells().near(SegmentQuery(place, place, 0.0), [&](std::uint32_t i) {
    if (parts_.part(i).way != parts_.part(old).way || !parts_.part(i).cell.contains(place)) return true;
    const auto now = parts_.conditions(i);
    ActiveSet active = active_of(piece) & ~((ActiveSet{1} << ImplicitParts::kMostConditions) - 1);  // sides
    for (unsigned k = 0; k < before.size(); ++k) {
      if ((active_of(piece) >> k & 1U) == 0) continue;
      const auto same = std::find_if(now.begin(), now.end(), [&](const ImplicitParts::Condition& it) {
        return it.formula == before[k].formula;
      });
      if (same == now.end()) return true;
      active |= 1U << (same - now.begin());
    }
    found = piece_of_part(i, active);
    return false;
  });
  return found;
}

/// Slides along a face: the place below the centre is the same as for a point tip.
SurfacePlace ImplicitOffset::face_projection(const SurfacePlace& from, const Vector3& place,
                                             const Vector3& goal, double time) const {
  const auto condition = unsigned(std::countr_zero(active_of(from.piece)));
  if (condition >= ImplicitParts::kMostConditions) {
    const ImplicitPart::Slope at = part(from.piece, time).slope(condition, goal);
    return rest_on(from.piece, goal - at.value * at.gradient, at.gradient);
  }
  const ImplicitParts::Condition& face = parts_.conditions(part_of(from.piece))[condition];
  const auto end = ImplicitWalk(*face.formula, time, parts_.box().diagonal().norm()).descend(place, goal);
  const Vector3 normal = face.sign * end.normal;
  SurfacePlace foot = rest_on(moved_to(from.piece, end.point), end.point, normal);
  const Vector3 pull = goal - end.point;
  foot.reached = (pull - pull.dot(normal) * normal).norm() <= kOffFoot * pull.norm() + in_touch();
  return foot;
}

/// Goes round an edge or a corner no farther than to the face, or the edge, that continues it.
SurfacePlace ImplicitOffset::nearest_local(const SurfacePlace& from, const Vector3& goal, double time) const {
  const Vector3 before = from.point - radius_ * from.normal;
  const ActiveSet active = active_of(from.piece);
  if (std::has_single_bit(active)) return face_projection(from, before, goal, time);
  const ImplicitPart part = this->part(from.piece, time);
  const double reach = parts_.part(part_of(from.piece)).cell.diagonal().norm();
  const Vector3 place = active == 0 ? before : part.along(active, before, goal, reach);
  Vector3 wanted = (goal - place).stableNormalized();
  if (wanted.isZero(0.0)) return rest_on(from.piece, place, from.normal);
  const ActiveSet holding = part.holding(active, place, wanted);
  if (holding != 0 && holding != active) {
    const SurfacePlace onwards =
        nearest_local(rest_on(piece_of_part(part_of(from.piece), holding), place, from.normal), goal, time);
    if (onwards.normal.dot(from.normal) >= std::cos(kMostRoundTurn)) return onwards;
    wanted = onwards.normal;
  }
  const Vector3 normal = turned_towards(from.normal, wanted);
  SurfacePlace foot = rest_on(moved_to(from.piece, place), place, normal);
  foot.reached = normal == wanted && (place - before).norm() < reach;
  return foot;
}

bool ImplicitOffset::covers(const SurfacePlace& place, const Vector3& /*above*/, double time,
                            double slack) const {
  const Vector3 below = place.point - radius_ * place.normal;
  const Bounds& box = parts_.box();
  const double outside = (box.min() - below).cwiseMax(below - box.max()).maxCoeff();
  if (outside > slack) return false;
  const ImplicitSurface::Value at = walls_->value(below, time);
  return at.value <= slack * at.gradient.norm();
}

bool ImplicitOffset::same(std::uint32_t one, std::uint32_t other) const {
  const std::uint32_t i = part_of(one), j = part_of(other);
  if (i == j) return true;
  const ImplicitParts::Part &a = parts_.part(i), &b = parts_.part(j);
  return a.gentle && b.gentle && a.way == b.way && a.cell.intersects(b.cell);
}

/// The speed at which the active conditions push along the normal, each by its share.
double ImplicitOffset::normal_speed(const SurfacePlace& place, double time) const {
  if (!changes()) return 0.0;
  const Vector3 below = place.point - radius_ * place.normal;
  const ImplicitPart part = this->part(place.piece, time);
  double speed = 0.0;
  Vector3 left = place.normal;
  for (ActiveSet set = active_of(place.piece); set != 0; set &= set - 1) {
    const ImplicitPart::Slope at = part.slope(unsigned(std::countr_zero(set)), below);
    const double share = left.dot(at.gradient) / at.gradient.squaredNorm();
    if (!std::isfinite(share)) continue;
    left -= share * at.gradient;
    speed -= share * at.rate;
  }
  return speed;
}

/// Calls `visit(place)` for each place of the centre in which a ball around the point would clear one of the
/// parts that it reaches into; until it returns false.
template <typename Visit>
void ImplicitOffset::overlapped(const Vector3& point, double time, Visit&& visit) const {
  parts_.cells().near(SegmentQuery(point, point, radius_), [&](std::uint32_t i) {
    const auto nearest = part(i, time).nearest(point, radius_, radius_ - in_touch());
    if (!nearest || nearest->distance <= 0.0 || nearest->distance >= radius_ - in_touch()) return true;
    return visit(rest_on(piece_of_part(i, nearest->active), nearest->place,
                         (point - nearest->place) / nearest->distance));
  });
}

bool ImplicitOffset::inside(const Vector3& point, double time) const {
  if (walls_->inside(point, time)) return true;
  bool found = false;
  overlapped(point, time, [&](const SurfacePlace&) {
    found = true;
    return false;
  });
  return found;
}

// Moves out of the solid itself, then from part to part where a ball overlaps; else along straight lines.
std::optional<SurfacePlace> ImplicitOffset::way_out(const Vector3& point, double time) const {
  const double clear = 2.0 * in_touch();
  Vector3 at = point, out = Vector3::Zero();
  if (const auto place = walls_->way_out(point, time)) {
    out = place->normal;
    at = place->point + (radius_ + clear) * out;
  }
  for (int i = 0; i < kMostPartPushes && !walls_->inside(at, time); ++i) {
    std::optional<SurfacePlace> farthest;
    overlapped(at, time, [&](const SurfacePlace& place) {
      if (!farthest || (place.point - at).norm() > (farthest->point - at).norm()) farthest = place;
      return true;
    });
    if (!farthest) return at == point ? std::nullopt : std::optional(SurfacePlace{at, out});
    out = farthest->normal;
    at = farthest->point + clear * out;
  }
  return straight_way_out(point, bounds(), radius_, 20.0 * in_touch(),
                          [&](const Vector3& centre) { return inside(centre, time); });
}

std::size_t ImplicitOffset::bytes() const {
  return sizeof(*this) - sizeof(ImplicitParts) + walls_->bytes() + parts_.bytes();
}

}  // namespace icome::geometry
