// glTF files made by enemies or broken disks: read or refused in one line, in bounded time and memory.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "files/damage.h"
#include "files/design_files.h"
#include "files/gltf/gltf_reader.h"
#include "files/sample_files.h"
#include "geometry/csg/csg_tree.h"
#include "world/sample_world.h"

namespace icome::files {
namespace {

using namespace world;

/// A GLB file of a JSON text and a binary part.
std::string glb_of(std::string json, std::string data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string bytes = bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json;
  if (!data.empty())
    bytes += bytes_of(static_cast<std::uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
  return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(static_cast<std::uint32_t>(bytes.size() + 12)) +
         bytes;
}

struct Parts {
  std::string json, data;
};
Parts parts_of(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return {glb.substr(20, length), glb.size() > 28 + length ? glb.substr(28 + length) : ""};
}

/// A file with something of everything.
std::string rich_glb() {
  World world;
  IdSource ids;
  const auto texture = ids.next<TextureId>();
  applied(world, CreateTexture{texture, {"wood", "image/png", std::make_shared<std::string>("picture")}});
  const auto material = ids.next<MaterialId>();
  applied(world, CreateMaterial{material, Material{.name = "oak", .texture = texture}});
  auto dressed = std::make_shared<MeshGeometry>(dynamic_cast<const MeshGeometry&>(*one_triangle()));
  const Vector3 tilted(0.0, 0.6, 0.8);
  dressed->normals = {{tilted, tilted, tilted}};
  dressed->colours = {{Colour{1, 0, 0}, Colour{0, 1, 0}, Colour{0, 0, 1}}};
  dressed->texture_coordinates = {{base::Vector2(0, 0), base::Vector2(1, 0), base::Vector2(0, 1)}};
  const ObjectId table = add_object(world, ids, "table", dressed);
  applied(world, ChooseMaterial{table, material});
  const ObjectId leg = add_object(world, ids, "leg", box(0.5), table, at(1, 2, 3));
  duplicated(world, ids, leg, Duplicate::CloneObject, table);
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Box{{1, 1, 1}}));
  add_object(world, ids, "solid", std::make_shared<CsgGeometry>(tree));
  for (const Fixture& fixture :
       {Fixture(Light{}), Fixture(Viewpoint{}), Fixture(Inert{"Script", "Script {}"}),
        Fixture(ForceEffect{"viscous:2", false})}) {
    const ObjectId id = add_object(world, ids, "fixture", nullptr);
    applied(world, ChangeFixture{id, std::make_shared<const Fixture>(fixture)});
  }
  const auto scene = ids.next<SceneId>();
  applied(world, CreateScene{scene, "kitchen"});
  applied(world, EnterScene{scene, table, 0});
  const ScratchFolder folder;
  if (!write_design(folder.path() / "a.glb", world)) throw std::runtime_error("not written");
  std::ifstream file(folder.path() / "a.glb", std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

base::Result<LoadedDesign> read_carefully(const std::string& bytes) {
  DesignReadOptions options;
  options.size_limit = 64ULL << 20U;
  options.seconds_limit = 20.0;
  io::MemoryBudget memory(256ULL << 20U);
  return read_gltf_bytes(bytes, "f", options, memory);
}

void read_or_refuse(const std::string& bytes) {
  const auto design = read_carefully(bytes);
  if (design) return;
  EXPECT_EQ(design.error().message.find('\n'), std::string::npos) << design.error().message;
  EXPECT_TRUE(design.error().message.starts_with("f:")) << design.error().message;
}

TEST(GltfFuzz, DamagedFilesAreReadOrRefusedInOneLine) {
  constexpr std::string_view kWords[] = {"-1",
                                         "4294967296",
                                         "1e999",
                                         "null",
                                         "{}",
                                         "[]",
                                         "\"",
                                         "{\"icome\":",
                                         "NaN",
                                         "18446744073709551615",
                                         "\"uri\":\"x\",",
                                         "\"sparse\":{},",
                                         "\"byteStride\":8,",
                                         "[[[[[[[[",
                                         "\"mesh\":0,",
                                         "\"children\":[0],",
                                         "0.5"};
  const std::string good = rich_glb();
  ASSERT_TRUE(read_carefully(good));
  const Parts parts = parts_of(good);
  base::Random random(20261121);
  for (int i = 0; i < 1500; ++i) {
    read_or_refuse(damaged(good, kWords, random));
    read_or_refuse(glb_of(damaged(parts.json, kWords, random), parts.data));
  }
}

TEST(GltfFuzz, LengthsOfTheWholeFileAreChecked) {
  const std::string good = rich_glb();
  for (std::uint32_t length = 0; length < 64; ++length) {
    std::string bytes = good;
    std::memcpy(bytes.data() + 8, &length, 4);
    read_or_refuse(bytes);
  }
}

std::string json_with(const std::string& members) { return R"({"asset":{"version":"2.0"},)" + members + "}"; }

std::string error_of_json(const std::string& members, const std::string& data = "0123456789abcdef") {
  const auto design = read_carefully(glb_of(json_with(members), data));
  return design ? "" : design.error().message;
}

std::string many_times(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(GltfHostile, NestingIsBounded) {
  const std::string deep = many_times("[", 100'000) + many_times("]", 100'000);
  EXPECT_NE(error_of_json("\"extras\":" + deep).find("nests deeper"), std::string::npos);
}

TEST(GltfHostile, WhatJsonDescribesIsBounded) {
  EXPECT_NE(
      error_of_json("\"nodes\":[{}" + many_times(",{}", 1'000'000) + "]").find("more than there is memory"),
      std::string::npos);
}

TEST(GltfHostile, TheBinaryPartIsCopiedOnce) {
  EXPECT_NE(error_of_json(R"("buffers":[{"byteLength":16},{"byteLength":16}])").find("without data"),
            std::string::npos);
}

TEST(GltfHostile, CountsMustBePaidFor) {
  const auto with_accessor = [](const std::string& accessor) {
    return R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
           R"("buffers":[{"byteLength":16}],"bufferViews":[{"buffer":0,"byteLength":16}],"accessors":[)" +
           accessor + "]";
  };
  for (const char* accessor :
       {R"({"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"})",
        R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"})",
        R"({"componentType":5126,"count":4000000000,"type":"VEC3"})",
        R"({"bufferView":7,"componentType":5126,"count":1,"type":"VEC3"})",
        R"({"bufferView":0,"byteOffset":8,"componentType":5126,"count":1,"type":"VEC3"})",
        R"({"bufferView":0,"componentType":5126,"count":1,"type":"MAT4"})",
        R"({"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":9,"indices":{"bufferView":0,)"
        R"("componentType":5121},"values":{"bufferView":0}}})"})
    EXPECT_FALSE(error_of_json(with_accessor(accessor)).empty()) << accessor;
}

TEST(GltfHostile, FilesElsewhereAreNotRead) {
  const ScratchFolder folder;
  for (const char* url :
       {"/etc/passwd", "file:///etc/passwd", "http://example.org/a.bin", "%2Fetc%2Fpasswd"}) {
    const std::string json =
        json_with(R"("buffers":[{"byteLength":16,"uri":")" + std::string(url) + R"("}])");
    const auto design = read_design(folder.write("a.gltf", json));
    ASSERT_FALSE(design) << url;
    EXPECT_NE(design.error().message.find("not fetched"), std::string::npos) << design.error().message;
  }
}

TEST(GltfHostile, PicturesBesideMustBePictures) {
  const ScratchFolder folder;
  folder.write("secret.txt", "secret");
  const auto design = read_design(folder.write(
      "a.gltf", json_with(R"("images":[{"uri":"secret.txt"}],"textures":[{"source":0}],)"
                          R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])")));
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_TRUE(design->world.textures().empty());
  EXPECT_FALSE(design->remarks.empty());
}

TEST(GltfHostile, NodesMustBeATree) {
  for (const char* nodes : {R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])",
                            R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])",
                            R"("scenes":[{"nodes":[0,1]}],"nodes":[{"children":[2]},{"children":[2]},{}])",
                            R"("scenes":[{"nodes":[5]}],"nodes":[{}])"})
    EXPECT_NE(error_of_json(nodes).find("do not form a tree"), std::string::npos) << nodes;
}

}  // namespace
}  // namespace icome::files
