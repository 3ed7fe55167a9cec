#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "haptics/contact/motion.h"
#include "haptics/effects/effect.h"
#include "haptics/effects/panel.h"
#include "haptics/servo/scene_feed.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

using MakeEffect = std::function<std::unique_ptr<Effect>()>;

/// An effect of a design, with the pose and the motion of its object.
struct PlacedEffect {
  std::uint64_t id = 0;  // of its object; 0: it has none
  std::string text;      // for make_effect(), which takes it; not read where there is a panel
  base::Pose world_from_effect = base::Pose::Identity();
  Motion motion = {};
  bool mirrored = false;                                 // its own x is negated before its pose is applied
  std::shared_ptr<const PanelSettings> panel = nullptr;  // the ground of an interface element
  /// Makes an effect that no text describes; null: there is a panel or a text. Called by the thread that
  /// publishes.
  std::shared_ptr<const MakeEffect> make = nullptr;

  /// Are these the same effect, wherever it is?
  bool same_effect(const PlacedEffect& other) const {
    return mirrored == other.mirrored && panel == other.panel && make == other.make && text == other.text;
  }
  bool operator==(const PlacedEffect& other) const {
    return id == other.id && same_effect(other) &&
           world_from_effect.matrix() == other.world_from_effect.matrix() && motion == other.motion;
  }
};

/// Region in which it acts while it stays there, world frame.
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
  /// Time in which an effect moves, evenly, to its object's new pose: longer than the main thread takes
  /// from one edit to the next while something is dragged, so that the force has no steps.
  static constexpr double kGlideSeconds = 0.02;  // s
  /// Time in which an effect's force may change by the device's maximum after its numbers were changed: a
  /// slider that is thrown to its end is felt at once, and does not kick.
  static constexpr double kEaseSeconds = 0.05;  // s

  /// Effects share the stable range of this device; see mass_shares.h.
  explicit EffectFeed(const DeviceLimits& limits = {}) : limits_(limits) {}

  /// Makes these the effects that are felt. One whose object was among the last continues, also at another
  /// place and with other numbers: a tip that is stuck in dry friction stays stuck, where it is, and the
  /// force changes without a step (kEaseSeconds). The main thread calls this.
  void publish(const std::vector<PlacedEffect>& effects);

  /// The published effects that the device cannot render stably in full, beside forces that need `beside`
  /// kg of its mass. The main thread calls this.
  std::vector<CappedEffect> capped(double beside) const;
  /// mass_needed() of the published effects. The main thread calls this.
  double published_mass_needed() const { return published_.mass_needed; }

  /// Adopts the newest effects and advances them by `dt` (s). The memory of an effect stays at its place in
  /// the world when its object is put elsewhere, and goes along with a motion. The servo calls this once a
  /// tick. Real-time safe.
  void follow(double dt);
  /// The sum of the effects' forces (N), beside forces that need `beside` kg of the device's mass. The servo
  /// calls this at most once a tick. Real-time safe.
  Vector3 force(const EffectInput& input, double beside);
  /// The most of the device's mass (kg) that effects need together at one place. Real-time safe.
  double mass_needed() const { return newest_.read().mass_needed; }
  /// Resets all effects; see Effect::reset. The servo calls this. Real-time safe.
  void reset();

 private:
  /// Pose and force of the effects of one object as they are felt; the servo's. World frame.
  struct Whereabouts {
    base::Pose at;                    // in the last tick
    base::Pose put;                   // pose that its object was given last
    double left = 0.0;                // s, until it arrives at `put`
    Motion goes_on = {};              // motion of the last tick, for one more
    bool rests = false;               // it is where it was put, without a motion
    bool felt = false;                // has it given a force since it was placed or reset?
    double share = 0.0;               // kg, its piece of the device in the last tick
    Vector3 gave = Vector3::Zero();   // N, in the last tick
    Vector3 still = Vector3::Zero();  // N, fading rest of its force before a change
  };
  /// An effect that versions with the same object, text and mirror share.
  struct Felt {
    std::unique_ptr<Effect> effect;            // never null
    std::shared_ptr<Whereabouts> whereabouts;  // never null
    bool changed = false;                      // its numbers, not felt since; the servo's once published
  };
  struct Member {
    PlacedEffect placed;
    std::shared_ptr<Felt> felt;  // never null
    double needs = 0.0;          // kg, of the device's mass
    double together = 0.0;       // kg, with all effects that may act at the same places
  };
  struct Version {
    std::vector<Member> members;
    double mass_needed = 0.0;  // kg, the most of `together`
  };
  std::shared_ptr<Felt> felt_as(const PlacedEffect& placed) const;
  void bring(const Member& member, double dt, bool newer);
  static bool passes_over(const Felt& felt, bool mirrored, const Vector3& tip);
  Vector3 eased(Felt& felt, const Vector3& asked, const EffectInput& own) const;
  Vector3 of_panels(const Vector3& asked, double dt);

  DeviceLimits limits_;
  Version published_;  // main's own copy of the newest
  realtime::LatestValue<Version> newest_;
  double elapsed_ = 0.0;              // s, since the newest were taken; the servo's
  Vector3 panels_ = Vector3::Zero();  // N, of all panels in the last tick; the servo's
};

}  // namespace icome::haptics
