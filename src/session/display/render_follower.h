#pragma once
#include <functional>
#include <utility>

#include "realtime/latest_value.h"
#include "render/model/render_scene.h"
#include "session/display/display_feed.h"
#include "session/follower.h"
#include "session/playback.h"

namespace icome::session {

/// Keeps the drawn world up to date: brings each version of its scene to the display, and to main.
class RenderFollower final : public Representation {
 public:
  /// The feed and the box outlive this; it alone publishes scenes to them. `clock` tells the time (s) of
  /// motions and, where `shapes_change`, of shapes; else these are drawn as at t = 0.
  RenderFollower(DisplayFeed& display, realtime::LatestValue<render::RenderScenePointer>& newest,
                 std::function<double()> clock, bool shapes_change)
      : display_(display), newest_(newest), clock_(std::move(clock)), shapes_change_(shapes_change) {}

  void open(const world::World& world, world::SceneId shown) override;
  void show(const world::World& world, world::SceneId shown) override;
  void follow(const world::World& world, const world::Changes& changes) override;
  void play(const world::World& world, std::optional<double> since) override;
  std::optional<std::chrono::nanoseconds> pause(const world::World& world) const override;
  void go_on(const world::World& world) override;

 private:
  void publish(const render::RenderScenePointer& scene);

  render::ScenePublisher publisher_;
  DisplayFeed& display_;
  realtime::LatestValue<render::RenderScenePointer>& newest_;
  std::function<double()> clock_;
  bool shapes_change_;
  Playback playback_;
  double played_since_ = 0.0;  // s on the clock
  double due_ = 0.0;           // s on the clock: when changing things are to be drawn anew
};

}  // namespace icome::session
