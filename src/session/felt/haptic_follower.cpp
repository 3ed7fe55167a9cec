#include "session/felt/haptic_follower.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "session/pause_of_work.h"

namespace icome::session {
namespace {

constexpr double kShortestMoveTime = 0.008;  // s: well below what a thing takes to where it is put

}  // namespace

HapticFollower::HapticFollower(const HapticRepresentationSettings& settings, FeltServos& servos,
                               realtime::LatestValue<FeltVersion>& newest)
    : felt_(settings),
      clock_(settings.clock),
      ahead_(settings.glide_seconds),
      servos_(servos),
      newest_(newest) {}

void HapticFollower::open(const world::World& world, world::SceneId shown) {
  playback_ = {};
  felt_.open(world, shown);
  look_for_remarks(world);
  publish();
}

void HapticFollower::show(const world::World& world, world::SceneId shown) {
  felt_.show(playback_.shown(world), shown);
  look_for_remarks(world);
  publish();
}

void HapticFollower::follow(const world::World& world, const world::Changes& changes) {
  const world::Changes all = playback_.follow(world, changes, played());
  felt_.follow(playback_.shown(world), all);
  // The search goes through all objects: a drag must not wait for it.
  if (!changes.geometries.empty() || !changes.materials.empty()) look_for_remarks(world);
  publish();
}

void HapticFollower::play(const world::World& world, std::optional<double> since) {
  played_since_ = since.value_or(0.0);
  const world::Changes changes =
      playback_.play(world, since ? std::optional<double>(played()) : std::nullopt);
  felt_.follow(playback_.shown(world), changes);
  publish();
}

/// The time (s) that motions will have been played when things are where they are put now.
double HapticFollower::played() const { return clock_() + ahead_ - played_since_; }

std::optional<std::chrono::nanoseconds> HapticFollower::pause(const world::World& /*world*/) const {
  if (!playback_.moves()) return std::nullopt;
  return std::chrono::nanoseconds(std::int64_t(1e9 * std::max(0.0, due_ - clock_())));
}

void HapticFollower::go_on(const world::World& world) {
  const double now = clock_();
  if (!playback_.moves() || now < due_) return;
  const world::Changes moved = playback_.go_to(played());
  if (!moved.objects.empty()) {
    felt_.follow(playback_.shown(world), moved);
    publish();
  }
  const double done = clock_();
  due_ = done + pause_after_work(done - now, kShortestMoveTime);
}

void HapticFollower::look_for_remarks(const world::World& world) {
  std::vector<std::string> remarks = felt_.remarks(world);
  if (remarks_ ? *remarks_ == remarks : remarks.empty()) return;
  remarks_ = std::make_shared<const std::vector<std::string>>(std::move(remarks));
}

void HapticFollower::publish() {
  if (felt_.effects() != published_effects_) {
    published_effects_ = felt_.effects();
    servos_.publish_effects(published_effects_);
  }
  FeltVersion version{felt_.scene(), felt_.names(), published_.capped, remarks_};
  if (version.scene != published_.scene) servos_.publish(version.scene);
  auto capped = servos_.capped_effects();
  if (!version.capped || *version.capped != capped)
    version.capped = std::make_shared<const std::vector<haptics::CappedEffect>>(std::move(capped));
  if (version.scene == published_.scene && version.names == published_.names &&
      version.capped == published_.capped && version.remarks == published_.remarks)
    return;
  published_ = version;
  newest_.publish(version);
}

}  // namespace icome::session
