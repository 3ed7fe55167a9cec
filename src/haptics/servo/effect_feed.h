#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/effects/effect.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

/// An effect of a design, where its object is.
struct PlacedEffect {
  std::uint64_t id = 0;  // of its object
  std::string text;      // for make_effect(), which takes it
  base::Pose world_from_effect = base::Pose::Identity();

  bool operator==(const PlacedEffect& other) const {
    return id == other.id && text == other.text &&
           world_from_effect.matrix() == other.world_from_effect.matrix();
  }
};

/// Brings the effects of a design from one thread (main) to the servo: a latest-value box, so neither waits.
/// An effect lives as long as the box may show it; only publish() frees one, so the servo never does, and
/// however many versions the servo missed, the box holds three.
class EffectFeed {
 public:
  /// Makes these the ones that are felt. One whose object and text were among the last goes on, wherever it
  /// is now: what is stuck in dry friction stays stuck. The main thread calls this.
  void publish(const std::vector<PlacedEffect>& effects);

  /// Goes over to the newest ones. The servo calls this once a tick. Real-time safe.
  void follow() { newest_.update(); }
  /// Their sum. The servo calls this at most once a tick. Real-time safe.
  Vector3 force(const EffectInput& input);
  /// They forget what they felt; see Effect::reset. The servo calls this. Real-time safe.
  void reset();

 private:
  /// An effect that others of the same object and text share.
  struct Member {
    PlacedEffect placed;
    std::shared_ptr<Effect> effect;  // never null
  };
  using Members = std::vector<Member>;
  std::shared_ptr<Effect> effect_of(const PlacedEffect& placed) const;

  Members published_;  // main's own copy of the newest
  realtime::LatestValue<Members> newest_;
};

}  // namespace icome::haptics
