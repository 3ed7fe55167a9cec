#pragma once
#include <memory>
#include <optional>

#include "geometry/smooth_surface.h"
#include "world/shape/geometry.h"

namespace icome::world {

/// Is the shape more than triangles or flat sides: a solid under union, intersection and difference, a
/// subdivision surface, a formula, something round?
bool has_exact_surface(const Geometry& shape);

/// The exact surface of such a shape (a formula at time 0), own frame; null where there is none.
std::shared_ptr<const geometry::SmoothSurface> exact_surface(const Geometry& shape);

/// The first hit at which the way from `a` to `b` (m, the surface's frame) leads in through the surface,
/// or through a sheet, whose normal is then turned against the way.
std::optional<geometry::SurfaceHit> way_into(const geometry::SmoothSurface& surface,
                                             const geometry::Vector3& a, const geometry::Vector3& b);

}  // namespace icome::world
