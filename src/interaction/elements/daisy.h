#pragma once
#include <cstddef>
#include <vector>

#include "base/vector.h"

namespace icome::interaction {

using base::Vector2;

/// The sphere of a daisy menu (JDCAD, thesis 2.2.3), on which items lie as tiles. It is turned by a hand that
/// moves over the sheet on which the sphere is laid flat: a place of the sheet is as far from the front along
/// the sphere, in the same direction, as it is from the sheet's middle (azimuthal equidistant projection).
/// The tile at the place of the hand is turned to the front, and stands upright there.
struct DaisySphere {
  double radius = 0.0;  // m, > 0
  double cone = 0.0;    // rad, half the angle of the cone round the front in which a tile can be chosen

  /// The turn that takes the front (+z) to a place of the sheet by the shortest way.
  base::Quaternion turn_to(const Vector2& place) const;
  /// The angle between two places of the sheet as they lie on the sphere, rad.
  double angle_between(const Vector2& one, const Vector2& other) const;
  /// The tile of a place while `front` is before the eye: x right, y up, z out of the sphere, in the frame of
  /// the sheet, which touches the sphere at its front.
  base::Pose tile_at(const Vector2& place, const Vector2& front) const;
};

/// The farthest place of a tile from the front at rest, rad.
inline constexpr double kDaisyReach = 2.2;

/// Tiles on a sphere: the places of their middles on its sheet, that in front first.
struct DaisyLayout {
  double radius = 0.0;  // m
  std::vector<Vector2> places;
};

/// Lays `count` tiles of that size (m, > 0) on the smallest sphere found, of at least that radius (m), on
/// which none lies over another and all are within kDaisyReach of the front.
DaisyLayout daisy_layout(std::size_t count, const Vector2& tile, double least_radius);

}  // namespace icome::interaction
