#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/servo/servo.h"
#include "realtime/latest_value.h"
#include "session/felt/felt_servos.h"
#include "session/felt/haptic_representation.h"
#include "session/follower.h"
#include "session/playback.h"

namespace icome::session {

/// A version of the touchable world, for others than the servo.
struct FeltVersion {
  std::shared_ptr<const haptics::HapticScene> scene;
  std::shared_ptr<const TouchedNames> names;
  std::shared_ptr<const std::vector<haptics::CappedEffect>> capped =
      nullptr;  // by the first pointer; null: none
  /// Sentences on things that are not felt, or not as they are.
  std::shared_ptr<const std::vector<std::string>> remarks = nullptr;  // null: none
};

/// Keeps the felt world up to date: brings each version of its haptic scene to the servos of all pointers,
/// and to main.
class HapticFollower final : public Representation {
 public:
  /// The servos and the box outlive this; it alone publishes to them.
  HapticFollower(const HapticRepresentationSettings& settings, FeltServos& servos,
                 realtime::LatestValue<FeltVersion>& newest);

  void open(const world::World& world, world::SceneId shown) override;
  void show(const world::World& world, world::SceneId shown) override;
  void follow(const world::World& world, const world::Changes& changes) override;
  void play(const world::World& world, std::optional<double> since) override;
  std::optional<std::chrono::nanoseconds> pause(const world::World& world) const override;
  void go_on(const world::World& world) override;

 private:
  double played() const;
  void look_for_remarks(const world::World& world);
  void publish();

  HapticRepresentation felt_;
  std::function<double()> clock_;
  double ahead_;  // s, by which motions are felt ahead, as things take that long to where they are put
  Playback playback_ = {};
  double played_since_ = 0.0;  // s on the clock
  double due_ = 0.0;           // s on the clock: when moving things are to be felt anew
  FeltServos& servos_;
  realtime::LatestValue<FeltVersion>& newest_;
  FeltVersion published_ = {};
  std::vector<haptics::PlacedEffect> published_effects_ = {};
  std::shared_ptr<const std::vector<std::string>> remarks_ = nullptr;
};

}  // namespace icome::session
