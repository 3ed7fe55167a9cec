#pragma once
#include <utility>

#include "interaction/mouse_hand.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Drives the hand with the mouse, a pen or the keyboard: the hand follows what is under the mouse, and
/// presses while the button is down. While a technique is chosen, the hand is on the line from the eye to the
/// mouse, where that technique can use it, and the button is the hand's button 0, or 1 with Ctrl. The session
/// outlives it.
class TouchTool {
 public:
  explicit TouchTool(session::Session& session) : session_(session) {}

  /// Brings the hand into the scene, where the mouse was last or else in the middle; leave() removes it.
  void enter(const QSizeF& scene);
  void leave();
  bool active() const { return active_; }

  void follow(const SceneInput& input) { input_ = input; }
  /// Sets the pressure. 0: it does not press; 1: as hard as a pen can be pressed.
  void press(double pressure) {
    pressure_ = pressure;
    pressed_ = pressed_ || pressing();
  }
  bool pressing() const { return pressure_ > 0.0; }
  /// From now on the hand goes from there (stage frame, m) sideways, up and down with the mouse, and away and
  /// nearer by the wheel or Page Up and Page Down; surfaces stop it, and the button is its button 0. Without
  /// a place it follows the mouse as described above again. Objects under the mouse do not count: such a hand
  /// gets everywhere by a way that can be measured.
  void go_freely(const std::optional<base::Vector3>& from);
  bool goes_freely() const { return free_.has_value(); }
  /// Does it press, or has it since the last call, for however short a time?
  bool take_press() { return std::exchange(pressed_, pressing()); }
  /// Presses deeper (or less deep) while the button is down; moves a hand that goes freely away (or nearer).
  void turn_wheel(double notches) { wheel_ += notches; }
  /// Makes one step by the arrow keys; false: it is another key.
  bool step(int key, bool fine);
  /// Aims the hand at what is under the mouse now, as objects and the eye move, too.
  void tick();

  /// Pressure of a mouse button or a key, in [0, 1].
  static constexpr double kButton = 0.5;

 private:
  void tick_technique(const session::TechniqueHand& hand);
  void tick_freely();
  void tick_menu(const base::Vector3& met);
  std::optional<double> depth_under(const session::TechniqueHand& hand, const interaction::Ray& ray) const;

  session::Session& session_;
  interaction::MouseHand hand_ = interaction::MouseHand();
  bool active_ = false;
  SceneInput input_ = {};
  double pressure_ = 0.0;
  bool pressed_ = false;  // it presses, or has since take_press()
  struct Free {
    base::Vector3 from;                            // m, stage frame
    std::optional<base::Vector2> mouse_from = {};  // in the plane 1 m before the eye; none: at the next tick
    double away = 0.0;                             // m, by the wheel
  };
  std::optional<Free> free_ = {};
  double wheel_ = 0.0;
  double reach_ = 0.6;  // the hand's distance from the eye with a technique, in view distances
};

}  // namespace icome::ui
