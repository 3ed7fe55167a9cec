#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/effects/effect.h"
#include "haptics/servo/scene_feed.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

/// An effect of a design, where its object is.
struct PlacedEffect {
  std::uint64_t id = 0;  // of its object; 0: it has none
  std::string text;      // for make_effect(), which takes it
  base::Pose world_from_effect = base::Pose::Identity();

  bool operator==(const PlacedEffect& other) const {
    return id == other.id && text == other.text &&
           world_from_effect.matrix() == other.world_from_effect.matrix();
  }
};

/// An effect that is felt softer than it was asked for.
struct CappedEffect {
  std::uint64_t id = 0;  // of its object; 0: it has none
  std::string text;
  std::string what;  // "stiffness 5000 N/m is felt as 1000 N/m"

  bool operator==(const CappedEffect&) const = default;
};

/// Brings the effects of a design from one thread (main) to the servo: a latest-value box, so neither waits.
/// An effect lives as long as the box may show it; only publish() frees one, so the servo never does, and
/// however many versions the servo missed, the box holds three.
class EffectFeed {
 public:
  /// Effects share what is stable on this device; see mass_shares.h.
  explicit EffectFeed(const DeviceLimits& limits = {}) : limits_(limits) {}

  /// Makes these the ones that are felt. One whose object was among the last goes on, wherever it is now and
  /// with whatever numbers: what is stuck in dry friction stays stuck, where it is. The main thread calls
  /// this.
  void publish(const std::vector<PlacedEffect>& effects);

  /// Of these, those that the device cannot render stably as they were asked for, beside forces that need
  /// `beside` kg of its mass. The main thread calls this.
  std::vector<CappedEffect> capped(double beside) const;
  /// mass_needed() of these. The main thread calls this.
  double published_mass_needed() const { return published_.mass_needed; }

  /// Goes over to the newest ones. What an effect remembers stays in the world where it is when its object
  /// moves. The servo calls this once a tick. Real-time safe.
  void follow();
  /// Their sum, beside forces that need `beside` kg of the device's mass. The servo calls this at most once a
  /// tick. Real-time safe.
  Vector3 force(const EffectInput& input, double beside);
  /// How much of the device's mass (kg) effects need at one place, where that is most. Real-time safe.
  double mass_needed() const { return newest_.read().mass_needed; }
  /// They forget what they felt; see Effect::reset. The servo calls this. Real-time safe.
  void reset();

 private:
  /// An effect that versions with the same object and text share.
  struct Felt {
    std::unique_ptr<Effect> effect;                 // never null
    std::shared_ptr<base::Pose> world_from_effect;  // of its object, as it was felt last; the servo's
  };
  struct Member {
    PlacedEffect placed;
    std::shared_ptr<Felt> felt;  // never null
    double needs = 0.0;          // kg, of the device's mass
    double together = 0.0;       // kg, with all that may act where it does
  };
  struct Version {
    std::vector<Member> members;
    double mass_needed = 0.0;  // kg, the most of `together`
  };
  std::shared_ptr<Felt> felt_as(const PlacedEffect& placed) const;

  DeviceLimits limits_;
  Version published_;  // main's own copy of the newest
  realtime::LatestValue<Version> newest_;
};

}  // namespace icome::haptics
