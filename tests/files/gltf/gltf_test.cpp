// Designs through glTF files and back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "files/design_files.h"
#include "files/gltf/gltf_reader.h"
#include "files/pictures/picture_bytes.h"
#include "files/same_design.h"
#include "files/sample_files.h"
#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::files {
namespace {

using namespace world;

World through(const World& world, const std::string& name) {
  const ScratchFolder folder;
  const auto path = folder.path() / name;
  const auto written = write_design(path, world);
  if (!written) throw std::runtime_error(written.error().message);
  auto read = read_design(path);
  if (!read) throw std::runtime_error(read.error().message);
  return std::move(read->world);
}

constexpr Likeness kAsGltf{.tolerance = 1e-5};

TEST(Gltf, RandomWorldsComeBack) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomEdits edits(seed);
    World world;
    for (int i = 0; i < 120; ++i) (void)apply(world, edits.next(world));
    EXPECT_EQ(difference(world, through(world, "a.glb"), kAsGltf), "") << seed;
    if (seed < 5) {
      EXPECT_EQ(difference(world, through(world, "a.gltf"), kAsGltf), "") << seed;
    }
  }
}

TEST(Gltf, EveryKindOfThingComesBack) {
  World world;
  for (const Edit& edit : every_edit()) applied(world, edit);
  EXPECT_EQ(difference(world, through(world, "a.glb"), kAsGltf), "");
}

TEST(Gltf, ExactShapesComeBackToTheLastBit) {
  World world;
  IdSource ids;
  geometry::CsgTree tree;
  const auto block = tree.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.2, 0.3}}));
  const auto hole = tree.add_leaf(geometry::Primitive(geometry::Cylinder{0.05, 1.0}), at(0.1, 0.0, 0.0));
  tree.add(geometry::CsgOperator::Difference, block, hole);
  geometry::ControlMesh control;
  control.mesh.positions = {{0, 0, 0}, {1.0 / 3.0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  control.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  control.creases = {{{0, 1}}};
  control.corners = {2};
  const std::vector<GeometryPointer> shapes = {
      std::make_shared<CsgGeometry>(tree), std::make_shared<LoopGeometry>(control),
      std::make_shared<PrimitiveGeometry>(geometry::Torus{0.3, 0.1}, Axis::Y),
      std::make_shared<PrimitiveGeometry>(geometry::Plane{}),
      *ImplicitGeometry::create("x^2 + y^2 + z^2 - 0.04", Bounds(Vector3(-1, -1, -1), Vector3(1, 1, 1)))};
  for (const GeometryPointer& shape : shapes)
    add_object(world, ids, "of " + std::string(shape->kind()), shape);
  const World back = through(world, "a.glb");
  ASSERT_EQ(back.roots().size(), shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i)
    EXPECT_EQ(back.find(back.find(back.roots()[i])->geometry)->shape->hash(), shapes[i]->hash()) << i;
}

/// A square of two triangles that differ in all that belongs to corners.
std::shared_ptr<MeshGeometry> square() {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<MeshGeometry>(mesh);
}

TEST(Gltf, WhatBelongsToCornersComesBack) {
  const auto plain = square();
  const auto dressed = square();
  const Vector3 up(0, 0, 1);
  const Vector3 tilted = Vector3(0, 0.6, 0.8);
  dressed->normals = {{up, up, up}, {tilted, tilted, up}};
  using base::Vector2;
  dressed->texture_coordinates = {{Vector2(0, 0), Vector2(1, 0), Vector2(1, 1)},
                                  {Vector2(0.5, 0), Vector2(0.25, 0), Vector2(0, 2)}};
  dressed->colours = {{Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 1}},
                      {Colour{1, 1, 0}, Colour{0, 1, 1}, Colour{1, 0, 1}}};
  const auto flat = square();
  flat->normals = {{up, up, up}, {up, up, up}};
  for (const auto& shape : {plain, dressed, flat}) {
    World world;
    IdSource ids;
    add_object(world, ids, "square", shape);
    EXPECT_EQ(difference(world, through(world, "a.glb"), kAsGltf), "");
  }
}

TEST(Gltf, RecipesComeBack) {
  World world;
  IdSource ids;
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = "oak"}});
  const std::string text = "{\"op\":\"text\",\"words\":\"\\\"\xc3\xa4\\n\"}";
  const ObjectId one = add_object(world, ids, "one", made_mesh(text));
  applied(world, ChooseMaterial{duplicated(world, ids, one, Duplicate::CloneObject), material});
  add_object(world, ids, "other", made_mesh("{\"side\":1}"));
  add_object(world, ids, "by hand", one_triangle());
  for (const char* name : {"a.glb", "a.gltf"}) {
    const World back = through(world, name);
    EXPECT_EQ(back.geometries().size(), 3U);
    EXPECT_EQ(difference(world, back, kAsGltf), "");
  }
}

TEST(Gltf, RecipesOfOtherPeopleAreTakenIfTheyFit) {
  const auto recipe_from = [](const std::string& extras, const std::string& more) {
    const std::string primitive = R"({"attributes":{"POSITION":0}})";
    const ScratchFolder folder;
    const auto path = folder.write(
        "a.gltf",
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"buffers":[{"byteLength":36,"uri":)"
        R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
        R"("componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[)" +
            primitive + more + R"(],"extras":{"icome":{"recipe":)" + extras + "}}}]}");
    const auto design = read_design(path);
    if (!design) throw std::runtime_error(design.error().message);
    return std::string(recipe_of(*design->world.geometries().begin()->second.shape));
  };
  EXPECT_EQ(recipe_from(R"("{\"side\":2}")", ""), R"({"side":2})");
  EXPECT_EQ(recipe_from("17", ""), "");
  EXPECT_EQ(recipe_from(R"({"side":2})", ""), "");
  EXPECT_EQ(recipe_from(R"("{}")", R"(,{"attributes":{"POSITION":0},"mode":5})"), "");
  EXPECT_EQ(recipe_from('"' + std::string(kMostRecipeBytes, 'x') + '"', "").size(), kMostRecipeBytes);
  EXPECT_EQ(recipe_from('"' + std::string(kMostRecipeBytes + 1, 'x') + '"', ""), "");
}

TEST(Gltf, ColoursAreLinearInTheFileAndAsDisplayedInTheWorld) {
  const ScratchFolder folder;
  const auto path =
      folder.write("a.gltf", R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":{)"
                             R"("baseColorFactor":[0.21404114048223255,0,1,1],"metallicFactor":0},)"
                             R"("emissiveFactor":[0.033104766570885055,0,0]}]})");
  const auto design = read_design(path);
  ASSERT_TRUE(design) << design.error().message;
  ASSERT_EQ(design->world.materials().size(), 1U);
  const Material& material = design->world.materials().begin()->second;
  EXPECT_EQ(material.diffuse, (Colour{0.5F, 0.0F, 1.0F}));
  EXPECT_EQ(material.emission, (Colour{0.2F, 0.0F, 0.0F}));
  EXPECT_NEAR(material.specular[0], 0.2209, 1e-3);  // a twenty-fifth of the light
}

TEST(Gltf, ColoursComeBackExactly) {
  base::Random random(3);
  World world;
  IdSource ids;
  for (int i = 0; i < 200; ++i) {
    const auto part = [&] { return i < 100 ? float(random.uniform()) : float(random.index(256)) / 255.0F; };
    Material look{.name = std::to_string(i)};
    for (Colour* colour : {&look.diffuse, &look.specular, &look.emission}) *colour = {part(), part(), part()};
    const auto material = ids.next<MaterialId>();
    applied(world, CreateMaterial{material, look});
    applied(world, ChooseMaterial{add_object(world, ids, "square", square()), material});
  }
  EXPECT_EQ(difference(world, through(world, "a.glb"), kAsGltf), "");
}

TEST(Gltf, MaterialsOfColouredMeshesStayOne) {
  World world;
  IdSource ids;
  const auto coloured = square();
  const Colour red{1, 0, 0};
  coloured->colours = {{red, red, red}, {red, red, red}};
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = "oak", .diffuse = {0.25F, 0.5F, 0.75F}}});
  for (const GeometryPointer& shape : {GeometryPointer(coloured), GeometryPointer(square())}) {
    const ObjectId id = add_object(world, ids, "square", shape);
    applied(world, ChooseMaterial{id, material});
  }
  const World back = through(world, "a.glb");
  EXPECT_EQ(back.materials().size(), 1U);
  EXPECT_EQ(difference(world, back, kAsGltf), "");
}

TEST(Gltf, TexturesOnMeshesWithoutCoordinatesStayWithTheirMaterial) {
  World world;
  IdSource ids;
  const auto texture = ids.next<TextureId>();
  applied(world, CreateTexture{texture, {"wood", "image/png", std::make_shared<std::string>("bytes")}});
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = "oak", .diffuse = {0, 1, 0}, .texture = texture}});
  applied(world, ChooseMaterial{add_object(world, ids, "square", square()), material});
  const World back = through(world, "a.glb");
  EXPECT_EQ(back.materials().size(), 1U);
  EXPECT_EQ(difference(world, back, kAsGltf), "");
}

TEST(Gltf, ClonesInOtherMaterialsShareTheirShape) {
  World world;
  IdSource ids;
  const ObjectId one = add_object(world, ids, "one", square());
  const ObjectId two = duplicated(world, ids, one, Duplicate::CloneObject);
  for (const ObjectId id : {one, two}) {
    const auto material = ids.next<MaterialId>();
    applied(world, CreateMaterial{material, Material{.name = id == one ? "oak" : "ash"}});
    applied(world, ChooseMaterial{id, material});
  }
  const World back = through(world, "a.glb");
  EXPECT_EQ(back.geometries().size(), 1U);
  EXPECT_EQ(back.materials().size(), 2U);
}

TEST(Gltf, EqualExactShapesHaveTheirTrianglesOnceAndStayShapesOfTheirOwn) {
  constexpr std::size_t kCount = 20;
  const auto written = [](bool shared) {
    World world;
    IdSource ids;
    GeometryPointer ball;
    const GeometryPointer mesh = square();
    for (std::size_t i = 0; i < kCount; ++i) {
      if (!ball || !shared) ball = std::make_shared<PrimitiveGeometry>(geometry::Sphere{0.1});
      add_object(world, ids, "ball", ball, {}, at(double(i), 0.0, 0.0));
      add_object(world, ids, "square", mesh, {}, at(double(i), 1.0, 0.0));
    }
    const World back = through(world, "a.glb");
    EXPECT_EQ(difference(world, back, kAsGltf), "");
    EXPECT_EQ(back.geometries().size(), 2 * kCount);
    const ScratchFolder folder;
    EXPECT_TRUE(write_design(folder.path() / "a.glb", world));
    return double(std::filesystem::file_size(folder.path() / "a.glb"));
  };
  EXPECT_LT(written(true), 0.2 * written(false));
}

TEST(Gltf, NumbersThatSinglesHoldComeBackAsTheyWereWritten) {
  World world;
  IdSource ids;
  const auto shape = square();
  shape->mesh.positions[1] = {0.1, 0.2, 0.3};
  add_object(world, ids, "square", shape);
  const World back = through(world, "a.glb");
  EXPECT_EQ(back.find(back.find(back.roots()[0])->geometry)->shape->hash(), shape->hash());
}

/// A file of materials, each with the map of metal and roughness of that name.
std::string with_maps(const std::vector<std::string>& names) {
  std::string images, textures, materials;
  for (const std::string& name : names) {
    const char* const comma = images.empty() ? "" : ",";
    textures += fmt::format(R"({}{{"source":{}}})", comma, std::count(textures.begin(), textures.end(), '{'));
    materials += fmt::format(R"({}{{"pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":{}}}}}}})",
                             comma, std::count(images.begin(), images.end(), '{'));
    images += fmt::format(R"({}{{"uri":"{}"}})", comma, name);
  }
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"nodes":[{{"name":"a"}}],"scenes":[{{"nodes":[0]}}],)"
                     R"("images":[{}],"textures":[{}],"materials":[{}]}})",
                     images, textures, materials);
}

TEST(Gltf, AsksWhetherToGoOnBeforeEachMapAndUnpacksEachOnce) {
  const ScratchFolder folder;
  const std::vector<std::string> names = {"0.png", "1.png", "2.png"};
  for (const std::string& name : names)
    folder.write(name, *png_of({1, 1, 3, std::string(1, name[0]) + "ab"}));
  const auto asked = [&](const std::vector<std::string>& maps) {
    int count = 0;
    DesignReadOptions options;
    options.progress = [&](double) { return ++count > 0; };
    const auto design = read_design(folder.write("a.gltf", with_maps(maps)), options);
    EXPECT_TRUE(design) << design.error().message;
    return count;
  };
  // The others have one that is there already.
  const int once = asked({names[0]});
  EXPECT_EQ(asked(names), once + 2);
  EXPECT_EQ(asked(std::vector<std::string>(50, names[0])), once);
}

TEST(Gltf, TellsOfMapsThatAreTooLargeToUnpack) {
  const ScratchFolder folder;
  folder.write("p.png", *png_of({1000, 1000, 1, std::string(1'000'000, 'a')}));
  const auto path = folder.write("a.gltf", with_maps({"p.png"}));
  const auto told = [&](std::uint64_t memory_limit) {
    DesignReadOptions options;
    options.memory_limit = memory_limit;
    const auto design = read_design(path, options);
    if (!design) throw std::runtime_error(design.error().message);
    std::string all;
    for (const Remark& it : design->remarks) all += it.text + "\n";
    return all;
  };
  EXPECT_NE(told(3'000'000).find("1 map of metal and roughness is too large to be unpacked"),
            std::string::npos);
  EXPECT_NE(told(5'000'000).find("the means count"), std::string::npos);
}

}  // namespace
}  // namespace icome::files
