#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/known_triangles.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// The pose of a triangle on the table: its centroid and the way from the middle of its base to its apex.
struct TrianglePose {
  base::Vector2 centroid = base::Vector2::Zero();  ///< mm, from the table's upper left corner, y down
  double angle = 0;  ///< rad, counter-clockwise as the camera sees it, 0 to the right, in (-pi, pi]
};

/// The corners of a triangle in that pose: the apex, then the two of the base, counter-clockwise as seen
/// (mm).
std::array<base::Vector2, 3> corners_of(const KnownTriangle& triangle, const TrianglePose& pose);

/// A known triangle found in a frame.
struct Sighting {
  std::size_t triangle = 0;  ///< index in the known list
  TrianglePose pose;
  double confidence = 0;  ///< 0 to 1: the share of its outline that edges in the frame support
};

/// Finds the known triangles in frames. One that keeps what it saw is given frames in the order of time.
class Tracker {
 public:
  virtual ~Tracker() = default;
  /// Every known triangle at most once, in the order of the list. `time` in s. A frame of another size than
  /// the view's is an error that says so.
  virtual base::Result<std::vector<Sighting>> see(const FrameView& frame, double time) = 0;
  /// Forgets what was seen before.
  virtual void forget() {}
};

/// The pipeline of thesis 3.4: crossings line by line, Hough over (rho, theta), triples of lines, isosceles
/// test, angles then height against the list. Keeps nothing from frame to frame.
std::unique_ptr<Tracker> make_thesis_tracker(KnownTriangles known, TableView view);

/// The default: oriented edges vote for lines, two partial edges and a known corner make a pose, which the
/// frame supports or contradicts; then followed over time. `tracks` off: each frame is searched from nothing.
std::unique_ptr<Tracker> make_pose_tracker(KnownTriangles known, TableView view, bool tracks = true);

}  // namespace icome::cutout
