#pragma once

#include "interaction/navigation.h"
#include "interaction/screen_view.h"
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
  /// The view that is drawn: now(), as the head sees it; for one picture, or for that of an eye.
  const interaction::View& drawn_view(interaction::Eye eye = interaction::Eye::Middle) const;
  /// Is there a device for the user's head?
  bool has_head() const;
  /// From now on the user looks straight ahead where the head is now.
  void recentre_head();
  /// UserInteraction::follow_head().
  void follow_head(bool follows);

  /// The way in which each eye gets its picture, as a person has chosen it.
  void set_stereo(const interaction::StereoSettings& stereo);
  /// Something else wants a picture for each eye, or one for both, whatever was chosen (by anaglyph, where no
  /// other way was); nothing: as it was chosen.
  void ask_for_stereo(std::optional<bool> wanted);
  /// The way that is in force.
  interaction::StereoSettings stereo() const;

  /// Makes the screen a window into the world (UserInteraction::set_fish_tank), or no longer.
  void set_fish_tank(bool on);
  bool is_fish_tank() const;
  /// Sets the size, m, that the picture of an eye has on the screen. Impossible values are passed over.
  void set_screen(const base::Vector2& size);
  /// The size of the whole display, m, where it was given: displays do not always tell theirs.
  std::optional<base::Vector2> display_size() const;
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
