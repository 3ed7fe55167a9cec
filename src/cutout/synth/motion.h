#pragma once
#include <array>
#include <vector>

#include "base/random.h"
#include "cutout/synth/synthetic_table.h"

namespace icome::cutout {

/// Corners of a triangle, counter-clockwise as seen from the apex on, mm.
std::array<base::Vector2, 3> synthetic_corners(const KnownTriangle& triangle, const TrianglePose& pose);

/// Distance of two convex outlines along the best of their edges' normals: below zero, they overlap; above,
/// they are at least so far apart. `way`, if not null, is set to the unit vector from the first to the
/// second.
double apart(const std::array<base::Vector2, 3>& one, const std::array<base::Vector2, 3>& other,
             base::Vector2* way = nullptr);

/// A hand: the place between the tips of thumb and forefinger, and the way that its arm points.
struct SyntheticHand {
  base::Vector2 grip = base::Vector2::Zero();  ///< mm
  double angle = 0;                            ///< rad, counter-clockwise as seen
  bool left = false;
  int look = 0;  ///< which photo or skin
};

/// All that moves, in one frame.
struct SyntheticScene {
  std::vector<TrianglePose> poses;
  std::vector<SyntheticHand> hands;
};

/// New places for all, apart from one another; those that find none lie beyond the table.
std::vector<TrianglePose> scattered(const SyntheticOptions& options, base::Random& random);
/// Did all find a place?
bool all_on_table(const SyntheticOptions& options, const std::vector<TrianglePose>& poses);

/// Scenes of every frame: triangles slide about, pass close to one another, exchange places and rest. With
/// hands, only what a hand holds moves, and what it pushes aside.
std::vector<SyntheticScene> moving_scenes(const SyntheticOptions& options);
/// A scene with new places.
SyntheticScene still_scene(const SyntheticOptions& options, int number);

}  // namespace icome::cutout
