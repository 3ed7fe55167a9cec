#pragma once
#include "realtime/latest_value.h"
#include "render/render_scene.h"
#include "session/display_feed.h"
#include "session/follower.h"

namespace icome::session {

/// Keeps the world before the eye: brings each version of what is drawn to the display, and to main.
class SeenWorld final : public Representation {
 public:
  /// The feed and the box outlive this; it alone publishes scenes to them.
  SeenWorld(DisplayFeed& display, realtime::LatestValue<render::RenderScenePointer>& newest)
      : display_(display), newest_(newest) {}

  void open(const world::World& world, world::SceneId shown) override;
  void show(const world::World& world, world::SceneId shown) override;
  void follow(const world::World& world, const world::Changes& changes) override;

 private:
  void publish(const render::RenderScenePointer& scene);

  render::ScenePublisher publisher_;
  DisplayFeed& display_;
  realtime::LatestValue<render::RenderScenePointer>& newest_;
};

}  // namespace icome::session
