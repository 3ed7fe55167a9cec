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
  /// Moves the view there softly, over some tenths of a second.
  void fly_to(const interaction::View& view);
  /// Moves the view softly to where everything that is shown is seen.
  void home();
  /// Sets the width over the height of the picture to fit into. Impossible values are passed over.
  void set_aspect(double aspect);
  double aspect() const;
  interaction::NavigationMode navigation_mode() const;
  void set_navigation_mode(interaction::NavigationMode mode);
  /// The view that is drawn: now(), as the head sees it.
  const interaction::View& drawn_view() const;
  /// Is there a device for the user's head?
  bool has_head() const;
  /// From now on the user looks straight ahead where the head is now.
  void recentre_head();
  /// UserInteraction::follow_head().
  void follow_head(bool follows);
  /// Sets the look of the world as main wants it; view and selection are put in by the session.
  void set_look(const DisplayWish& look);
  /// The scene on the stage, as main saw it last; never null.
  const render::RenderScenePointer& drawn() const;
  /// The feed of the display thread.
  DisplayFeed& display();

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
