#pragma once

#include "interaction/navigation.h"
#include "render/model/render_scene.h"
#include "session/display/display_feed.h"

namespace icome::session {

struct SessionParts;

/// The view of a session and what it is drawn by. Main's, but for display().
class SessionView {
 public:
  explicit SessionView(SessionParts& parts) : parts_(parts) {}
  SessionView(const SessionView&) = delete;
  SessionView& operator=(const SessionView&) = delete;

  const interaction::View& now() const;
  void set(const interaction::View& view);
  /// On its way softly, over some tenths of a second.
  void fly_to(const interaction::View& view);
  /// Softly to where all that is shown is seen.
  void home();
  /// Width by height of the picture that it has to fit into. What is no such shape is passed over.
  void set_aspect(double aspect);
  double aspect() const;
  interaction::NavigationMode navigation_mode() const;
  void set_navigation_mode(interaction::NavigationMode mode);
  /// How main wants the world to look; view and selection are put in by the session.
  void set_look(const DisplayWish& look);
  /// What is on the stage, as main saw it last; never null.
  const render::RenderScenePointer& drawn() const;
  /// The display thread's.
  DisplayFeed& display();

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
