#include "session/display/render_follower.h"

#include <algorithm>
#include <cstdint>

#include "session/pause_of_work.h"

namespace icome::session {
namespace {

constexpr double kShortestPause = 1.0 / 30.0;        // s
constexpr double kShortestMotionPause = 1.0 / 60.0;  // s, while objects move

}  // namespace

void RenderFollower::open(const world::World& world, world::SceneId shown) {
  playback_ = {};
  publisher_ = render::ScenePublisher(shown);
  publish(publisher_.publish(world));
}

void RenderFollower::show(const world::World& world, world::SceneId shown) {
  publish(publisher_.show_scene(playback_.shown(world), shown));
}

void RenderFollower::follow(const world::World& world, const world::Changes& changes) {
  const world::Changes all = playback_.follow(world, changes, clock_() - played_since_);
  publish(publisher_.update(playback_.shown(world), all));
}

void RenderFollower::play(const world::World& world, std::optional<double> since) {
  played_since_ = since.value_or(0.0);
  const auto time = since ? std::optional<double>(clock_() - *since) : std::nullopt;
  const world::Changes changes = playback_.play(world, time);
  publish(publisher_.update(playback_.shown(world), changes));
}

std::optional<std::chrono::nanoseconds> RenderFollower::pause(const world::World& world) const {
  const bool changes = shapes_change_ && publisher_.changes(playback_.shown(world));
  if (!changes && !playback_.moves()) return std::nullopt;
  return std::chrono::nanoseconds(std::int64_t(1e9 * std::max(0.0, due_ - clock_())));
}

void RenderFollower::go_on(const world::World& world) {
  const double now = clock_();
  if (now < due_) return;
  render::RenderScenePointer scene = nullptr;
  const world::Changes moved = playback_.go_to(now - played_since_);
  const world::World& shown = playback_.shown(world);
  if (!moved.objects.empty()) scene = publisher_.update(shown, moved);
  if (shapes_change_)
    if (const render::RenderScenePointer changed = publisher_.at_time(shown, now)) scene = changed;
  if (scene) publish(scene);
  const double done = clock_();
  const double shortest = playback_.moves() ? kShortestMotionPause : kShortestPause;
  due_ = done + pause_after_work(done - now, shortest);
}

void RenderFollower::publish(const render::RenderScenePointer& scene) {
  display_.publish(scene);
  newest_.publish(scene);
}

}  // namespace icome::session
