#pragma once
#include <optional>

#include "interaction/navigation.h"

namespace icome::interaction {

/// What lies under the mouse; world frame.
struct PickedPoint {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, towards the eye's side
  double distance = 0.0;              // m, along the ray
};

/// Settings of a mouse or pen that acts as a pointer device. Lengths as shares of the view's width at the
/// depth of what is touched, so that it feels the same at every zoom.
struct MouseHandSettings {
  double hover = 0.01;    // share, above the surface while no button is down; usually 0.005 to 0.05
  double deepest = 0.03;  // share, below the surface at full pressure; usually 0.01 to 0.1
};

/// Turns a mouse or a pen into the hand of a pointer device: it hovers over what is under the mouse and
/// presses into it while the button is down, the deeper the harder a pen is pressed or the further the wheel
/// was turned. Over nothing it stays as far from the eye as it was last. One thread owns it; the same inputs
/// give the same targets.
class MouseHand {
 public:
  explicit MouseHand(const MouseHandSettings& settings = {}) : settings_(settings) {}

  struct Input {
    Ray ray;                            // through the mouse
    double view_width = 1.0;            // m, of the view at 1 m from the eye
    std::optional<PickedPoint> picked;  // nothing: the ray meets nothing
    double pressure = 0.0;              // [0, 1]; 0: the button is up. A mouse button is 0.5
    double wheel = 0.0;  // notches turned since the last input: presses deeper (away from the eye)
  };
  /// Where the hand wants to be, m.
  Vector3 target(const Input& input);

 private:
  MouseHandSettings settings_;
  double depth_ = 0.5;  // m from the eye, of what was touched last
  double extra_ = 0.0;  // notches
};

/// Moves something that was grasped at a point so that the point follows the mouse: in the plane through it
/// that faces the eye, or along a line.
class DragPlane {
 public:
  DragPlane(const Vector3& grasped, const Vector3& normal) : start_(grasped), normal_(normal) {}
  /// Keeps the movement on the line through the grasped point along this direction; nothing: in the plane.
  void keep_to(const std::optional<Vector3>& direction) { along_ = direction; }
  /// How far it has moved, m; nothing where the ray does not meet the plane before the eye.
  std::optional<Vector3> moved(const Ray& ray) const;

 private:
  Vector3 start_, normal_;
  std::optional<Vector3> along_;
};

}  // namespace icome::interaction
