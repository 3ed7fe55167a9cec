#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/head_device.h"
#include "devices/navigation_device.h"
#include "interaction/head/head_motion.h"
#include "interaction/navigation.h"
#include "interaction/screen_view.h"

namespace icome::session {

/// The user's place in the world (thesis 5.6.3 and 2.4.2): owns the view, a flight of it under way, the
/// navigation and the head device, and gives the place of the pointers' workspaces. Whatever moves the view
/// carries the pointers along; the head moves the eye alone. One thread (main) uses it; it knows no clock, so
/// the same calls give the same poses.
class UserInteraction {
 public:
  /// Either device may be null.
  explicit UserInteraction(std::unique_ptr<devices::NavigationDevice> navigation = nullptr,
                           std::unique_ptr<devices::HeadDevice> head = nullptr);

  /// A device that has gone, or is back.
  struct DeviceNews {
    bool lost = false;
    std::string text = {};  // a sentence or two: what happened, and what to do
  };
  /// News of update() that others have to act on; button 0 exchanges camera and hand mode by itself.
  struct News {
    bool home = false;  // the user wants to see everything: button 1 of the navigation device
    std::vector<DeviceNews> devices = {};
  };
  /// Reads the devices and moves on by `dt` seconds (what is more than a tenth is not made up for). Call it
  /// some 60 times a second.
  News update(double dt);

  /// The user's view, without the head; always usable.
  const interaction::View& view() const { return view_; }
  /// The view to be drawn, as the head sees it, for the point between the eyes or for one of them. A head
  /// that moves as far as its distance to a screen (`kScreenDistance`) moves the eye by the view's distance.
  const interaction::View& drawn_view(interaction::Eye eye = interaction::Eye::Middle) const {
    return drawn_[std::size_t(eye)];
  }
  static constexpr double kScreenDistance = 0.6;  // m

  bool has_head() const { return head_ != nullptr; }
  /// How far the eye goes along with the head (thesis 5.7.1); nothing: as far as the head does.
  void set_head_transfer(const std::optional<interaction::HeadTransfer>& transfer);
  /// Does the eye go along with the head from now on? Else it is where the view has it, at once.
  void follow_head(bool follows) { follows_head_ = follows; }
  /// From now on the eye is at the view's place where the head is now.
  void recentre_head();
  /// Sets the filter and prediction of the head's poses.
  void set_head_filter(const interaction::HeadFilterSettings& filter) { head_motion_.set_filter(filter); }

  /// Makes the screen a window into the world: the eye is where the head is before it, without the transfer
  /// function, and the picture's field is the one that the screen has for an eye at rest. Nothing: no longer.
  void set_fish_tank(const std::optional<interaction::FishTank>& screen);
  const std::optional<interaction::FishTank>& fish_tank() const { return fish_tank_; }
  /// The distance between the eyes, m; the drawn views of the eyes lie so far apart. The plane through the
  /// point looked at has no parallax.
  void set_eye_distance(double metres);

  /// Sets the view at once; a flight ends.
  void set_view(const interaction::View& view);
  /// Moves the view softly, within that time (s). Pushing the navigation device ends the flight where it is.
  void fly_to(const interaction::View& view, double seconds = 0.35);

  /// Moves the view by a motion (stage frame) with all workspaces, as one rigid thing; a flight ends.
  /// Workspaces that were tilted so get upright again by themselves, softly, once neither this nor
  /// keep_hands() is called at every update.
  void carry(const base::Pose& by);
  void keep_hands() { carried_ = true; }

  interaction::NavigationMode mode() const { return mode_; }
  void set_mode(interaction::NavigationMode mode) { mode_ = mode; }

  /// The place of all pointer devices' workspaces on the stage: their middle is at the point that the view
  /// looks at, or where hand mode moved it from there; upright, and turned as the view is.
  const base::Pose& stage_from_device() const { return stage_from_device_; }
  /// Brings the workspaces back to the point that the view looks at, softly.
  void recall_hands() { recalled_ = true; }

 private:
  /// The known presence of a device.
  struct Presence {
    bool asked = false;   // has it been read yet?
    bool there = false;   // at the last reading
    double silent = 0.0;  // s, since it said something new
  };
  void note(const std::string& name, Presence& presence, devices::DeviceStatus status, double dt, News& news);
  void read_navigation(double dt, News& news);
  void read_head(double dt, News& news);
  void steer(double dt);
  void move_hands(double dt);
  void right_hands(double dt);
  void place();
  void place_eyes();

  std::unique_ptr<devices::NavigationDevice> navigation_;  // may be null
  std::unique_ptr<devices::HeadDevice> head_;              // may be null
  Presence navigation_presence_, head_presence_;
  devices::NavigationState steering_;  // no push, no turn, while there is no device
  interaction::View view_;
  std::array<interaction::View, 3> drawn_;  // by Eye
  std::optional<interaction::ViewFlight> flight_;
  double flown_for_ = 0.0;  // s
  interaction::NavigationMode mode_ = interaction::NavigationMode::Camera;
  // The workspaces, from the point looked at: in the view's heading, of its distance; rad to the left.
  base::Vector3 hand_offset_ = base::Vector3::Zero();
  double hand_turn_ = 0.0;
  bool recalled_ = false;
  // The tilt of the workspaces as carry() left them, from upright and turned.
  base::Quaternion hand_tilt_ = base::Quaternion::Identity();
  bool carried_ = false;  // since the last update
  interaction::HeadMotion head_motion_;
  bool head_is_transferred_ = true;
  bool follows_head_ = true;
  base::Pose rest_from_head_ = base::Pose::Identity();  // as the eye goes along with it
  double time_ = 0.0;                                   // s, of all updates
  double head_is_back_for_ = 0.0;                       // s, in which the eye goes back to a head found again
  std::optional<interaction::FishTank> fish_tank_;
  double field_before_ = 0.0;                                         // rad, of the view before it was one
  double eye_distance_ = interaction::StereoSettings().eye_distance;  // m
  base::Pose stage_from_device_ = base::Pose::Identity();
};

}  // namespace icome::session
