#pragma once
#include <functional>
#include <optional>

#include "interaction/mouse_hand.h"
#include "session/hands/point_pull.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Drags vertices, edges and faces of meshes, or the points of a lattice round the selection: one action to
/// undo, whatever its steps. A click selects the object under the mouse. The session outlives it.
class ShapeTool {
 public:
  /// `refused` gets the reason why something could not be dragged.
  ShapeTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  /// Sets what is dragged, from now on or when the tool is taken up.
  void set(const interaction::ShapingSettings& settings);
  const interaction::ShapingSettings& settings() const { return settings_; }
  /// Takes the tool up: points are shown, and hands can take hold of them, too.
  void enter();
  void leave();

  void press(const SceneInput& input);
  void follow(const SceneInput& input);
  void release(const SceneInput& input);
  /// Moves the held points to where the mouse went since the last call, or looks for points under the mouse.
  void tick();
  /// Ends the drag, and puts the points back to where they were.
  void cancel();
  /// Ends the drag, and leaves the points where they are: something else changes the world now.
  void finish();
  /// Forgets the drag: there is another world, or the dragged points are gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// The mouse has left the scene.
  void forget_mouse();

  /// Keeps movement to the stage's x, y or z (0, 1, 2) from now on; nothing: it is free.
  void keep_to(std::optional<int> axis);
  std::optional<int> axis() const { return axis_; }

 private:
  struct Drag {
    session::PointPull pull;
    interaction::DragPlane plane;
  };
  std::optional<interaction::ShapingHandle> find(const SceneInput& input) const;
  void begin_drag();
  void select() const;
  void step();
  void hear(const base::Result<void>& done);

  session::Session& session_;
  std::function<void(const std::string&)> refused_;
  interaction::ShapingSettings settings_ = {};
  bool active_ = false;
  std::optional<SceneInput> press_ = {};
  std::optional<interaction::ShapingHandle> pressed_ = {};  // what was under the mouse then
  std::optional<Drag> drag_ = {};
  std::optional<SceneInput> mouse_ = {};  // where it is; while dragging, where it went since the last step
  std::optional<int> axis_ = {};
};

}  // namespace icome::ui
