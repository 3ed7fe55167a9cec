#include <gtest/gtest.h>

#include <fstream>

#include "drawing/shape/drawing_shape.h"
#include "files/design_files.h"
#include "files/sample_files.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {
namespace {

constexpr const char* kFish =
    "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='50mm' viewBox='0 0 100 50'>"
    "<path d='M10,25 C30,0 60,0 80,25 C60,50 30,50 10,25 Z' fill='orange' stroke='navy' stroke-width='2'/>"
    "<path d='M80,25 L95,10 M80,25 L95,40' fill='none' stroke='black'/><text>fish</text></svg>";

/// The only drawing of a design.
const drawing::DrawingShape& drawing_of(const world::World& world) {
  const drawing::DrawingShape* found = nullptr;
  for (const auto& [id, geometry] : world.geometries()) {
    if (const auto* const it = drawing::drawing_in(*geometry.shape)) found = it;
  }
  if (!found) throw std::runtime_error("there is no drawing");
  return *found;
}

LoadedDesign read_fish(const ScratchFolder& folder) {
  auto design = read_design(folder.write("fish.svg", kFish));
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(*design);
}

TEST(SvgDesign, IsADrawingOnItsSheetAndTellsWhatIsSkipped) {
  const ScratchFolder folder;
  const LoadedDesign design = read_fish(folder);
  EXPECT_EQ(design.format, "SVG");
  ASSERT_EQ(design.world.objects().size(), 1U);
  EXPECT_EQ(design.world.find(design.world.roots()[0])->name, "fish");
  const drawing::DrawingShape& shape = drawing_of(design.world);
  EXPECT_EQ(shape.drawing().stroke_count(), 3U);
  EXPECT_NEAR(shape.bounds().sizes().x(), 0.1, 1e-3);
  ASSERT_EQ(design.remarks.size(), 1U);
  EXPECT_NE(design.remarks[0].text.find("<text>"), std::string::npos);
}

TEST(SvgDesign, KeepsTheDrawingThroughEveryFormatThatKeepsShapes) {
  const ScratchFolder folder;
  const LoadedDesign design = read_fish(folder);
  const auto& shape = drawing_of(design.world);
  for (const char* name : {"fish.icome", "fish.wrl", "fish.glb", "fish.gltf", "again.svg"}) {
    const auto written = write_design(folder.path() / name, design.world);
    ASSERT_TRUE(written) << written.error().message;
    const auto back = read_design(folder.path() / name);
    ASSERT_TRUE(back) << name << back.error().message;
    const auto& read = drawing_of(back->world);
    EXPECT_EQ(read.body(), shape.body()) << name;
    ASSERT_EQ(read.drawing().stroke_count(), 3U) << name;
    for (std::size_t i = 0; i < 3; ++i) {
      const drawing::Stroke& a = *read.drawing().layers[0].strokes[i];
      const drawing::Stroke& b = *shape.drawing().layers[0].strokes[i];
      EXPECT_EQ(a.curve, b.curve) << name;
      EXPECT_EQ(a.colour, b.colour) << name;
      EXPECT_EQ(a.fill, b.fill) << name;
    }
  }
}

TEST(SvgDesign, OtherFormatsGetItsTriangles) {
  const ScratchFolder folder;
  const LoadedDesign design = read_fish(folder);
  const auto triangles = drawing_of(design.world).triangles(0.001);
  for (const char* name : {"fish.stl", "fish.obj", "fish.ply"}) {
    ASSERT_TRUE(write_design(folder.path() / name, design.world)) << name;
    const auto back = read_design(folder.path() / name);
    ASSERT_TRUE(back) << name;
    std::size_t read = 0;
    for (const auto& [id, geometry] : back->world.geometries())
      read += (*geometry.shape->triangles(0.001))->mesh.triangles.size();
    EXPECT_EQ(read, (*triangles)->mesh.triangles.size()) << name;
  }
}

TEST(SvgDesign, WritesOneDrawingOnly) {
  const ScratchFolder folder;
  const auto refused = write_design(folder.path() / "none.svg", world::World());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("none"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.svg"));
}

TEST(SvgDesign, WhatIsNoSvgIsToldByFileAndLine) {
  const ScratchFolder folder;
  const auto refused = read_design(folder.write("bad.svg", "<svg>\n<g>\n</svg>"));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("bad.svg:"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace icome::files
