#pragma once
#include <span>

#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// The point of `box` that is nearest to all the planes given by points and unit normals, in the sense of
/// least squares (the quadric error function of Ju et al., 2002). Along directions that the planes hardly
/// determine, compared with the best determined one, the result keeps the position of the points' mean: it
/// stays on the edge or the face. Precondition: at least one plane, points finite.
Vector3 nearest_to_planes(std::span<const SurfacePoint> planes, const Bounds& box);

/// The largest distance from the point to one of the planes, m.
double farthest_plane(std::span<const SurfacePoint> planes, const Vector3& point);

}  // namespace icome::geometry
