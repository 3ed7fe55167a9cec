#include "world/shape/exact_surface.h"

#include <algorithm>
#include <variant>

#include "geometry/csg/csg_solid.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/segment.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"

namespace icome::world {
namespace {

using geometry::SmoothSurface;
using geometry::SurfaceHit;

bool is_round(const geometry::Primitive& it) {
  return !std::holds_alternative<geometry::Plane>(it) && !std::holds_alternative<geometry::Box>(it);
}

/// Can it be hit from its front only? Subdivision surfaces may be sheets, or inside out.
bool has_front_only(const SmoothSurface& surface) {
  return dynamic_cast<const geometry::LoopSurface*>(&surface) == nullptr;
}

}  // namespace

bool has_exact_surface(const Geometry& shape) {
  return visit_geometry(
      shape, [](const PrimitiveGeometry& it) { return is_round(it.primitive); },
      [](const CsgGeometry&) { return true; }, [](const LoopGeometry&) { return true; },
      [](const ImplicitGeometry&) { return true; }, [](const Geometry&) { return false; });
}

std::shared_ptr<const SmoothSurface> exact_surface(const Geometry& shape) {
  if (!has_exact_surface(shape)) return nullptr;
  using Surface = std::shared_ptr<const SmoothSurface>;
  return visit_geometry(
      shape,
      [](const PrimitiveGeometry& it) -> Surface {
        geometry::CsgTree tree;
        tree.add_leaf(it.primitive, Affine3(it.shape_from_primitive()));
        return std::make_shared<const geometry::CsgSolid>(tree);
      },
      [](const CsgGeometry& it) -> Surface {
        return it.tree.empty() ? nullptr : std::make_shared<const geometry::CsgSolid>(it.tree);
      },
      [](const LoopGeometry& it) -> Surface {
        return geometry::LoopSurface::create(it.control).value_or(nullptr);
      },
      [](const ImplicitGeometry& it) -> Surface { return it.surface(); },
      [](const Geometry&) -> Surface { return nullptr; });
}

/// Each piece is queried with the part of the way in its box alone, which begins well before the piece: so
/// the side on which it begins is in no doubt, and near hits are found with the most digits.
std::optional<SurfaceHit> way_into(const SmoothSurface& surface, const Vector3& a, const Vector3& b) {
  constexpr double kSlackOfExtent = 1e-12;
  constexpr double kClear = 8.0;  // slacks
  const Vector3 step = b - a;
  const Bounds box = surface.bounds();
  const double slack =
      kSlackOfExtent * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  std::optional<SurfaceHit> first;
  const auto look = [&](std::uint32_t piece, double begin, double end, bool from_behind) {
    const auto hit =
        surface.first_hit(piece, a + begin * step, (end - begin) * step, from_behind, 0.0, slack);
    if (!hit) return;
    const double share = begin + hit->t * (end - begin);
    if (first && share >= first->t) return;
    first = SurfaceHit{share, hit->place};
    if (from_behind) first->place.normal = -first->place.normal;
  };
  surface.near(a, b, kClear * slack, 0.0, [&](std::uint32_t piece, const Bounds& part) {
    const auto within = geometry::part_within(part, a, step, kClear * slack);
    if (!within || (first && (*within)[0] > first->t)) return true;
    look(piece, (*within)[0], (*within)[1], false);
    if (!has_front_only(surface)) look(piece, (*within)[0], (*within)[1], true);
    return true;
  });
  return first;
}

}  // namespace icome::world
