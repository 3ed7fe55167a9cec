#pragma once
#include <functional>
#include <optional>

#include "interaction/mouse_hand.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Selects with a click and moves the selection with a drag, which is one action to undo, whatever its steps.
/// Objects stop at surfaces and snap as the session's settings say; with Shift or Alt they do not snap. The
/// session outlives it.
class MoveTool {
 public:
  /// `refused` gets the reason why something could not be moved.
  MoveTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  void press(const SceneInput& input);
  void follow(const SceneInput& input);
  void release(const SceneInput& input);
  /// Moves the objects to where the mouse went since the last call: one edit for many mouse events.
  void tick();
  /// Ends the drag, and puts the objects back to where they were.
  void cancel();
  /// Ends the drag, and leaves the objects where they are: something else changes the world now.
  void finish();
  /// Forgets the drag: there is another world, or the dragged objects are gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// Text on what has stopped the dragged objects, or what they snap to; or empty.
  std::string words() const;

  /// Keeps movement to the stage's x, y or z (0, 1, 2) from now on; nothing: it is free.
  void keep_to(std::optional<int> axis);
  std::optional<int> axis() const { return axis_; }

  /// Moves the selection by the keyboard: `in_view` is right, up and towards the viewer, in m; it moves along
  /// the axis of the stage that comes nearest to that. `more`: as part of the last nudge.
  void nudge(const base::Vector3& in_view, bool more);

 private:
  struct Press {
    SceneInput input;
    std::optional<session::SessionStage::Picked> picked;
  };
  struct Drag {
    session::ObjectDrag objects;
    interaction::DragPlane plane;
  };
  void begin_drag();
  void select(const Press& press);
  void step();
  void go_on();

  session::Session& session_;
  std::function<void(const std::string&)> refused_;
  std::optional<Press> press_ = {};
  std::optional<Drag> drag_ = {};
  std::optional<session::ObjectDrag> let_go_ = {};  // until it is known how far it comes
  std::optional<SceneInput> due_ = {};              // where the mouse went
  std::optional<int> axis_ = {};
  bool nudged_ = false;  // the last action is a nudge
};

}  // namespace icome::ui
