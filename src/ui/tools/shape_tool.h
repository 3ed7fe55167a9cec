#pragma once
#include <functional>
#include <optional>

#include "interaction/mouse_hand.h"
#include "session/hands/point_pull.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Drags vertices, edges and faces of meshes, or the points of a lattice round the selection: one action to
/// undo, whatever its steps. A click where there is none of them selects. The session outlives it.
class ShapeTool {
 public:
  /// `refused` hears why something could not be dragged.
  ShapeTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  /// What is dragged, from now on or when the tool is taken up.
  void set(const interaction::ShapingSettings& settings);
  const interaction::ShapingSettings& settings() const { return settings_; }
  /// The tool is taken up: points are shown, and hands take hold of them too.
  void enter();
  void leave();

  void press(const SceneInput& input);
  void follow(const SceneInput& input);
  void release(const SceneInput& input);
  /// Brings what is held to where the mouse went since the last call, or looks for what the mouse is over.
  void tick();
  /// What was dragged goes back to where it was.
  void cancel();
  /// What was dragged stays where it is; somebody else changes the world now.
  void finish();
  /// There is another world, or what was dragged is gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// The mouse has left the scene.
  void forget_mouse();

  /// Movement keeps to the stage's x, y or z (0, 1, 2) from now on, or is free.
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
