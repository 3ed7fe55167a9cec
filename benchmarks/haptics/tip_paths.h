#pragma once
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::benchmarks {

using base::Vector3;

// Paths of the tip, one position (m, world) a tick at 1 kHz; equal arguments give equal paths. The tip never
// stops for the surface, as with a strong hand on a weak device.
constexpr double kTick = 0.001;  // s

/// The model of issue and findings: a sphere with bumps around the origin.
struct BumpySphere {
  double radius = 0.05;       // m
  double bump_height = 0.04;  // of the radius
  int bumps = 9;

  /// Distance of the surface from the origin in a direction (unit), m.
  double surface(const Vector3& direction) const;
};

inline constexpr BumpySphere kBumpySphere;
inline constexpr double kSlideDepth = 0.002;  // m
inline constexpr double kSlow = 0.1;          // m/s

/// A path that wanders over the sphere at `speed` (m/s), `depth` (m, radial) below the surface, once it has
/// come down from the air above.
std::vector<Vector3> slide_path(const BumpySphere& sphere, double speed, double depth, std::size_t ticks);

/// A path that wanders over any mesh at `speed` (m/s), `depth` (m) below the surface along the normal of the
/// face that it is on, once it has come down from the air above the highest vertex. It turns a little at each
/// step of 0.5 mm, and back where the surface ends.
std::vector<Vector3> mesh_walk_path(const geometry::TriangleMesh& mesh, double speed, double depth,
                                    std::size_t ticks);

/// A path of straight stabs at random places, up to 45 degrees oblique, at 0.1 to 2 m/s, until `depth` (m,
/// radial) below the surface and out again; between the stabs it goes through the air.
std::vector<Vector3> stab_path(const BumpySphere& sphere, double depth, int stabs);

/// A path of presses into a wall with the face z = `face` (m), free side +z, until `depth` (m) below it, at
/// 0.1 to 2 m/s, up to 30 degrees oblique, with a stay there, and out; within `half` (m) of the z axis.
struct Presses {
  std::vector<Vector3> tips;
  std::vector<std::size_t> starts;  // first tick of each press
};
Presses press_path(double face, double depth, double half, int presses);

/// A path that comes down on one place after another (random ones of `tops`, the highest points of objects)
/// and circles there at 0.1 m/s, 2 mm around it and `depth` (m) below; between them through the air.
struct Visits {
  std::vector<Vector3> tips;
  std::vector<std::size_t> places;  // by tick: index in tops
};
Visits visit_path(const std::vector<Vector3>& tops, double depth, std::size_t ticks);

}  // namespace icome::benchmarks
