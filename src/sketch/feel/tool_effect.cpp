#include "sketch/feel/tool_effect.h"

#include <algorithm>

#include "haptics/effects/surface_force.h"

namespace icome::sketch {
namespace {

constexpr double kMostHardness = 1500.0;  // N/m: harder than a hand tells apart where it sets in
constexpr double kLittleEnergy = 5e-6;    // J, below which a turn gives back less and less
constexpr double kDamping = 0.3;          // N s/m, if that is enough to be stable

}  // namespace

base::Vector3 ToolEffect::force(const haptics::EffectInput& input) {
  const Vector2 place = input.position.head<2>();
  if (hardness_ == 0.0) return base::Vector3::Zero();
  const double wanted = std::min(hardness_, kMostHardness);
  ToolGrip felt = grip_;
  felt.softness *= haptics::stable_stiffness(input.device_mass, input.dt, wanted) / hardness_;
  const ToolForce tool = tool_force(felt, place);
  const Vector2 force = tool.force - tool.of_turn + passive(tool.of_turn, place);
  const double damping = haptics::stable_damping(tool.hardness, input.device_mass, input.dt, kDamping);
  const Vector2 sum = force - damping * input.velocity.head<2>();
  return {sum.x(), sum.y(), 0.0};
}

/// As much of the force against a turn as what it has taken pays for.
Vector2 ToolEffect::passive(const Vector2& of_turn, const Vector2& place) {
  Memory& memory = *memory_;
  const Vector2 way = memory.is_felt ? Vector2(place - memory.place) : Vector2(Vector2::Zero());
  memory.store -= memory.given.dot(way);
  const double paid = std::clamp(memory.store / kLittleEnergy, 0.0, 1.0);
  memory.given = of_turn.dot(way) > 0.0 ? Vector2(paid * of_turn) : of_turn;
  memory.place = place;
  memory.is_felt = true;
  return memory.given;
}

void ToolEffect::reset() { *memory_ = {}; }

/// While the same is held at the same place, only what attracts the pen has changed.
void ToolEffect::continue_from(const Effect& before) {
  const auto* const last = dynamic_cast<const ToolEffect*>(&before);
  if (last != nullptr && last->grip_.start == grip_.start && last->grip_.centre == grip_.centre)
    memory_ = last->memory_;
}

double ToolEffect::mass_needed(double device_mass, double dt) const {
  if (hardness_ == 0.0) return 0.0;
  return haptics::mass_needed(std::min(hardness_, kMostHardness), kDamping, device_mass, dt);
}

}  // namespace icome::sketch
