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
/// is selected; with Ctrl it turns them. A drag is one action to undo. The session outlives it.
class PartTool {
 public:
  /// `refused` gets the reason why something could not be dragged.
  PartTool(session::Session& session, std::function<void(const std::string&)> refused)
      : session_(session), refused_(std::move(refused)) {}

  /// Takes hold of the part under the mouse; false: there is none.
  bool press(const SceneInput& input);
  void follow(const SceneInput& input);
  /// Ends the press; returns it if it was a mere click, which is to select something.
  std::optional<SceneInput> release(const SceneInput& input);
  /// Moves the held part to where the mouse went since the last call.
  void tick();
  /// Marks the part under the mouse while nothing is held, by no hand either; without input, the mouse is
  /// elsewhere. True: there is a part.
  bool hover(const std::optional<SceneInput>& input);
  /// Ends the drag, and puts the part back to where it was.
  void cancel();
  /// Ends the drag, and leaves the part where it is: something else changes the world now.
  void finish();
  /// Forgets the drag: there is another world, or the dragged part is gone.
  void drop();
  bool busy() const { return press_.has_value(); }
  bool dragging() const { return drag_.has_value(); }
  /// Text on the part under the mouse and what a drag of it does; or empty.
  std::string words() const;

  /// Keeps movement to the stage's x, y or z (0, 1, 2) from now on, or turns to that axis; nothing: free.
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
