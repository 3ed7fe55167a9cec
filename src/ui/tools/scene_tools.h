#pragma once
#include <array>
#include <functional>
#include <optional>

#include "session/felt/haptic_loop.h"
#include "session/session.h"
#include "ui/tools/move_tool.h"
#include "ui/tools/part_tool.h"
#include "ui/tools/scene_input.h"
#include "ui/tools/shape_tool.h"
#include "ui/tools/touch_tool.h"
#include "ui/tools/view_moves.h"

namespace icome::ui {

/// The tool of the left mouse button.
enum class Tool : std::uint8_t { Select, Touch, View, Shape };
constexpr int kToolCount = 4;

/// Turns input of mouse, pen and keyboard over the scene into actions of the session. The left button is the
/// chosen tool's; the right one turns the view, the middle one (or Shift and right) shifts it, and the wheel
/// zooms. The session outlives it.
class SceneTools {
 public:
  struct Listener {
    std::function<void(Tool)> chosen = [](Tool) {};
    std::function<void(const std::string&)> refused = [](const std::string&) {
    };                                                    // why something was not done
    std::function<void(QPointF)> asked = [](QPointF) {};  // a right click, for the menu there in the window
    /// The haptic menu is asked for, or to go.
    std::function<void(const session::MenuSpot&)> menu = [](const session::MenuSpot&) {};
    /// Does one talk with the second button of a stylus, so that it asks for no menu?
    std::function<bool()> button_talks = [] { return false; };
  };
  SceneTools(session::Session& session, Listener listener);
  SceneTools(const SceneTools&) = delete;
  SceneTools& operator=(const SceneTools&) = delete;

  Tool tool() const { return tool_; }
  void choose(Tool tool);
  /// Chooses the tool for good: nothing chooses another, or moves the view, from now on.
  void stay_with(Tool tool);

  // Events over the scene. Those that return bool tell whether the event was used.
  void press(const SceneInput& input);
  void move(const SceneInput& input);
  void release(const SceneInput& input);
  void double_click(const SceneInput& input);
  void wheel(const SceneInput& input, double notches);
  /// A pen at the tablet, with its pressure in [0, 1]. Only Touch uses it; for the other tools it acts as a
  /// mouse.
  bool pen(const SceneInput& input, double pressure);
  bool key_press(int key, Qt::KeyboardModifiers modifiers, bool repeats);
  bool key_release(int key);
  /// Does the key belong here though it is the shortcut of an action, as it types into the haptic menu?
  bool takes_key(int key, Qt::KeyboardModifiers modifiers) const;
  /// The keyboard's focus goes elsewhere: releases of keys will not be reported.
  void forget_keys();
  /// The mouse has left the scene.
  void leave();
  void resize(const QSizeF& size);

  /// To be called once for each update of the session, before it.
  void tick();
  /// Ends what the mouse is doing, where it is: something else is about to change the world.
  void finish();

  /// The object under the mouse, as of the last tick (with Touch, under the hand); nothing while it drags.
  std::optional<world::ObjectId> hovered() const { return hovered_; }
  /// The way that the mouse points; nothing: it is not over the scene.
  std::optional<interaction::Ray> mouse_way() const;
  bool dragging() const { return move_tool_.dragging() || part_tool_.dragging() || shape_tool_.dragging(); }
  ShapeTool& shape_tool() { return shape_tool_; }
  /// Text on what has stopped the dragged objects, what they snap to, or which part of the selection can be
  /// dragged; or empty.
  std::string drag_words() const;
  TouchTool& touch_tool() { return touch_tool_; }
  bool turning() const { return view_drag_.active(); }
  /// Width over height of the picture of an eye.
  double aspect() const { return size_.width() / size_.height(); }
  interaction::StereoSettings stereo() const { return session_.view().stereo(); }

 private:
  bool escape();
  bool point_at_menu(const SceneInput& input);
  bool menu_key(int key);
  static char typed_letter(int key);
  double distance_before_things(const SceneInput& at) const;
  void ask_for_menu();
  void notice_menu_buttons();
  bool arrow(int key, Qt::KeyboardModifiers modifiers, bool repeats);
  std::optional<ViewMove> view_move(const SceneInput& input) const;
  void look_for_hovered();
  bool busy() const { return move_tool_.busy() || part_tool_.busy() || shape_tool_.busy(); }
  void keep_to(std::optional<int> axis);

  session::Session& session_;
  Listener listener_;
  MoveTool move_tool_;
  PartTool part_tool_;
  TouchTool touch_tool_;
  ShapeTool shape_tool_;
  ViewDrag view_drag_;
  Qt::MouseButton view_button_ = {};  // the button that drags the view
  Tool tool_ = Tool::Select;
  bool stays_ = false;                                                      // the tool stays chosen
  bool presses_menu_ = false;                                               // the mouse does
  std::array<bool, session::HapticLoop::kMostPointers> menu_buttons_ = {};  // are they down?
  QSizeF scene_size_ = {1.0, 1.0};
  QSizeF size_ = {1.0, 1.0};  // of the picture of an eye
  std::optional<SceneInput> mouse_ = {};
  std::optional<world::ObjectId> hovered_ = {};
};

}  // namespace icome::ui
