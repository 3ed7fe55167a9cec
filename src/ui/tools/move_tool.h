#pragma once
#include <functional>
#include <optional>

#include "interaction/mouse_hand.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Selects with a click and moves what is selected with a drag: one action to undo, whatever its steps. It
/// stops at surfaces and snaps as the session's settings say; with Shift or Alt it does not snap. The session
/// outlives it.
class MoveTool {
 public:
  /// `refused` hears why something could not be moved.
  MoveTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  void press(const SceneInput& input);
  void follow(const SceneInput& input);
  void release(const SceneInput& input);
  /// Brings the things to where the mouse went since the last call: one edit for many mouse events.
  void tick();
  /// What was dragged goes back to where it was.
  void cancel();
  /// What was dragged stays where it is; somebody else changes the world now.
  void finish();
  /// There is another world, or what was dragged is gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// What has stopped what is dragged, or what it snaps to; or empty.
  std::string words() const;

  /// Movement keeps to the stage's x, y or z (0, 1, 2) from now on, or is free.
  void keep_to(std::optional<int> axis);
  std::optional<int> axis() const { return axis_; }

  /// Moves the selection by the keyboard: right, up and to the viewer, in m; along the axis of the stage that
  /// comes nearest to that. `more`: as part of the last nudge.
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
  std::optional<session::ObjectDrag> let_go_ = {};  // while it is not known yet how far it comes
  std::optional<SceneInput> due_ = {};              // where the mouse went
  std::optional<int> axis_ = {};
  bool nudged_ = false;  // the last action is a nudge
};

}  // namespace icome::ui
