#pragma once
#include <optional>

#include "session/session.h"
#include "ui/tools/scene_input.h"

namespace icome::ui {

/// A way to move the view with the mouse while a button is down.
enum class ViewMove : std::uint8_t { Orbit, Pan, Look };

/// Moves the view of a session, which outlives it, with the mouse.
class ViewDrag {
 public:
  explicit ViewDrag(session::Session& session) : session_(session) {}

  void begin(ViewMove how, const SceneInput& input);
  /// Moves the view by the motion of the mouse.
  void follow(const SceneInput& input);
  void end() { how_.reset(); }
  bool active() const { return how_.has_value(); }
  /// Has the mouse moved further than a click does?
  bool moved() const { return moved_; }

 private:
  session::Session& session_;
  std::optional<ViewMove> how_ = {};
  QPointF begun_ = {}, last_ = {};
  bool moved_ = false;
};

/// The most pixels that a hand moves the mouse without meaning to.
inline constexpr double kClickSlack = 4.0;

/// Zooms by notches of the wheel: nearer to, or farther from, what is under the mouse.
void zoom_at(session::Session& session, const SceneInput& input, double notches);

/// Zooms by notches in the middle of the picture.
void zoom_in_middle(session::Session& session, double notches);

/// Moves the view by one step of the arrow keys; Pan moves what is seen that way. False: it is another key.
bool step_view(session::Session& session, int key, ViewMove how);

/// Flies to the object, or to all that is selected (all, without a selection), seen from the same side.
void zoom_to(session::Session& session, world::ObjectId object, double aspect);
void zoom_to_selection(session::Session& session, double aspect);

/// Flies to where all is seen from that direction.
void look_from(session::Session& session, const base::Vector3& toward_eye, const base::Vector3& up,
               double aspect);
/// Flies to a viewpoint of the design.
void look_from(session::Session& session, const render::RenderViewpoint& viewpoint);

}  // namespace icome::ui
