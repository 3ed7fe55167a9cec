#pragma once
#include <utility>

#include "interaction/mouse_hand.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Drives the hand with the mouse, a pen or the keyboard: it follows what is under the mouse, and presses
/// while the button is down. While a technique is chosen, the hand is on the line from the eye to the mouse,
/// where that technique can use it, and the button is the hand's button 0, or 1 with Ctrl. The session
/// outlives it.
class TouchTool {
 public:
  explicit TouchTool(session::Session& session) : session_(session) {}

  /// The hand comes into the scene, where the mouse was last or else in the middle, or goes out of it.
  void enter(const QSizeF& scene);
  void leave();
  bool active() const { return active_; }

  void follow(const SceneInput& input) { input_ = input; }
  /// 0: it does not press; 1: as hard as a pen can be pressed.
  void press(double pressure) {
    pressure_ = pressure;
    pressed_ = pressed_ || pressing();
  }
  bool pressing() const { return pressure_ > 0.0; }
  /// From now on the hand goes from there (stage frame, m) as the mouse goes, sideways and up and down, and
  /// by the wheel or Page Up and Page Down away and nearer; surfaces stop it, and the button is its button 0.
  /// Without it again as above. What is under the mouse does not count: such a hand gets everywhere by a way
  /// that can be measured.
  void go_freely(const std::optional<base::Vector3>& from);
  bool goes_freely() const { return free_.has_value(); }
  /// Does it press, or has it since the last call, for however short a time?
  bool take_press() { return std::exchange(pressed_, pressing()); }
  /// Presses deeper (or less deep) while the button is down; a hand that goes freely goes away (or nearer).
  void turn_wheel(double notches) { wheel_ += notches; }
  /// One step by the arrow keys; false: it is another key.
  bool step(int key, bool fine);
  /// Aims the hand at what is under the mouse now: objects and the eye move, too.
  void tick();

  /// How hard a mouse button or a key presses.
  static constexpr double kButton = 0.5;

 private:
  void tick_technique(const session::TechniqueHand& hand);
  void tick_freely();
  std::optional<double> depth_under(const session::TechniqueHand& hand, const interaction::Ray& ray) const;

  session::Session& session_;
  interaction::MouseHand hand_ = interaction::MouseHand();
  bool active_ = false;
  SceneInput input_ = {};
  double pressure_ = 0.0;
  bool pressed_ = false;  // since take_press(), or it does
  struct Free {
    base::Vector3 from;                            // m, stage frame
    std::optional<base::Vector2> mouse_from = {};  // in the plane 1 m before the eye; none: at the next tick
    double away = 0.0;                             // m, by the wheel
  };
  std::optional<Free> free_ = {};
  double wheel_ = 0.0;
  double reach_ = 0.6;  // of the view's distance: how far the hand of a technique is from the eye
};

}  // namespace icome::ui
