#include "session/seen_world.h"

#include <algorithm>
#include <cstdint>

namespace icome::session {
namespace {

constexpr double kShortestPause = 1.0 / 30.0;  // s
/// What changes is made anew for at most a quarter of the time of one core.
constexpr double kPauseOfWork = 3.0;

}  // namespace

void SeenWorld::open(const world::World& world, world::SceneId shown) {
  publisher_ = render::ScenePublisher(shown);
  publish(publisher_.publish(world));
}

void SeenWorld::show(const world::World& world, world::SceneId shown) {
  publish(publisher_.show_scene(world, shown));
}

void SeenWorld::follow(const world::World& world, const world::Changes& changes) {
  publish(publisher_.update(world, changes));
}

std::optional<std::chrono::nanoseconds> SeenWorld::pause(const world::World& world) const {
  if (!clock_ || !publisher_.changes(world)) return std::nullopt;
  return std::chrono::nanoseconds(std::int64_t(1e9 * std::max(0.0, due_ - clock_())));
}

void SeenWorld::go_on(const world::World& world) {
  if (!clock_) return;
  const double now = clock_();
  if (now < due_) return;
  const render::RenderScenePointer scene = publisher_.at_time(world, now);
  if (!scene) return;
  publish(scene);
  const double done = clock_();
  due_ = done + std::max(kShortestPause, kPauseOfWork * (done - now));
}

void SeenWorld::publish(const render::RenderScenePointer& scene) {
  display_.publish(scene);
  newest_.publish(scene);
}

}  // namespace icome::session
