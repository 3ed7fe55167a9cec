// Effects as scripts make them, and the dials that people turn of their numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "interaction/operations/looks/effect_making.h"
#include "interaction/operations/looks/material_library.h"
#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

using EffectOperation = ScriptedDesign;

TEST_F(EffectOperation, MakesAnEffectWhereItIsToStand) {
  run(R"({"op": "effect", "name": "wind", "force": "constant:1,0,0", "at": [1, 2, 3], "turn": [0, 0, 90]})");
  const auto& effect = std::get<world::ForceEffect>(*find("wind").fixture);
  EXPECT_EQ(effect.text, "constant:1,0,0");
  EXPECT_TRUE(effect.on);
  EXPECT_EQ(find("wind").parent_from_object * Vector3(1, 0, 0), Vector3(1, 3, 3));
}

TEST_F(EffectOperation, RefusesWhatMeansNothingForIt) {
  expect_refused({{R"({"op": "effect", "force": "viscous:1", "material": "wood"})", "no 'material'"},
                  {R"({"op": "effect", "force": "viscous:1", "scale": [2, 2, 2]})", "no 'scale'"},
                  {R"({"op": "effect", "force": "viscous:1", "factor": 2})", "no 'factor'"},
                  {R"({"op": "effect", "force": "wel:1"})", "did you mean 'well'"}});
}

TEST_F(EffectOperation, EveryTextureIsFeltInItsUsualSize) {
  box("a", {0, 0, 0});
  for (const std::string& texture : haptic_texture_names()) {
    run(R"({"op": "feel", "objects": "a", "texture": ")" + texture + R"("})");
    EXPECT_EQ(material("a").touch.texture, texture);
    EXPECT_TRUE(texture_words(texture).starts_with(texture + ", 0.")) << texture_words(texture);
  }
  EXPECT_TRUE(std::ranges::count(haptic_texture_names(), "ridges") == 1);
  EXPECT_EQ(texture_words("ridges:0.0005,0.002"), "ridges, 0.5 mm deep every 2 mm");
  EXPECT_EQ(texture_words("velvet"), "");
}

TEST(EffectDials, AreOfEveryKindThatHasNumbersAlone) {
  std::set<std::string> kinds;
  for (const EffectDial& dial : effect_dials()) {
    kinds.insert(dial.kind);
    EXPECT_LT(dial.usual_least, dial.usual_most) << dial.kind << " " << dial.name;
    EXPECT_GE(dial.usual_least, dial.least);
    EXPECT_LE(dial.usual_most, dial.most);
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"constant", "friction", "inertia", "line", "plane", "point",
                                          "recess", "viscous", "well"}));
}

TEST(EffectDials, ReadAndTurnOneNumber) {
  const auto dial = [](const std::string& kind, const std::string& name) {
    return *std::ranges::find_if(effect_dials(),
                                 [&](const EffectDial& it) { return it.kind == kind && it.name == name; });
  };
  const EffectDial radius = dial("well", "RADIUS");
  EXPECT_EQ(radius.unit, "m");
  EXPECT_EQ(dial_value(radius, "well:0,0,0.05,0.01,1.5"), 0.01);
  EXPECT_EQ(with_dial(radius, "well:0,0,0.05,0.01,1.5", 0.02), "well:0,0,0.05,0.02,1.5");
  EXPECT_FALSE(dial_value(radius, "viscous:2")) << "another kind";
  EXPECT_FALSE(dial_value(radius, "well:0,0")) << "no effect";
  EXPECT_FALSE(dial_value(radius, "wellness:0,0,0.05,0.01,1.5"));
  const EffectDial damping = dial("point", "DAMPING");
  EXPECT_EQ(dial_value(damping, "point:0,0,1"), 1.0) << "what is left out has its usual value";
  EXPECT_EQ(with_dial(damping, "point:0,0,1", 3), "point:0,0,1,200,3");
}

}  // namespace
}  // namespace icome::interaction
