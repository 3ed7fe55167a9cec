#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/simulated/simulated_device.h"
#include "session/felt_world.h"
#include "session/haptic_loop.h"
#include "session/revisions.h"
#include "session/seen_world.h"
#include "session/session.h"

namespace icome::session {

/// What a session is made of. All of it is main's, but for what threads of its own have.
struct Session::Parts {
  Parts(SessionSettings settings, std::vector<std::unique_ptr<devices::PointerDevice>> devices,
        devices::SimulatedDevice* mouse_hand);
  ~Parts();

  // session_world.cpp
  base::Result<void> done(base::Result<void> result);
  void open_world(world::World world, const std::filesystem::path& design, const base::Pose& stage);
  void tell_change(const world::Changes* changes);
  void notify_change(const world::Changes* changes) const;
  void notify_selection() const;
  void show(world::SceneId scene);
  world::EditSink sink();

  // session_view.cpp
  void move_view();
  void publish_wish();

  // session.cpp
  void take_in();
  void notice_devices();
  void tell(SessionEvent::Kind kind, std::string text, std::vector<std::string> details = {});
  bool is_settled() const;

  SessionSettings settings;

  world::World world;
  world::History history;
  world::IdSource ids;
  Revisions revisions;
  std::uint64_t saved_revision = 0;
  base::Pose stage_from_world = base::Pose::Identity();
  std::filesystem::path path;
  world::SceneId shown_scene = {};
  std::vector<world::ObjectId> selection;
  // A listener may let another one in while it is called.
  std::deque<std::function<void(const world::Changes*)>> change_listeners;
  std::deque<std::function<void()>> selection_listeners;
  std::vector<SessionEvent> events;  // that update() has not given yet
  std::optional<Edited> performed;   // by the sink, to be posted when the history has it

  DisplayWish look;  // as main wants it, without view and selection
  bool look_is_new = true;
  interaction::View view;
  std::optional<interaction::ViewFlight> flight;
  std::int64_t flight_began = 0;  // ns
  interaction::NavigationMode navigation_mode = interaction::NavigationMode::Camera;

  EditedQueue queue;
  DisplayFeed display;
  devices::SimulatedDevice* mouse_hand;  // null: no pointer is driven by the mouse
  HapticLoop hands;
  std::vector<bool> lost;             // the pointer's device, as a person was told last
  std::vector<std::uint64_t> losses;  // that a person was told of
  realtime::LatestValue<FeltVersion> felt;
  realtime::LatestValue<render::RenderScenePointer> seen;
  // Last, as their threads use the rest.
  std::unique_ptr<Follower> felt_follower;
  std::unique_ptr<Follower> seen_follower;
};

}  // namespace icome::session
