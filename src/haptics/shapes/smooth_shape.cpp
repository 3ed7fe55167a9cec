#include "haptics/shapes/smooth_shape.h"

#include <algorithm>
#include <vector>

#include "geometry/segment.h"

namespace icome::haptics {
namespace {

/// A part of a straight way in which it may go through a piece.
struct WayThrough {
  double first, last;  // in [0, 1] of the way
  std::uint32_t piece;
};

/// The parts in their order along the way. Cut to the pieces' boxes, so that a surface need not look far:
/// near hits are found with the least work and the most digits.
std::vector<WayThrough> ways_through(const geometry::SmoothSurface& surface, const Vector3& start,
                                     const Vector3& step, double time, double margin) {
  std::vector<WayThrough> ways;
  surface.near(start, start + step, margin, time, [&](std::uint32_t piece, const Bounds& box) {
    if (const auto part = geometry::part_within(box, start, step, margin))
      ways.push_back({(*part)[0], (*part)[1], piece});
    return true;
  });
  std::sort(ways.begin(), ways.end(),
            [](const WayThrough& a, const WayThrough& b) { return a.first < b.first; });
  return ways;
}

/// The largest coordinate of the surface's bounds if they are finite, else of the way.
double extent_of(const Bounds& bounds, const Vector3& start, const Vector3& step) {
  if (bounds.min().allFinite() && bounds.max().allFinite())
    return std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
  return std::max(start.cwiseAbs().maxCoeff(), (start + step).cwiseAbs().maxCoeff());
}

}  // namespace

Bounds SmoothShape::bounds() const {
  const Bounds box = surface_->bounds();
  if (box.isEmpty()) return box;
  return {box.min() + Vector3::Constant(tip_), box.max() - Vector3::Constant(tip_)};
}

void SmoothShape::gather(const GatherRequest& request, ElementSink& sink) const {
  surface_->near(request.a, request.b, request.reach, request.time,
                 [&](std::uint32_t piece, const Bounds& box) { return sink.defer(piece, box); });
}

void SmoothShape::expand(std::uint32_t piece, double /*tip*/, TouchableSides sides,
                         PieceElements& elements) const {
  Element element;
  element.kind = Element::Kind::Smooth;
  element.surface = surface_.get();
  element.two_sided = sides == TouchableSides::Both;
  element.feature = piece;
  // The element's frame, which the scene turns with the object.
  element.u = Vector3::UnitX();
  element.v = Vector3::UnitY();
  element.axis = Vector3::UnitZ();
  elements.add(element);
}

std::optional<geometry::SurfacePoint> SmoothShape::way_out(const Vector3& position, double time) const {
  const auto place = surface_->way_out(position, time);
  if (!place) return std::nullopt;
  return geometry::SurfacePoint{place->point - tip_ * place->normal, place->normal};
}

std::optional<ShapeHit> SmoothShape::cast(const Vector3& start, const Vector3& step, double time) const {
  const double slack = Tolerance::for_size(extent_of(surface_->bounds(), start, step)).rim();
  // Each part begins well before its piece, so that the side on which it begins is in no doubt.
  constexpr double kClear = 8.0;
  std::optional<ShapeHit> best;
  for (const WayThrough& way : ways_through(*surface_, start, step, time, kClear * slack)) {
    if (best && way.first > best->t) break;
    const Vector3 from = start + way.first * step;
    const Vector3 part = (way.last - way.first) * step;
    for (const bool from_behind : {false, true}) {
      const auto hit = surface_->first_hit(way.piece, from, part, from_behind, time, slack);
      if (!hit) continue;
      const double t = way.first + hit->t * (way.last - way.first);
      if (!best || t < best->t) best = ShapeHit{t, hit->place.point, hit->place.normal};
    }
  }
  return best;
}

}  // namespace icome::haptics
