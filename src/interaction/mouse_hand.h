#pragma once
#include <optional>

#include "interaction/navigation.h"

namespace icome::interaction {

/// The point of a surface that lies under the mouse; world frame.
struct PickedPoint {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, towards the eye's side
  double distance = 0.0;              // m, along the ray
};

/// Settings of a mouse or pen that acts as a pointer device. Lengths are shares of the view's width at
/// the depth of the touched surface, so that it feels the same at every zoom.
struct MouseHandSettings {
  double hover = 0.01;    // share, above the surface while no button is down; usually 0.005 to 0.05
  double deepest = 0.03;  // share, below the surface at full pressure; usually 0.01 to 0.1
};

/// Turns a mouse or a pen into the hand of a pointer device: it hovers over the surface under the mouse and
/// presses into it while the button is down, deeper the harder a pen is pressed or the further the wheel
/// was turned. It presses straight down, so that the surface contact point stays under the mouse, and only
/// where the hand has arrived: on its way to somewhere else it is lifted, and so gets over obstacles in
/// between. While the mouse rests, a press that slides away is only ever eased, until it stays. Over
/// nothing it keeps its last distance from the eye. One thread owns it; the same inputs give the same
/// targets.
class MouseHand {
 public:
  explicit MouseHand(const MouseHandSettings& settings = {}) : settings_(settings) {}

  struct Input {
    Ray ray = {};                            // through the mouse
    double view_width = 1.0;                 // m, of the view at 1 m from the eye
    double distance = 0.5;                   // m, to what the view looks at (View::distance)
    std::optional<PickedPoint> picked = {};  // nothing: the ray meets nothing
    double pressure = 0.0;                   // [0, 1]; 0: the button is up. A mouse button is 0.5
    double wheel = 0.0;  // notches turned since the last input: presses deeper (away from the eye)
    std::optional<Vector3> hand = {};  // m, where its surface contact point is; nothing: where it should be
  };
  /// The point that the hand aims at, m; the last one, where the input is not finite.
  Vector3 target(const Input& input);

 private:
  Vector3 over_nothing(const Input& input, double wheel);
  Vector3 over(const PickedPoint& picked, const Input& input, double wheel);
  double arrived(const PickedPoint& picked, const Input& input, double width) const;
  double share_of_press(const PickedPoint& picked, double arrived, double deepest, bool turned);

  MouseHandSettings settings_;
  double depth_ = 1.0;     // of the view's `distance`, from the eye to what was touched last
  double extra_ = 0.0;     // notches, until the button goes up
  bool pressing_ = false;  // at the last input
  double share_ = 0.0;  // of the press, while the mouse rests where the hand has arrived; 0: it has not yet
  Vector3 rests_at_ = Vector3::Zero();  // m, what was picked then
  Vector3 last_ = Vector3::Zero();
};

/// Moves something that was grasped at a point so that the point follows the mouse: in the plane through it
/// with that normal (of any length > 0, such as towards the eye), or along a line.
class DragPlane {
 public:
  DragPlane(const Vector3& grasped, const Vector3& normal) : start_(grasped), normal_(normal) {}
  /// Keeps the movement on the line through the grasped point along this direction; nothing: in the plane.
  void keep_to(const std::optional<Vector3>& direction) { along_ = direction; }
  /// Displacement since the grasp, m; nothing where the ray does not meet the plane in front of the eye, or
  /// only beyond a thousand times the grasped point's distance; likewise for the place nearest to a line.
  std::optional<Vector3> moved(const Ray& ray) const;

 private:
  std::optional<Vector3> moved_in_plane(const Ray& ray, double reach) const;
  std::optional<Vector3> moved_along(const Vector3& line, const Ray& ray, double reach) const;

  Vector3 start_, normal_;
  std::optional<Vector3> along_;
};

/// Turns something that was grasped about an axis so that the place where it was grasped goes round with the
/// mouse.
class DragTurn {
 public:
  /// About the unit axis through the centre (m), from where the ray met the plane across it.
  DragTurn(const Vector3& centre, const Vector3& axis, const Ray& grasped)
      : centre_(centre), axis_(axis), from_(way_to(grasped)) {}
  /// Angle turned since the grasp, right-handed, rad in (-pi, pi]; nothing where a ray does not meet
  /// that plane before the eye, or meets it in the centre.
  std::optional<double> turned(const Ray& ray) const;

 private:
  std::optional<Vector3> way_to(const Ray& ray) const;

  Vector3 centre_, axis_;
  std::optional<Vector3> from_;  // unit, from the centre
};

}  // namespace icome::interaction
