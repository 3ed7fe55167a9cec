#pragma once
#include "base/vector.h"
#include "devices/navigation_device.h"

namespace icome::interaction {

using base::Bounds;
using base::Pose;
using base::Vector3;

/// The viewpoint. The eye looks along its -z, y up; world frame, y up.
struct View {
  Pose world_from_eye = Pose(Eigen::Translation3d(0.0, 0.0, 1.0));
  double field = 0.6;     // rad, of the shorter side of the picture; 0.05 to 2.5
  double distance = 1.0;  // m, from the eye to the point looked at, about which orbiting turns; > 0
  /// Tangents of the angles from straight ahead to the picture's middle, to the right and up: 0 but for an
  /// eye that is not before the middle of its screen (seen_from()).
  base::Vector2 shift = base::Vector2::Zero();
};

/// Do both show the same picture?
bool is_same_view(const View& one, const View& other);

/// The thing that the navigation device moves (thesis 2.4.2).
enum class NavigationMode : std::uint8_t { Camera, Hand };

/// A straight line that starts somewhere; world frame.
struct Ray {
  Vector3 origin = Vector3::Zero();
  Vector3 direction = -Vector3::UnitZ();  // unit
};

/// Half the picture's width and height at 1 m from the eye, m; aspect is width over height. Its middle is at
/// View::shift.
Eigen::Vector2d half_picture(const View& view, double aspect);

/// The ray through a place in the picture: x and y in [-1, 1] from left to right and from bottom to top.
Ray ray_through(const View& view, double x, double y, double aspect);

/// The point at `distance` ahead of the eye in the picture's middle.
Vector3 looked_at(const View& view);

/// The view with impossible values (not a number, out of range, not rigid) put right.
View usable(const View& view);

// Movements of a view. Each is a pure function; all keep the horizon level unless the view was tilted
// already, and never turn over the poles. The view they give is usable, whatever they are given: an
// impossible movement is left out.

/// The eye goes round the point at `distance`: rad to the right and up.
View orbited(const View& view, double right, double up);
/// The view turned where it is: rad to the right and up.
View looked_around(const View& view, double right, double up);
/// Moved sideways, so that things at `distance` follow the mouse: shares of the picture's shorter side.
View panned(const View& view, double right, double up);
/// Nearer (factor < 1) or farther; `towards` stays in its place in the picture.
View zoomed(const View& view, double factor, const Vector3& towards);
/// Moved as the navigation device says, for dt seconds: pushed by up to one `distance` a second, turned by
/// up to a quarter turn a second. Turns that tilt the horizon are left out.
View flown(const View& view, const devices::NavigationState& state, double dt);
/// Looks at the centre of the bounds from the direction (to the eye), as near as possible with all of them in
/// the picture and a little room around. Bounds that are empty or without end are taken as a ball of 0.1 m
/// around the origin; a point is looked at from the view's distance.
View fitted(const View& view, const Bounds& bounds, const Vector3& toward_eye, const Vector3& up,
            double aspect);

/// A view on its way to another: starts and ends softly and turns the short way. The point looked at stays
/// in the middle of the picture; to get far it steps back first, so that one sees the way (van Wijk and
/// Nuij, Smooth and Efficient Zooming and Panning, 2003).
class ViewFlight {
 public:
  /// Over at once when `seconds` is no positive number.
  ViewFlight(const View& from, const View& to, double seconds);
  /// The view after that time (s); `to` from the end on.
  View at(double time) const;
  bool over(double time) const { return !(time < seconds_); }

 private:
  /// Progress of the point looked at, in [0, 1], and the eye's distance from it, m.
  struct Stage {
    double along, distance;
  };
  Stage stage(double progress) const;

  View from_, to_;
  double seconds_;
};

}  // namespace icome::interaction
