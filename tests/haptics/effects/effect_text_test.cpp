#include "haptics/effects/effect_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

namespace icome::haptics {
namespace {

std::unique_ptr<Effect> effect_said(const std::string& text) {
  auto made = make_effect(text);
  EXPECT_TRUE(made.has_value()) << text;
  return std::move(*made);
}

EffectInput said_tip(const Vector3& position, const Vector3& velocity = Vector3::Zero()) {
  EffectInput input;
  input.position = input.scp = position;
  input.velocity = velocity;
  return input;
}

// Each number has its place in the text. Forces are worked out by hand.
TEST(EffectText, SaysWhereAndHowHardAnEffectIs) {
  struct Case {
    std::string text;
    Vector3 position, velocity, force;
  };
  const double peak = 0.02 / std::sqrt(5.0);  // m, where a well of 20 mm pulls most
  for (const Case& it : std::initializer_list<Case>{
           {"point:0.01,0,0,200,2", {0, 0.01, 0}, {0, 0, 0.5}, {2, -2, -1}},
           {"line:0,0,0.01,5,0,0,200,2", {0.3, 0.01, 0}, {1, 0.5, 0}, {0, -3, 2}},
           {"plane:0,0,0.01,0,0,2,200,2", {0.3, 0.2, 0.02}, {1, 1, 0.1}, {0, 0, -2.2}},
           {"curve:0,0,0;0.1,0,0;0.1,0.1,0;200,2", {0.05, 0, 0.01}, {1, 0, 0.1}, {0, 0, -2.2}},
           {"viscous:3", {1, 2, 3}, {0.1, 0, -0.2}, {-0.3, 0, 0.6}},
           {"well:0,0,0.1,0.02,1.5", {peak, 0, 0.1}, {0, 0, 0}, {-1.5, 0, 0}},
           {"recess:0.1,0,0,0,0,3,0.008,0.012,1.5", {0.1, 0.010, 0.2}, {0, 0, 0}, {0, -1.5, 0}},
           {"constant:0.1,-0.2,0.3", {1, 2, 3}, {4, 5, 6}, {0.1, -0.2, 0.3}},
           {"field:10*x,y,2", {0.05, 0.5, 7}, {0, 0, 0}, {0.5, 0.5, 2}}}) {
    const Vector3 force = effect_said(it.text)->force(said_tip(it.position, it.velocity));
    EXPECT_NEAR((force - it.force).norm(), 0.0, 1e-9) << it.text << ": " << force.transpose();
  }
}

TEST(EffectText, SaysHowFrictionSticksAndSlides) {
  const auto friction = effect_said("friction:0.5,0.3,1000");
  friction->force(said_tip(Vector3::Zero()));
  EXPECT_NEAR(friction->force(said_tip({4e-4, 0, 0})).x(), -0.4, 1e-9) << "below the static force";
  EXPECT_NEAR(friction->force(said_tip({6e-4, 0, 0})).x(), -0.3, 1e-9) << "above it";
}

TEST(EffectText, SaysHowHeavyAndHowQuickInertiaIs) {
  const auto inertia = effect_said("inertia:0.1,20");
  inertia->force(said_tip(Vector3::Zero()));
  const double answered = 1.0 - std::exp(-2.0 * M_PI * 20.0 * 1e-3);
  EXPECT_NEAR(inertia->force(said_tip(Vector3::Zero(), {2e-3, 0, 0})).x(), -0.1 * 2.0 * answered, 1e-9);
}

}  // namespace
}  // namespace icome::haptics
