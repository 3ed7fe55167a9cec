// OBJ files with their materials, as designs, and back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "files/damage.h"
#include "files/design_files.h"
#include "files/mesh/mtl_library.h"
#include "files/pictures/picture_bytes.h"
#include "files/same_design.h"
#include "files/sample_files.h"
#include "world/sample_world.h"

namespace icome::files {
namespace {

using namespace world;

constexpr std::string_view kPicture = "\x89PNG\r\n\x1a\nand so on";
constexpr std::string_view kMtl =
    "# library\nnewmtl red oak\nKa 0.1 0.1 0.1\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 64\nd 0.75\nmap_Kd -clamp on "
    "wood.png\n"
    "newmtl blue\nKd 0 0 1\nTr 0.5\nbump bumps.png\n";
constexpr std::string_view kObj =
    "mtllib things.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "o top\nusemtl red oak\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl blue\nf -4 -3 -2\n"
    "o leg\nusemtl blue\nf 1 2 3\nl 1 2\nusemtl lost\nf 1/9 2/9 3/9\n";

LoadedDesign read_sample(const ScratchFolder& folder) {
  folder.write("things.mtl", kMtl);
  folder.write("wood.png", kPicture);
  auto design = read_design(folder.write("things.obj", kObj));
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(*design);
}

const PhysicalObject& child(const World& world, std::size_t root, std::size_t place) {
  return *world.find(world.find(world.roots().at(root))->children.at(place));
}

TEST(ObjDesign, ObjectsInSeveralMaterialsAreSeveral) {
  const ScratchFolder folder;
  const LoadedDesign design = read_sample(folder);
  ASSERT_EQ(design.world.roots().size(), 2U);
  EXPECT_EQ(design.world.find(design.world.roots()[0])->name, "top");
  EXPECT_EQ(child(design.world, 0, 0).name, "red oak");
  EXPECT_EQ(child(design.world, 0, 1).material, child(design.world, 1, 0).material);
  const auto& quad =
      dynamic_cast<const MeshGeometry&>(*design.world.find(child(design.world, 0, 0).geometry)->shape);
  EXPECT_EQ(quad.mesh.triangles.size(), 2U);
  EXPECT_EQ(quad.normals.size(), 2U);
  ASSERT_EQ(quad.texture_coordinates.size(), 2U);
  for (std::size_t t = 0; t < 2; ++t) {
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(quad.texture_coordinates[t][std::size_t(i)], quad.mesh.corner(t, i).head<2>());
  }
}

TEST(ObjDesign, MaterialsArePutIntoTheWordsOfVrml) {
  const ScratchFolder folder;
  const LoadedDesign design = read_sample(folder);
  const Material& oak = *design.world.find(child(design.world, 0, 0).material);
  EXPECT_EQ(oak.name, "red oak");
  EXPECT_FLOAT_EQ(oak.ambient, 0.2F);
  EXPECT_FLOAT_EQ(oak.shininess, 0.5F);
  EXPECT_FLOAT_EQ(oak.transparency, 0.25F);
  const Texture& wood = *design.world.find(oak.texture);
  EXPECT_EQ(*wood.bytes, kPicture);
  EXPECT_EQ(wood.media_type, "image/png");
  EXPECT_FALSE(wood.repeats[0]);
  EXPECT_FLOAT_EQ(design.world.find(child(design.world, 1, 0).material)->transparency, 0.5F);
}

TEST(ObjDesign, WhatIsLeftOutIsTold) {
  const ScratchFolder folder;
  std::string all;
  for (const Remark& remark : read_sample(folder).remarks) all += sentence(remark, "f") + "\n";
  for (const char* part : {"no material \"lost\"", "Maps other than", "not there", "Points, lines"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
}

TEST(ObjDesign, FilesThatAreNotBesideAreNotTaken) {
  const ScratchFolder folder;
  folder.write("notes.txt", "secret");
  folder.write("a.mtl", "newmtl m\nmap_Kd notes.txt\n");
  const auto design = read_design(folder.write(
      "a.obj", "mtllib /etc/passwd\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"));
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_TRUE(design->world.textures().empty());
  ASSERT_EQ(design->remarks.size(), 2U);
  EXPECT_EQ(design->remarks[0].line, 1);
}

World through_obj(const World& world) {
  const ScratchFolder folder;
  const auto written = write_design(folder.path() / "a.obj", world);
  if (!written) throw std::runtime_error(written.error().message);
  auto read = read_design(folder.path() / "a.obj");
  if (!read) throw std::runtime_error(read.error().message);
  return std::move(read->world);
}

TEST(ObjDesign, FlatWorldsComeBack) {
  World world;
  IdSource ids;
  const auto texture = ids.next<TextureId>();
  applied(world, CreateTexture{texture, {"wood.png", "image/png", std::make_shared<std::string>(kPicture)}});
  const auto oak = ids.next<MaterialId>();
  applied(world, CreateMaterial{oak, Material{.name = "oak",
                                              .ambient = 0.5F,
                                              .diffuse = {0.25F, 0.5F, 0.75F},
                                              .specular = {1.0F, 0.5F, 0.25F},
                                              .shininess = 0.25F,
                                              .transparency = 0.5F,
                                              .texture = texture,
                                              .tints = true}});  // as MTL has it
  auto mesh = std::make_shared<MeshGeometry>(dynamic_cast<const MeshGeometry&>(*one_triangle()));
  const base::Vector3 up(0.0, 0.0, 1.0);
  mesh->normals = {{up, up, up}};
  mesh->texture_coordinates = {{base::Vector2(0.1, 0.2), base::Vector2(1.5, 0.25), base::Vector2(-1, 0)}};
  auto coloured = std::make_shared<MeshGeometry>(dynamic_cast<const MeshGeometry&>(*one_triangle()));
  coloured->colours = {{Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 0.5F}}};
  for (const char* name : {"top of the table", "leg"})
    applied(world, ChooseMaterial{add_object(world, ids, name, mesh), oak});
  add_object(world, ids, "plain", one_triangle());
  add_object(world, ids, "coloured", coloured);
  World unshared = through_obj(world);
  EXPECT_EQ(unshared.geometries().size(), 4U);
  EXPECT_EQ(difference(world, unshared, {.shapes = true, .texture_names = false}), "");
}

std::string text_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

World painted(const std::string& paint) {
  World world;
  IdSource ids;
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = paint}});
  applied(world, ChooseMaterial{add_object(world, ids, "thing", one_triangle()), material});
  return world;
}

TEST(ObjDesign, ALibraryOfSomebodyElseStays) {
  const ScratchFolder folder;
  const auto foreign = folder.write("a.mtl", "newmtl theirs\n");
  const auto numbered = folder.write("a_oak.mtl", "# made by ICOME\nnewmtl of another design\n");
  for (const char* const paint : {"red", "blue", "blue"}) {
    ASSERT_TRUE(write_design(folder.path() / "a.obj", painted(paint)));
    EXPECT_EQ(text_in(foreign), "newmtl theirs\n");
    const auto back = read_design(folder.path() / "a.obj");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->world.materials().size(), 1U);
    EXPECT_EQ(back->world.materials().begin()->second.name, paint);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 4)
        << "the design, its library, and those of others";
  }
  EXPECT_TRUE(std::filesystem::exists(numbered));
}

/// Whatever stands beside an old design when it is replaced, it still says the same until then.
TEST(ObjDesign, AnOldDesignKeepsItsLibraryUntilItIsReplaced) {
  const ScratchFolder folder;
  const auto design = folder.path() / "a.obj";
  ASSERT_TRUE(write_design(design, painted("red")));
  for (const char* const paint : {"blue", "green", "red"}) {
    const std::string before = text_in(design);
    ASSERT_TRUE(write_design(design, painted(paint)));
    const std::string after = text_in(design);
    EXPECT_NE(before.substr(0, before.find("\no ")), after.substr(0, after.find("\no ")))
        << "a new library has a name that the old design does not refer to";
    EXPECT_EQ(read_design(design)->world.materials().begin()->second.name, paint);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2)
        << "nothing is left over";
  }
}

TEST(ObjDesign, ObjectsOfOneNameStayApartAndMirrorsKeepTheirOutside) {
  World world;
  IdSource ids;
  const Affine3 mirror(Eigen::Scaling(-1.0, 1.0, 2.0));
  for (int i = 0; i < 2; ++i) add_object(world, ids, "leg", box(1.0), {}, mirror);
  const World back = through_obj(world);
  ASSERT_EQ(back.roots().size(), 2U);
  EXPECT_EQ(back.find(back.roots()[1])->name, "leg_2");
  const auto& leg =
      dynamic_cast<const MeshGeometry&>(*back.find(back.find(back.roots()[0])->geometry)->shape);
  EXPECT_NEAR(geometry::signed_volume(leg.mesh), 2.0, 1e-12);
}

std::string saved_as_obj(const World& world) {
  const ScratchFolder folder;
  if (!write_design(folder.path() / "a.obj", world)) throw std::runtime_error("not written");
  return text_in(folder.path() / "a.obj");
}

const MeshGeometry& obj_mesh(const World& world, std::size_t root = 0) {
  return dynamic_cast<const MeshGeometry&>(*world.find(world.find(world.roots().at(root))->geometry)->shape);
}

World read_obj(const std::string& text) {
  const ScratchFolder folder;
  auto design = read_design(folder.write("a.obj", text));
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(design->world);
}

TEST(ObjDesign, NormalsDoNotDriftFromSaveToSave) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  base::Random random(5);
  for (int i = 1; i <= 300; ++i) {
    const Vector3 normal = random.direction();
    text += fmt::format("vn {:.4f} {:.4f} {:.4f}\nf 1//{} 2//{} 3//{}\n", normal.x(), normal.y(), normal.z(),
                        i, i, i);
  }
  const std::string first = saved_as_obj(read_obj(text));
  EXPECT_EQ(saved_as_obj(read_obj(first)), first);
}

/// A roof of two squares that meet at a right angle along the z axis.
std::string roof(const char* first, const char* second) {
  return fmt::format("v 0 0 0\nv 0 0 1\nv 1 -1 1\nv 1 -1 0\nv -1 -1 1\nv -1 -1 0\n{}f 1 2 3 4\n{}f 1 6 5 2\n",
                     first, second);
}

TEST(ObjDesign, SmoothingGroupsSayWhereEdgesAre) {
  EXPECT_TRUE(obj_mesh(read_obj(roof("", ""))).normals.empty()) << "nothing said: smooth";
  EXPECT_TRUE(obj_mesh(read_obj(roof("s 1\n", ""))).normals.empty()) << "all of one group: smooth";
  const Vector3 right = Vector3(1, 1, 0).normalized(), left = Vector3(-1, 1, 0).normalized();
  for (const auto& [one, other] : {std::pair("s off\n", ""),
                                   {"s 0\n", "s 0\n"},
                                   {"s 1\n", "s 2\n"},
                                   {"s 1\n", "s 0\n"},
                                   {"", "s 3\n"}}) {
    const World world = read_obj(roof(one, other));
    const MeshGeometry& mesh = obj_mesh(world);
    ASSERT_EQ(mesh.normals.size(), 4U) << one << other;
    for (std::size_t t = 0; t < 4; ++t) {
      for (const Vector3& normal : mesh.normals[t])
        EXPECT_LT((normal - (t < 2 ? right : left)).norm(), 1e-12);
    }
  }
  // A group that goes on behind another: smooth over the ridge, flat elsewhere.
  const World world = read_obj(roof("s 1\n", "s 0\nf 3 4 6\ns 1\n"));
  const MeshGeometry& mesh = obj_mesh(world);
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.mesh.corner(0, int(k)).x() == 0.0) {
      EXPECT_LT((mesh.normals[0][k] - Vector3::UnitY()).norm(), 1e-12);
    } else {
      EXPECT_LT((mesh.normals[0][k] - right).norm(), 1e-12);
    }
  }
}

TEST(ObjDesign, ExactShapesHaveTheirNormalsAndColours) {
  World world;
  IdSource ids;
  add_object(world, ids, "ball", std::make_shared<PrimitiveGeometry>(geometry::Sphere{0.1}));
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Box{{0.1, 0.1, 0.1}}), at(0.0, 0.0, 0.0),
                geometry::CsgTree::Colour{1.0F, 0.5F, 0.0F, 1.0F});
  add_object(world, ids, "block", std::make_shared<CsgGeometry>(tree));
  const World back = read_obj(saved_as_obj(world));
  const MeshGeometry& ball = obj_mesh(back);
  ASSERT_EQ(ball.normals.size(), ball.mesh.triangles.size());
  for (std::size_t t = 0; t < ball.normals.size(); ++t)
    EXPECT_LT((ball.normals[t][0] - ball.mesh.corner(t, 0).normalized()).norm(), 1e-6);
  const MeshGeometry& block = obj_mesh(back, 1);
  ASSERT_FALSE(block.colours.empty());
  EXPECT_EQ(block.colours[0][0], (Colour{1.0F, 0.5F, 0.0F}));
  EXPECT_FALSE(block.normals.empty()) << "its edges are sharp";
}

/// A triangle with colours of its corners beneath a picture in colours.
World coloured_beneath_a_picture(bool tints, bool with_coordinates) {
  World world;
  IdSource ids;
  auto shape = std::make_shared<MeshGeometry>(dynamic_cast<const MeshGeometry&>(*one_triangle()));
  shape->colours = {{Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 1}}};
  if (with_coordinates)
    shape->texture_coordinates = {{base::Vector2(0, 0), base::Vector2(1, 0), base::Vector2(0, 1)}};
  const auto texture = ids.next<TextureId>();
  const auto png = png_of({1, 1, 3, "abc"});  // in colours: grey ones replace nothing
  applied(world, CreateTexture{texture, {"p.png", "image/png", std::make_shared<std::string>(*png)}});
  Material look{.name = "pictured"};
  look.texture = texture;
  look.tints = tints;
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, look});
  applied(world, ChooseMaterial{add_object(world, ids, "one", shape), material});
  return world;
}

TEST(ObjDesign, ColoursWithoutCoordinatesStayFromSaveToSave) {
  const World world = coloured_beneath_a_picture(false, false);
  const World once = through_obj(world);
  EXPECT_EQ(obj_mesh(once).colours, obj_mesh(world).colours);
  EXPECT_EQ(obj_mesh(through_obj(once)).colours, obj_mesh(world).colours);
}

TEST(ObjDesign, ColoursThatAPictureReplacesAreLeftOutAndTold) {
  for (const bool tints : {false, true}) {
    const World world = coloured_beneath_a_picture(tints, true);
    const ScratchFolder folder;
    const auto told = write_design(folder.path() / "a.obj", world);
    ASSERT_TRUE(told);
    EXPECT_EQ(obj_mesh(read_design(folder.path() / "a.obj")->world).colours.empty(), !tints);
    EXPECT_EQ(
        std::any_of(told->begin(), told->end(),
                    [](const Remark& it) { return it.text.find("beneath pictures") != std::string::npos; }),
        !tints);
  }
}

TEST(MtlLibrary, WhatIsLeftOutIsToldByName) {
  std::vector<std::string> notes;
  parse_mtl("newmtl a\nPm 0.5\nPr 0\naniso 1\nmap_Kd -mm 0 1 -imfchan r -blendu on a.png\nnewmtl b\nPm 1\n",
            notes);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0], "Left out of materials: Pm, aniso.");
  EXPECT_EQ(notes[1], "Left out of pictures: the options -imfchan.");
  notes.clear();
  EXPECT_EQ(parse_mtl("newmtl a\nmap_Kd -mm 0.1 2 a.png\n", notes).at(0).picture, "a.png");
  ASSERT_EQ(notes.size(), 1U);
}

TEST(ObjDesign, DamagedFilesAreReadOrRefused) {
  constexpr std::string_view kWords[] = {
      "usemtl",       "mtllib ", "g",      "o ",          "vt ",    "vn",  "/",     "//",
      "f -1 -1 -1\n", "\\\n",    "newmtl", "map_Kd -s 1", "-clamp", "nan", "1e999", "#"};
  base::Random random(7);
  for (int i = 0; i < 400; ++i) {
    const ScratchFolder folder;
    folder.write("wood.png", kPicture);
    folder.write("things.mtl", damaged(std::string(kMtl), kWords, random));
    const auto design = read_design(folder.write("things.obj", damaged(std::string(kObj), kWords, random)));
    if (!design) {
      EXPECT_FALSE(design.error().message.empty());
    }
  }
}

}  // namespace
}  // namespace icome::files
