#pragma once
#include <memory>

#include "haptics/effects/effect.h"
#include "sketch/feel/resistance.h"

namespace icome::sketch {

/// The resistance of a drawing to what a pen holds of it, as a device renders it: in the plane z = 0 of its
/// frame, no harder than is stable, with a damper for as much as it is hard, and never giving more energy
/// than it was given (near the centre of a turn its force has no potential).
class ToolEffect final : public haptics::Effect {
 public:
  /// `grip` in the effect's frame.
  explicit ToolEffect(const ToolGrip& grip) : grip_(grip), hardness_(greatest_hardness(grip)) {}

  base::Vector3 force(const haptics::EffectInput& input) override;
  bool is_idle_at(const base::Vector3& /*place*/) const override { return hardness_ == 0.0; }
  void reset() override;
  void continue_from(const Effect& before) override;
  double mass_needed(double device_mass, double dt) const override;

 private:
  /// The servo's, shared with the effect that this one continues.
  struct Memory {
    double store = 0.0;               // J, that the turn has taken and not given back
    Vector2 place = Vector2::Zero();  // m, in the last tick
    Vector2 given = Vector2::Zero();  // N, against the turn, since then
    bool is_felt = false;             // `place` is known
  };

  Vector2 passive(const Vector2& of_turn, const Vector2& place);

  ToolGrip grip_;
  double hardness_;  // N/m, at most
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();
};

}  // namespace icome::sketch
