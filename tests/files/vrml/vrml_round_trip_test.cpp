// Designs through VRML 2.0 files and back.
#include <gtest/gtest.h>

#include <set>

#include "files/design_files.h"
#include "files/design_maker.h"
#include "files/pictures/picture_bytes.h"
#include "files/same_design.h"
#include "files/sample_files.h"
#include "files/vrml/read/vrml_reader.h"
#include "files/vrml/vrml_fixtures.h"
#include "files/vrml/write/vrml_writer.h"
#include "io/file_bytes.h"
#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::files {
namespace {

using namespace world;
namespace fs = std::filesystem;

World read(const fs::path& path) {
  auto design = read_design(path);
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(design->world);
}

std::string text_of_file(const fs::path& path, const World& world) {
  const auto remarks = write_vrml(path, world);
  if (!remarks) throw std::runtime_error(remarks.error().message);
  return io::read_bytes(path, 1U << 30U).value();
}

/// What went through a file once is the same whenever it does so again, to the last byte.
void expect_stays(const World& once, const fs::path& path) {
  const std::string text = text_of_file(path, once);
  const World twice = read(path);
  EXPECT_EQ(difference(once, twice, {.tolerance = 0.0}), "");
  EXPECT_EQ(text_of_file(path, twice), text);
}

/// The design after it went through a file. VRML 2.0 has directional lights for groups alone, which writing
/// tells.
World through_file(const World& world,
                   const Likeness& likeness = {.tolerance = 3e-6, .recipes = false, .scopes = false}) {
  const ScratchFolder folder;
  const fs::path path = folder.path() / "design.wrl";
  text_of_file(path, world);
  World once = read(path);
  EXPECT_EQ(difference(world, once, likeness), "");
  expect_stays(once, path);
  return once;
}

TEST(VrmlRoundTrip, EveryKindOfShape) {
  DesignMaker design;
  for (const GeometryPointer& shape : every_shape()) {
    if (shape->bounds().isEmpty() && shape->kind() == "mesh") continue;
    design.add("shape of kind " + std::string(shape->kind()), shape);
  }
  through_file(design.world);
}

TEST(VrmlRoundTrip, NamesTitlesAndMaterials) {
  DesignMaker design;
  for (const char* name :
       {"left door", "door", "door", "2nd", "w\xc3\xb6od", "USE", "a+b", "a+1", "IcomeUnnamed", "say \"\\\"",
        "", "IcomeDefault", "Transform", "line\nbreak", " ", "_"}) {
    const ObjectId object = design.add(name, design.world.objects().size() % 2 == 0 ? box(1.0) : nullptr);
    const MaterialId material = design.ids.next<MaterialId>();
    Material rich = rich_material({});
    rich.name = std::string(name).starts_with("Icome") ? "plain" : name;
    rich.ambient = 0.0F;
    applied(design.world, CreateMaterial{material, design.world.objects().size() % 3 == 0
                                                       ? rich
                                                       : Material{.name = rich.name, .shininess = 0.5F}});
    applied(design.world, ChooseMaterial{object, material});
    if (design.world.objects().size() % 4 == 0)
      applied(design.world, ChooseMaterial{design.add("", box(0.1), object), material});
  }
  through_file(design.world);
}

TEST(VrmlRoundTrip, LightsViewpointsScriptsAndScenes) {
  DesignMaker design;
  const ObjectId room = design.add("room", box(3.0));
  const ObjectId lamp =
      design.add("the lamp", box(0.1), room, at(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.3, Vector3::UnitX()));
  applied(design.world, ChangeFixture{lamp, spot_light()});
  for (const Light::Kind kind : {Light::Kind::Directional, Light::Kind::Point, Light::Kind::Spot})
    applied(design.world, ChangeFixture{design.add("", nullptr, room),
                                        std::make_shared<const Fixture>(Light{.kind = kind})});
  const ObjectId eye = design.add("from the door", nullptr, {}, at(0.0, 1.6, 3.0));
  applied(design.world, ChangeFixture{eye, std::make_shared<const Fixture>(Viewpoint{1.2})});
  for (const bool on : {true, false}) {
    const ObjectId pull = design.add(on ? "pull" : "", on ? box(0.1) : nullptr, room, at(0.2, 0.0, 0.1));
    applied(design.world,
            ChangeFixture{pull, std::make_shared<const Fixture>(ForceEffect{"point:0,0,0", on})});
  }
  const ObjectId script = design.add("logic", nullptr);
  applied(design.world, ChangeFixture{script, std::make_shared<const Fixture>(
                                                  Inert{"Script", "DEF logic Script {\n  url \"a\"\n}"})});
  const SceneId one = design.ids.next<SceneId>(), two = design.ids.next<SceneId>();
  applied(design.world, CreateScene{one, "the room"});
  applied(design.world, CreateScene{two, "lights"});
  applied(design.world, EnterScene{one, room, 0});
  for (std::size_t i = 0; i < design.world.find(room)->children.size(); ++i)
    applied(design.world, EnterScene{two, design.world.find(room)->children[i], 0});
  through_file(design.world);
}

TEST(VrmlRoundTrip, DirectionsOfLights) {
  base::Random random(6);
  DesignMaker design;
  for (int i = 0; i < 4'000; ++i) {
    const Vector3 direction(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    Affine3 frame = Affine3::Identity();
    frame.linear() = facing(direction);
    const ObjectId sun = design.add("", nullptr, {}, frame);
    applied(design.world, ChangeFixture{sun, std::make_shared<const Fixture>(
                                                 Light{.kind = Light::Kind::Directional, .scoped = true})});
  }
  through_file(design.world);
}

TEST(VrmlRoundTrip, AnyTransform) {
  base::Random random(5);
  DesignMaker design;
  ObjectId parent;
  for (int i = 0; i < 500; ++i) {
    Affine3 frame = Affine3::Identity();
    for (int k = 0; k < 12; ++k) frame(k / 4, k % 4) = random.uniform(-1.0, 1.0);
    design.add("", nullptr, i % 3 == 0 ? ObjectId{} : parent, frame);
    parent = design.world.roots().back();
  }
  through_file(design.world);
}

TEST(VrmlRoundTrip, Pictures) {
  const std::string pixels("\xff\0\0\0\xff\0", 6);
  const auto png = png_of({1, 2, 3, pixels});
  ASSERT_TRUE(png);
  DesignMaker design;
  const auto paint = [&](const std::string& name, const std::string& bytes, const std::string& type,
                         std::array<bool, 2> repeats) {
    const TextureId picture = design.ids.next<TextureId>();
    applied(design.world,
            CreateTexture{picture, {name, type, std::make_shared<std::string>(bytes), repeats}});
    for (int i = 0; i < 2; ++i) {
      const MaterialId material = design.ids.next<MaterialId>();
      applied(design.world, CreateMaterial{material, {.name = i == 0 ? "" : name, .texture = picture}});
      applied(design.world, ChooseMaterial{design.add(name, textured_mesh()), material});
      applied(design.world, ChooseMaterial{design.add(name, box(1.0)), material});
    }
  };
  paint("wood", *png, "image/png", {true, false});
  paint("maps/a b.jpeg", "\xff\xd8\xff\xe0 picture", "image/jpeg", {false, true});
  paint("../c.gif", "GIF89a picture", "image/gif", {true, true});
  const World world = through_file(design.world, {.tolerance = 3e-6, .texture_names = false});
  std::set<std::string> names;
  for (const auto& [id, texture] : world.textures()) names.insert(texture.name);
  EXPECT_EQ(names, (std::set<std::string>{"design_textures/wood.png", "design_textures/a_b.jpeg",
                                          "design_textures/c.gif"}));
}

TEST(VrmlRoundTrip, TwoTablesOfFigure29) {
  DesignMaker design;
  const ObjectId table = design.add("table", box(1.0));
  const ObjectId leg = design.add("leg", one_triangle(), table, at(0.4, -0.5, 0.4));
  for (int i = 0; i < 3; ++i) duplicated(design.world, design.ids, leg, Duplicate::CloneObject, table);
  duplicated(design.world, design.ids, table, Duplicate::CopyObjectAndChildren);
  World world = through_file(design.world);
  ASSERT_EQ(world.roots().size(), 2U);
  const auto legs = [&](std::size_t which) { return world.find(world.roots()[which])->children; };
  ASSERT_EQ(legs(0).size(), 4U);
  ASSERT_EQ(legs(1).size(), 4U);
  applied(world, ReplaceGeometry{world.find(legs(1)[2])->geometry, box(0.25)});
  for (const ObjectId it : legs(0)) EXPECT_EQ(world.find(world.find(it)->geometry)->shape->kind(), "mesh");
  for (const ObjectId it : legs(1))
    EXPECT_EQ(world.find(world.find(it)->geometry)->shape->kind(), "primitive");
}

TEST(VrmlRoundTrip, FlatFacesWithoutCreasesAreTheSameFileTheFirstTime) {
  for (const std::size_t faces : {1U, 2U}) {
    geometry::TriangleMesh mesh;
    mesh.positions = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.0}, {0.0, 0.1, 0.0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangles.resize(faces);
    mesh.positions.resize(faces + 2);
    auto shape = std::make_shared<MeshGeometry>(mesh);
    const Vector3 up(0.0, 0.0, 1.0);
    shape->normals.assign(faces, {up, up, up});
    DesignMaker design;
    design.add("face", shape);
    const ScratchFolder folder;
    const std::string first = text_of_file(folder.path() / "a.wrl", design.world);
    EXPECT_EQ(text_of_file(folder.path() / "b.wrl", read(folder.path() / "a.wrl")), first);
  }
}

}  // namespace
}  // namespace icome::files
