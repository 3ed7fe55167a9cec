#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/contact/motion.h"
#include "haptics/effects/effect.h"
#include "haptics/servo/scene_feed.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

/// An effect of a design, where its object is and how that moves.
struct PlacedEffect {
  std::uint64_t id = 0;  // of its object; 0: it has none
  std::string text;      // for make_effect(), which takes it
  base::Pose world_from_effect = base::Pose::Identity();
  Motion motion = {};
  bool mirrored = false;  // its own x is turned round before its place turns it

  bool operator==(const PlacedEffect& other) const {
    return id == other.id && text == other.text &&
           world_from_effect.matrix() == other.world_from_effect.matrix() && motion == other.motion &&
           mirrored == other.mirrored;
  }
};

/// Where it acts while it stays there, world frame.
Reach reach_in_world(const PlacedEffect& placed, const Effect& effect);

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
  /// Over so long an effect goes, evenly, to where its object was put: longer than main takes from one edit
  /// to the next while something is dragged, so that the force has no steps.
  static constexpr double kGlideSeconds = 0.02;  // s
  /// What an effect gives goes over to what its changed numbers ask for no faster than by all that the device
  /// has in so long: a slider that is thrown to its end is felt at once, and does not kick.
  static constexpr double kEaseSeconds = 0.05;  // s

  /// Effects share what is stable on this device; see mass_shares.h.
  explicit EffectFeed(const DeviceLimits& limits = {}) : limits_(limits) {}

  /// Makes these the ones that are felt. One whose object was among the last goes on, wherever it is now and
  /// with whatever numbers: what is stuck in dry friction stays stuck, where it is, and its force goes over
  /// to the changed one without a step (kEaseSeconds). The main thread calls this.
  void publish(const std::vector<PlacedEffect>& effects);

  /// Of these, those that the device cannot render stably as they were asked for, beside forces that need
  /// `beside` kg of its mass. The main thread calls this.
  std::vector<CappedEffect> capped(double beside) const;
  /// mass_needed() of these. The main thread calls this.
  double published_mass_needed() const { return published_.mass_needed; }

  /// Goes over to the newest ones, and on by `dt` (s). What an effect remembers stays in the world where it
  /// is when its object is put elsewhere, and goes along with a motion. The servo calls this once a tick.
  /// Real-time safe.
  void follow(double dt);
  /// Their sum, beside forces that need `beside` kg of the device's mass. The servo calls this at most once a
  /// tick. Real-time safe.
  Vector3 force(const EffectInput& input, double beside);
  /// How much of the device's mass (kg) effects need at one place, where that is most. Real-time safe.
  double mass_needed() const { return newest_.read().mass_needed; }
  /// They forget what they felt; see Effect::reset. The servo calls this. Real-time safe.
  void reset();

 private:
  /// Where effects of one object are felt, and what they give; the servo's. World frame.
  struct Whereabouts {
    base::Pose at;                    // in the last tick
    base::Pose put;                   // where its object was put last
    double left = 0.0;                // s, until it is there
    Motion goes_on = {};              // of the last tick, for one more
    bool felt = false;                // has it given a force since it was placed or reset?
    double share = 0.0;               // kg, its piece of the device in the last tick
    Vector3 gave = Vector3::Zero();   // N, in the last tick
    Vector3 still = Vector3::Zero();  // N, what is left of what it gave before it was changed
  };
  /// An effect that versions with the same object, text and mirror share.
  struct Felt {
    std::unique_ptr<Effect> effect;            // never null
    std::shared_ptr<Whereabouts> whereabouts;  // never null
    bool changed = false;                      // its numbers, and not felt since; the servo's once published
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
  void bring(const Member& member, double dt, bool newer);
  Vector3 eased(Felt& felt, const Vector3& asked, const EffectInput& own) const;

  DeviceLimits limits_;
  Version published_;  // main's own copy of the newest
  realtime::LatestValue<Version> newest_;
  double elapsed_ = 0.0;  // s, since the newest were taken; the servo's
};

}  // namespace icome::haptics
