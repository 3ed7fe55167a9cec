#include "session/felt_world.h"

#include <utility>

namespace icome::session {

FeltWorld::FeltWorld(const HapticRepresentationSettings& settings, std::vector<haptics::Servo*> servos,
                     realtime::LatestValue<FeltVersion>& newest)
    : felt_(settings), servos_(std::move(servos)), newest_(newest) {}

void FeltWorld::open(const world::World& world, world::SceneId shown) {
  felt_.open(world, shown);
  look_for_remarks(world);
  publish();
}

void FeltWorld::show(const world::World& world, world::SceneId shown) {
  felt_.show(world, shown);
  look_for_remarks(world);
  publish();
}

void FeltWorld::follow(const world::World& world, const world::Changes& changes) {
  felt_.follow(world, changes);
  // Looking goes through all objects, which what is dragged must not wait for.
  if (!changes.geometries.empty() || !changes.materials.empty()) look_for_remarks(world);
  publish();
}

void FeltWorld::look_for_remarks(const world::World& world) {
  std::vector<std::string> remarks = felt_.remarks(world);
  if (remarks_ ? *remarks_ == remarks : remarks.empty()) return;
  remarks_ = std::make_shared<const std::vector<std::string>>(std::move(remarks));
}

void FeltWorld::publish() {
  if (felt_.effects() != published_effects_) {
    published_effects_ = felt_.effects();
    for (haptics::Servo* servo : servos_) servo->publish_effects(published_effects_);
  }
  FeltVersion version{felt_.scene(), felt_.names(), published_.capped, remarks_};
  if (version.scene != published_.scene)
    for (haptics::Servo* servo : servos_) servo->publish(version.scene);
  auto capped = servos_.empty() ? std::vector<haptics::CappedEffect>() : servos_.front()->capped_effects();
  if (!version.capped || *version.capped != capped)
    version.capped = std::make_shared<const std::vector<haptics::CappedEffect>>(std::move(capped));
  if (version.scene == published_.scene && version.names == published_.names &&
      version.capped == published_.capped && version.remarks == published_.remarks)
    return;
  published_ = version;
  newest_.publish(version);
}

}  // namespace icome::session
