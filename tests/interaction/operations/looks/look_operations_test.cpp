// Colour, material and feel, as scripts say them.
#include <algorithm>
#include <cmath>

#include "interaction/operations/looks/colour_names.h"
#include "interaction/operations/looks/material_library.h"
#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

using LookOperations = ScriptedDesign;
using world::Colour;
using world::Material;

TEST_F(LookOperations, ColourIsSaidInThreeWays) {
  box("a", {0, 0, 0});
  run(R"({"op": "colour", "objects": "a", "colour": [0.25, 0.5, 1]})");
  EXPECT_EQ(material("a").diffuse, (Colour{0.25F, 0.5F, 1.0F}));
  run(R"({"op": "colour", "objects": "a", "colour": "#FF0080"})");
  EXPECT_EQ(material("a").diffuse, (Colour{1.0F, 0.0F, 128.0F / 255.0F}));
  run(R"({"op": "colour", "objects": "a", "colour": "Navy"})");
  EXPECT_EQ(material("a").diffuse, (Colour{0.0F, 0.0F, 128.0F / 255.0F}));
  EXPECT_EQ(design().materials().size(), 1U);
}

TEST_F(LookOperations, OthersKeepTheirColourUnlessToldOtherwise) {
  for (const char* name : {"a", "b", "c"}) box(name, {0, 0, 0});
  run(R"({"op": "material", "objects": ["a", "b", "c"], "name": "wood"})");
  const Colour wood = library_material("wood")->diffuse;
  run(R"({"op": "colour", "objects": ["a", "b"], "colour": "red"})");
  EXPECT_EQ(find("a").material, find("b").material);
  EXPECT_EQ(material("a").name, "wood 2");
  EXPECT_EQ(material("a").touch, material("c").touch);
  EXPECT_EQ(material("c").diffuse, wood);
  run(R"({"op": "colour", "objects": "a", "colour": "lime", "shared": true})");
  EXPECT_EQ(material("b").diffuse, (Colour{0, 1, 0}));
  EXPECT_EQ(material("c").diffuse, wood);
  // Both have it, and nobody else: it is changed where it is.
  run(R"({"op": "colour", "objects": ["b", "a"], "colour": "blue"})");
  EXPECT_EQ(design().materials().size(), 2U);
}

TEST_F(LookOperations, AGroupStandsForAllBelowIt) {
  box("a", {0, 0, 0});
  box("b", {1, 0, 0});
  run(R"({"op": "group", "objects": ["a", "b"], "name": "pair"})");
  run(R"({"op": "colour", "objects": ["pair", "a"], "colour": "teal"})");
  EXPECT_EQ(find("a").material, find("b").material);
  EXPECT_EQ(material("a").users, 2U);
  EXPECT_FALSE(find("pair").material);
}

TEST_F(LookOperations, AMaterialIsOneOfTheDesignOrElseOfTheLibrary) {
  box("a", {0, 0, 0});
  box("b", {0, 0, 0});
  run(R"({"op": "material", "objects": "a", "name": "rubber"})");
  run(R"({"op": "material", "objects": "b", "name": "rubber"})");
  EXPECT_EQ(find("a").material, find("b").material);
  Material rubber = *library_material("rubber");
  rubber.users = 2;
  EXPECT_EQ(material("a"), rubber);
}

TEST_F(LookOperations, FeelChangesWhatIsSaidOnly) {
  box("a", {0, 0, 0});
  run(R"({"op": "material", "objects": "a", "name": "wood"})");
  run(R"({"op": "feel", "objects": "a", "friction": [0.9, 0.7]})");
  world::TouchProperties expected = library_material("wood")->touch;
  expected.static_friction = 0.9;
  expected.dynamic_friction = 0.7;
  EXPECT_EQ(material("a").touch, expected);
  run(R"({"op": "feel", "objects": "a", "stiffness": 750, "damping": 3, "texture": "bumps"})");
  EXPECT_EQ(material("a").touch, (world::TouchProperties{750.0, 3.0, 0.9, 0.7, "bumps"}));
  run(R"({"op": "feel", "objects": "a", "texture": "smooth"})");
  EXPECT_EQ(material("a").touch.texture, "");
}

/// People tell stiffnesses apart that differ by 23 % (Jones and Hunter 1990): any two materials of the
/// library differ by more, and in friction or texture as well.
TEST(MaterialLibrary, FeelsDifferent) {
  const auto ratio = [](double a, double b) { return std::max(a, b) / std::min(a, b); };
  for (const char* name : {"wood", "rubber", "ice", "skin", "metal"})
    EXPECT_TRUE(library_material(name)) << name;
  const std::vector<Material>& library = material_library();
  for (std::size_t i = 0; i < library.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto& one = library[i].touch;
      const auto& other = library[k].touch;
      const std::string pair = library[i].name + " and " + library[k].name;
      EXPECT_GT(ratio(*one.stiffness, *other.stiffness), 1.23) << pair;
      EXPECT_TRUE(ratio(one.dynamic_friction, other.dynamic_friction) > 1.15 || one.texture != other.texture)
          << pair;
      EXPECT_NE(library[i].diffuse, library[k].diffuse) << pair;
    }
  }
}

TEST(MaterialLibrary, HoldsWhatAWorldTakes) {
  world::World world;
  world::IdSource ids;
  for (const Material& material : material_library()) {
    world::applied(world, world::CreateMaterial{ids.next<world::MaterialId>(), material});
    EXPECT_GE(*material.touch.stiffness, 300.0) << material.name;  // what devices render
    EXPECT_LE(*material.touch.stiffness, 4000.0) << material.name;
    const auto& textures = haptic_texture_names();
    EXPECT_TRUE(material.touch.texture.empty() ||
                std::ranges::find(textures, material.touch.texture) != textures.end())
        << material.name;
  }
}

TEST(ColourNames, AreReadBack) {
  EXPECT_EQ(colour_names().size(), 148U) << "CSS Color 4, 6.1";
  for (const std::string& name : colour_names()) EXPECT_TRUE(colour_from_text(name)) << name;
  EXPECT_EQ(colour_from_text("orange").value(), (Colour{1.0F, 165.0F / 255.0F, 0.0F}));
  EXPECT_EQ(colour_from_text("#00ff7f").value(), (Colour{0.0F, 1.0F, 127.0F / 255.0F}));
  for (const char* text :
       {"", "#", "#12345", "#1234567", "#12345g", "#-12345", "0x123456", "redd", "transparent"})
    EXPECT_FALSE(colour_from_text(text)) << text;
  EXPECT_EQ(colour_from_text("golden").error().message, "there is no colour 'golden'; did you mean 'gold'?");
}

TEST(ColourNames, MeanTheSameAsInCss) {
  const std::pair<const char*, const char*> same[] = {
      {"aqua", "#00ffff"},   {"black", "#000000"},  {"blue", "#0000ff"},   {"fuchsia", "#ff00ff"},
      {"gray", "#808080"},   {"green", "#008000"},  {"lime", "#00ff00"},   {"maroon", "#800000"},
      {"navy", "#000080"},   {"olive", "#808000"},  {"orange", "#ffa500"}, {"purple", "#800080"},
      {"red", "#ff0000"},    {"silver", "#c0c0c0"}, {"teal", "#008080"},   {"white", "#ffffff"},
      {"yellow", "#ffff00"}, {"Gold", "#ffd700"},   {"indigo", "#4b0082"}, {"lightGrey", "#d3d3d3"}};
  for (const auto& [name, digits] : same)
    EXPECT_EQ(colour_from_text(name).value(), colour_from_text(digits).value()) << name;
}

TEST_F(LookOperations, RefuseWhatMakesNoSense) {
  box("a", {0, 0, 0});
  box("b", {1, 0, 0});
  run(R"({"op": "group", "objects": "b", "name": "g"})");
  run(R"({"op": "delete", "objects": "b"})");
  expect_refused(
      {{R"({"op": "colour", "objects": "a"})", "'colour' is missing"},
       {R"({"op": "colour", "objects": "a", "colour": "rad"})", "did you mean 'red'"},
       {R"({"op": "colour", "objects": "a", "colour": [1, 0]})", "must be red, green and blue"},
       {R"({"op": "colour", "objects": "a", "colour": [1, 0, 255]})", "must be red, green and blue"},
       {R"({"op": "colour", "objects": "a", "colour": [1, 0, "x"]})", "must be red, green and blue"},
       {R"({"op": "colour", "objects": "a", "colour": 7})", "must be red, green and blue"},
       {R"({"op": "colour", "objects": "g", "colour": "red"})", "'g' has no shape"},
       {R"({"op": "material", "objects": "a", "name": "wod"})", "did you mean 'wood'"},
       {R"({"op": "feel", "objects": "a"})", "say how it feels"},
       {R"({"op": "feel", "objects": "a", "stiffness": -1})", "between 0 and"},
       {R"({"op": "feel", "objects": "a", "friction": [0.3]})", "two numbers"},
       {R"({"op": "feel", "objects": "a", "friction": [0.3, 0.4]})", "no more"},
       {R"({"op": "feel", "objects": "a", "friction": [99, 0]})", "between 0 and 10"},
       {R"({"op": "feel", "objects": "a", "texture": "fur"})", "one of smooth"}});
}

}  // namespace
}  // namespace icome::interaction
