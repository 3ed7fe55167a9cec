// What other programs see of a design that is written as glTF. They know nothing of ICOME's extras: here
// those are called otherwise before the file is read again.
#include "files/gltf/gltf_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "files/design_files.h"
#include "files/pictures/picture_bytes.h"
#include "files/same_design.h"
#include "files/sample_files.h"
#include "world/sample_world.h"

namespace icome::files {
namespace {

using namespace world;
using base::Vector2;

std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string written_as(const World& world, const char* name) {
  const ScratchFolder folder;
  const auto written = write_design(folder.path() / name, world);
  if (!written) throw std::runtime_error(written.error().message);
  return bytes_in(folder.path() / name);
}

World read_from(const std::string& bytes, const char* name) {
  const ScratchFolder folder;
  auto design = read_design(folder.write(name, bytes));
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(design->world);
}

World seen_by_others(const World& world) {
  std::string text = written_as(world, "a.gltf");
  for (std::size_t at = 0; (at = text.find("\"icome\"", at)) != std::string::npos;) text[at + 1] = 'o';
  for (std::size_t at = 0; (at = text.find("_ICOME_", at)) != std::string::npos;) text[at + 1] = 'O';
  return read_from(text, "a.gltf");
}

const MeshGeometry& seen_mesh(const World& world, std::size_t root = 0) {
  return dynamic_cast<const MeshGeometry&>(*world.find(world.find(world.roots().at(root))->geometry)->shape);
}

const Material& seen_look(const World& world, std::size_t root = 0) {
  return *world.find(world.find(world.roots().at(root))->material);
}

/// A square with all that belongs to corners.
std::shared_ptr<MeshGeometry> dressed_square() {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto shape = std::make_shared<MeshGeometry>(mesh);
  shape->texture_coordinates = {{Vector2(0, 0), Vector2(1, 0), Vector2(1, 1)},
                                {Vector2(0, 0), Vector2(1, 1), Vector2(0, 1)}};
  shape->colours = {{Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 1}},
                    {Colour{1, 0, 0}, Colour{0, 0, 1}, Colour{1, 1, 0}}};
  return shape;
}

/// The square, or another shape, beneath a picture in colours.
World pictured(bool tints, const PictureFrame& frame = kPictureAsItLies,
               const GeometryPointer& shape = dressed_square()) {
  World world;
  IdSource ids;
  const auto picture = ids.next<TextureId>();
  const auto png = png_of({1, 1, 3, "abc"});
  applied(world, CreateTexture{picture, {"p.png", "image/png", std::make_shared<const std::string>(*png)}});
  Material look{.name = "pictured", .diffuse = {0.5F, 0.25F, 0.75F}};
  look.texture = picture;
  look.picture_frame = frame;
  look.tints = tints;
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, look});
  const ObjectId square = add_object(world, ids, "square", shape);
  applied(world, ChooseMaterial{square, material});
  return world;
}

TEST(GltfWriter, ColoursThatAPictureReplacesAreNotSeen) {
  const World world = pictured(false);
  const World seen = seen_by_others(world);
  EXPECT_TRUE(seen_mesh(seen).colours.empty());
  EXPECT_EQ(seen_look(seen).diffuse, (Colour{1.0F, 1.0F, 1.0F}));
  EXPECT_EQ(difference(world, read_from(written_as(world, "a.glb"), "a.glb"), {.tolerance = 1e-5}), "")
      << "ICOME keeps them";
}

/// Nothing says how the picture lies: it is not seen.
TEST(GltfWriter, ColoursWithoutCoordinatesAreSeenWhateverThePictureAndStayFromSaveToSave) {
  const auto square = dressed_square();
  square->texture_coordinates.clear();
  const World world = pictured(false, kPictureAsItLies, square);
  EXPECT_FALSE(seen_mesh(seen_by_others(world)).colours.empty());
  const World once = read_from(written_as(world, "a.glb"), "a.glb");
  EXPECT_EQ(difference(world, once, {.tolerance = 1e-5}), "");
  EXPECT_EQ(difference(world, read_from(written_as(once, "a.glb"), "a.glb"), {.tolerance = 1e-5}), "");
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.1, 0.1}}), at(0.0, 0.0, 0.0),
                geometry::CsgTree::Colour{1.0F, 0.0F, 0.0F, 1.0F});
  const World solid = seen_by_others(pictured(false, kPictureAsItLies, std::make_shared<CsgGeometry>(tree)));
  ASSERT_FALSE(seen_mesh(solid).colours.empty());
  EXPECT_EQ(seen_mesh(solid).colours[0][0], (Colour{1.0F, 0.0F, 0.0F}));
}

TEST(GltfWriter, ColoursThatAPictureIsMultipliedWithAreSeen) {
  EXPECT_FALSE(seen_mesh(seen_by_others(pictured(true))).colours.empty());
}

TEST(GltfWriter, AShapeUnderPicturesAndPlainStaysOne) {
  World world = pictured(false);
  IdSource ids(0, 1000);
  const auto plain = ids.next<MaterialId>();
  applied(world, CreateMaterial{plain, Material{.name = "plain"}});
  const ObjectId clone = duplicated(world, ids, world.roots()[0], Duplicate::CloneObject);
  applied(world, ChooseMaterial{clone, plain});
  const World back = read_from(written_as(world, "a.glb"), "a.glb");
  EXPECT_EQ(back.geometries().size(), 1U);
  EXPECT_EQ(difference(world, back, {.tolerance = 1e-5}), "");
}

TEST(GltfWriter, PicturesThatLieAskewAreLaidByTheirMeshes) {
  const PictureFrame askew = {1.2, 0.7, 0.1, -0.3, 2.0, 0.25};
  const World world = pictured(true, askew);
  const World seen = seen_by_others(world);
  EXPECT_EQ(seen_look(seen).picture_frame, kPictureAsItLies);
  const MeshGeometry& mesh = seen_mesh(seen);
  ASSERT_EQ(mesh.texture_coordinates.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3& corner = mesh.mesh.corner(t, k);  // where it lies without a frame, too
      const Vector2 laid(1.2 * corner.x() + 0.7 * corner.y() + 0.1,
                         -0.3 * corner.x() + 2.0 * corner.y() + 0.25);
      EXPECT_LT((mesh.texture_coordinates[t][std::size_t(k)] - laid).norm(), 1e-6);
    }
  }
  const World back = read_from(written_as(world, "a.glb"), "a.glb");
  EXPECT_EQ(seen_look(back).picture_frame, askew);
  EXPECT_EQ(difference(world, back, {.tolerance = 1e-5}), "");
}

TEST(GltfWriter, RoundPrimitivesHaveTheirNormals) {
  World world;
  IdSource ids;
  add_object(world, ids, "ball", std::make_shared<PrimitiveGeometry>(geometry::Sphere{0.1}));
  add_object(world, ids, "box", box(0.1));
  const World seen = seen_by_others(world);
  const MeshGeometry& ball = seen_mesh(seen);
  ASSERT_EQ(ball.normals.size(), ball.mesh.triangles.size());
  for (std::size_t t = 0; t < ball.normals.size(); ++t) {
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((ball.normals[t][std::size_t(k)] - ball.mesh.corner(t, k).normalized()).norm(), 1e-5);
  }
  EXPECT_EQ(seen_mesh(seen, 1).normals[0][0].cwiseAbs().maxCoeff(), 1.0);
}

TEST(GltfWriter, PartsOfSolidsHaveTheirColours) {
  World world;
  IdSource ids;
  geometry::CsgTree tree;
  const auto red = tree.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.1, 0.1}}), at(-0.2, 0.0, 0.0),
                                 geometry::CsgTree::Colour{1.0F, 0.0F, 0.0F, 0.5F});
  const auto plain = tree.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.1, 0.1}}), at(0.2, 0.0, 0.0));
  tree.add(geometry::CsgOperator::Union, red, plain);
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = "blue", .diffuse = {0.0F, 0.0F, 1.0F}}});
  applied(world,
          ChooseMaterial{add_object(world, ids, "two", std::make_shared<CsgGeometry>(tree)), material});
  const World seen = seen_by_others(world);
  const MeshGeometry& mesh = seen_mesh(seen);
  ASSERT_EQ(mesh.colours.size(), mesh.mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.colours.size(); ++t) {
    const bool is_red = mesh.mesh.corner(t, 0).x() < 0.0;
    EXPECT_EQ(mesh.colours[t][0], (is_red ? Colour{1.0F, 0.0F, 0.0F} : Colour{0.0F, 0.0F, 1.0F}));
  }
}

TEST(GltfWriter, WhatIsReadIsWrittenAgainToTheLastByte) {
  World world = pictured(true, {1.1, 0.0, 0.3, 0.0, 0.7, -0.2});
  IdSource ids(0, 1000);
  const auto round =
      std::make_shared<MeshGeometry>(**PrimitiveGeometry(geometry::Torus{0.31, 0.07}).triangles(0.001));
  round->normals.resize(round->mesh.triangles.size());
  round->colours.resize(round->mesh.triangles.size());
  base::Random random(3);
  for (std::size_t t = 0; t < round->normals.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto one = [&] { return random.uniform(-1.0, 1.0); };
      round->normals[t][k] = Vector3(one(), one(), one()).normalized();
      for (float& part : round->colours[t][k]) part = float(std::abs(one()));
    }
  }
  const ObjectId ring = add_object(world, ids, "ring", round);
  Affine3 turned = at(0.1, 0.2, 0.3);
  turned.linear() = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  applied(world, PlaceObject{ring, turned});
  const std::string first = written_as(world, "a.glb");
  const std::string second = written_as(read_from(first, "a.glb"), "a.glb");
  EXPECT_EQ(written_as(read_from(second, "a.glb"), "a.glb"), second);
}

/// In VRML and OBJ, which know no metal, it would shine white.
TEST(GltfWriter, MetalBeneathAPictureShinesInItsColoursElsewhere) {
  World world = pictured(true);
  Material look = seen_look(world);
  look.diffuse = look.specular = {1.0F, 1.0F, 1.0F};
  look.metallic = 1.0F;
  applied(world, ChangeMaterial{world.find(world.roots()[0])->material, look});
  const ScratchFolder folder;
  for (const char* name : {"a.wrl", "a.obj"}) {
    ASSERT_TRUE(write_design(folder.path() / name, world));
    const auto back = read_design(folder.path() / name);
    ASSERT_TRUE(back);
    const Colour specular = seen_look(back->world).specular;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(specular[i], float("abc"[i]) / 255.0F, 0.01F) << name;
  }
}

TEST(GltfWriter, NothingToBeSeenIsTold) {
  World world;
  IdSource ids;
  add_object(world, ids, "empty", std::make_shared<MeshGeometry>(geometry::TriangleMesh{}));
  const ScratchFolder folder;
  for (const char* name : {"a.glb", "a.wrl", "a.obj", "a.stl"}) {
    const auto told = write_design(folder.path() / name, world);
    ASSERT_TRUE(told);
    EXPECT_TRUE(std::any_of(told->begin(), told->end(), [](const Remark& it) {
      return it.text.find("no object in it has triangles") != std::string::npos;
    })) << name;
  }
}

}  // namespace
}  // namespace icome::files
