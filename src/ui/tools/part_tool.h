#pragma once
#include <functional>
#include <optional>
#include <string>

#include "interaction/mouse_hand.h"
#include "session/hands/part_pull.h"
#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// Drags operands of solids and projectors of pictures by their outlines, which are seen while their object
/// is selected; with Ctrl it turns them. One action to undo, whatever its steps. The session outlives it.
class PartTool {
 public:
  /// `refused` hears why something could not be dragged.
  PartTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  /// False: there is none of them under the mouse.
  bool press(const SceneInput& input);
  void follow(const SceneInput& input);
  /// The press that was a mere click, and so is for who selects.
  std::optional<SceneInput> release(const SceneInput& input);
  /// Brings what is held to where the mouse went since the last call.
  void tick();
  /// Points out what is under the mouse while nothing is held, by no hand either; none: it is elsewhere.
  /// True: there is something.
  bool hover(const std::optional<SceneInput>& input);
  /// What was dragged goes back to where it was.
  void cancel();
  /// What was dragged stays where it is; somebody else changes the world now.
  void finish();
  /// There is another world, or what was dragged is gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// What is under the mouse and what a drag of it does; or empty.
  std::string words() const;

  /// Movement keeps to the stage's x, y or z (0, 1, 2) from now on, or turns are about it; or it is free.
  void keep_to(std::optional<int> axis);

 private:
  struct Press {
    SceneInput input;
    session::PartOutlines::Picked picked;
  };
  struct Drag {
    session::PartPull pull;
    interaction::DragPlane plane;
    base::Vector3 toward_eye;                        // unit
    std::optional<interaction::DragTurn> turn = {};  // nothing: it is moved
    base::Vector3 turn_axis = base::Vector3::UnitY();
  };
  void begin_drag();
  void aim_drag();
  std::optional<base::Affine3> motion(const SceneInput& input) const;
  void step();
  void hear(const base::Result<void>& done);

  session::Session& session_;
  std::function<void(const std::string&)> refused_;
  std::optional<Press> press_ = {};
  std::optional<Drag> drag_ = {};
  std::optional<SceneInput> due_ = {};  // where the mouse went
  std::optional<interaction::PlacedPart> hovered_ = {};
  std::optional<int> axis_ = {};
};

}  // namespace icome::ui
