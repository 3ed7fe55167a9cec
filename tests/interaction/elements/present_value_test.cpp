#include "interaction/elements/present_value.h"

#include <string>

#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

class PresentValue : public ScriptedDesign {
 protected:
  Value of(std::string_view object, std::string_view operation, std::string_view argument) const {
    return present_value(design(), id(object), operation, argument);
  }
};

TEST_F(PresentValue, IsWhatTheOperationWasGiven) {
  run(R"({"op": "create", "shape": "cone", "radius": 0.3, "height": 0.7, "name": "cone"})");
  EXPECT_EQ(of("cone", "reshape", "radius"), Value(0.3));
  EXPECT_EQ(of("cone", "reshape", "height"), Value(0.7));
  run(R"({"op": "reshape", "object": "cone", "radius": 0.125})");
  EXPECT_EQ(of("cone", "reshape", "radius"), Value(0.125));
  run(R"({"op": "colour", "objects": "cone", "colour": "#2f9e8a"})");
  EXPECT_EQ(of("cone", "colour", "colour"), Value("#2f9e8a"));
  run(R"({"op": "feel", "objects": "cone", "stiffness": 700, "damping": 3, "texture": "bumps"})");
  EXPECT_EQ(of("cone", "feel", "stiffness"), Value(700.0));
  EXPECT_EQ(of("cone", "feel", "damping"), Value(3.0));
  EXPECT_EQ(of("cone", "feel", "texture"), Value("bumps"));
  run(R"({"op": "place", "object": "cone", "factor": 2.5})");
  EXPECT_NEAR(*of("cone", "place", "factor").number(), 2.5, 1e-12);
  run(R"({"op": "material", "objects": "cone", "name": "wood"})");
  EXPECT_EQ(of("cone", "material", "name"), Value("wood"));
}

TEST_F(PresentValue, OfAGroupIsThatOfTheFirstShapeBelow) {
  box("a", {0, 0, 0});
  box("b", {2, 0, 0});
  run(R"({"op": "colour", "objects": "a", "colour": "#112233"})");
  run(R"({"op": "group", "objects": ["a", "b"], "name": "both"})");
  EXPECT_EQ(of("both", "colour", "colour"), Value("#112233"));
}

TEST_F(PresentValue, IsNothingWhereTheObjectHasNone) {
  box("a", {0, 0, 0});
  EXPECT_TRUE(of("a", "reshape", "radius").is_null());
  EXPECT_TRUE(of("a", "material", "name").is_null());
  EXPECT_TRUE(of("a", "create", "shape").is_null());
  EXPECT_TRUE(of("a", "no-such", "colour").is_null());
  EXPECT_EQ(of("a", "feel", "texture"), Value("smooth"));
  run(R"({"op": "create", "shape": "group", "name": "empty"})");
  EXPECT_TRUE(of("empty", "colour", "colour").is_null());
  run(R"({"op": "place", "object": "a", "scale": [1, 2, 1]})");
  EXPECT_TRUE(of("a", "place", "factor").is_null());
}

}  // namespace
}  // namespace icome::interaction
