#include "session/felt_world.h"

#include <utility>

namespace icome::session {

FeltWorld::FeltWorld(const HapticRepresentationSettings& settings, std::vector<haptics::Servo*> servos,
                     realtime::LatestValue<FeltVersion>& newest)
    : felt_(settings), servos_(std::move(servos)), newest_(newest) {}

void FeltWorld::open(const world::World& world, world::SceneId shown) {
  felt_.open(world, shown);
  publish();
}

void FeltWorld::show(const world::World& world, world::SceneId shown) {
  felt_.show(world, shown);
  publish();
}

void FeltWorld::follow(const world::World& world, const world::Changes& changes) {
  felt_.follow(world, changes);
  publish();
}

void FeltWorld::publish() {
  if (felt_.effects() != published_effects_) {
    published_effects_ = felt_.effects();
    for (haptics::Servo* servo : servos_) servo->publish_effects(published_effects_);
  }
  FeltVersion version{felt_.scene(), felt_.names(), published_.capped};
  if (version.scene != published_.scene)
    for (haptics::Servo* servo : servos_) servo->publish(version.scene);
  auto capped = servos_.empty() ? std::vector<haptics::CappedEffect>() : servos_.front()->capped_effects();
  if (!version.capped || *version.capped != capped)
    version.capped = std::make_shared<const std::vector<haptics::CappedEffect>>(std::move(capped));
  if (version.scene == published_.scene && version.names == published_.names &&
      version.capped == published_.capped)
    return;
  published_ = version;
  newest_.publish(version);
}

}  // namespace icome::session
