#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"
#include "geometry/sweep/profile.h"
#include "geometry/sweep/sweep.h"

namespace icome::geometry {

/// The treatment of the first and the last section.
enum class ExtrusionEnds {
  Capped,  ///< each is filled with triangles, so that an outline gives a closed surface
  Open,    ///< each stays a rim
  Joined,  ///< the last goes on into the first, as in a ring: needs no step back to the start, but may end
           ///< there
};

/// The most triangles that extrude() makes.
inline constexpr std::size_t kMaximumExtrusionTriangles = 20'000'000;
/// The largest coordinate that a section may reach, m.
inline constexpr double kLargestExtrusion = 1e9;

/// Extrude 2D: sweeps the profile, which starts in the plane z = 0, through the placements that the steps
/// lead to, and joins neighbouring sections with triangles. The fronts face out, whichever way the profile
/// runs and the sweep goes. Corners that stay in place (on the axis of a turn) or come together (a section
/// scaled to a point, or to a line on which corners meet in pairs) become one vertex; no triangle is without
/// area. A surface made of an outline is closed unless the ends are open; each edge then has two triangles.
/// An open profile gives a sheet, which has no caps: it is closed only when both its ends lie on the axis of
/// a ring.
///
/// Fails with a sentence that names the step, and within it the repeat, where a section meets the one before
/// inside the profile, the triangles between the two meet after too far a twist, or the sweep turns back into
/// what it has just made, where a flattened profile moves on, or where numbers or triangles become too many.
/// Parts of the sweep that are no neighbours are not compared: a spiral may run through itself. A profile of
/// thousands of long corners side by side may be refused when it is twisted, as the search for triangles that
/// meet would take too long. In a ring whose profile only touches the axis with a corner, all of that
/// corner's triangles share one vertex. A given input gives the same mesh every time.
base::Result<TriangleMesh> extrude(const Profile& profile, std::span<const SweepStep> steps,
                                   ExtrusionEnds ends = ExtrusionEnds::Capped);

/// A swept surface with texture coordinates.
struct TexturedExtrusion {
  TriangleMesh mesh;
  std::vector<std::array<Vector2, 3>> places;  ///< of every triangle's corners
};

/// As extrude(), with the picture that lies on the profile carried along: on both ends it lies as on the
/// profile, and over each side it goes on from the edge there as if the side were folded out into the plane
/// of the profile, as long as the way that the corners went. Precondition: the profile is an outline and has
/// places.
base::Result<TexturedExtrusion> extrude_textured(const Profile& profile, std::span<const SweepStep> steps,
                                                 ExtrusionEnds ends = ExtrusionEnds::Capped);

}  // namespace icome::geometry
