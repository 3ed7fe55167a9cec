// Whatever the process that parses VRML answers, a world that keeps its rules comes out, or a sentence.
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/random.h"
#include "files/vrml/read/vrml_builder.h"
#include "files/vrml_answers.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/edits_of.h"

namespace icome::files {
namespace {

using base::Random;

std::filesystem::path sample_mesh() {
  static const std::filesystem::path kPath = [] {
    std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("vrml_fuzz_" + std::to_string(::getpid()) + ".obj");
    std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    return path;
  }();
  return kPath;
}

base::Result<LoadedDesign> build_anything(const std::string& bytes) {
  VrmlSources sources;
  sources.name = "fuzz.wrl";
  sources.find_mesh = [](const std::string&, const std::string& url) -> base::Result<FoundMesh> {
    return url.size() % 2 == 0 ? base::Result<FoundMesh>(FoundMesh{sample_mesh(), true})
                               : base::fail("there is no " + url);
  };
  sources.fetch_picture = [](const std::string&, const std::string& url, std::uint64_t) {
    return url.size() % 2 == 0 ? base::Result<std::string>("GIF89a" + url) : base::fail("not there");
  };
  io::TimeBudget time_budget(20.0, nullptr, 0.0);
  io::MemoryBudget memory;
  return build_vrml(bytes, sources, time_budget, memory);
}

/// What was made must be a world like any other: it can be written and made again.
void check_world(const LoadedDesign& design) {
  world::World again;
  const world::GeometryFactory factory;
  for (const world::Edit& edit : world::edits_of(design.world)) {
    const auto bytes = world::to_bytes(edit);
    ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
    const auto back = world::edit_from_bytes(*bytes, factory);
    ASSERT_TRUE(back.has_value()) << back.error().message;
    ASSERT_TRUE(world::replay(again, *back).has_value());
  }
  EXPECT_EQ(world::hash(again), world::hash(design.world));
  EXPECT_LE(design.remarks.size(), 1200U);
}

/// Something of everything.
Answer rich_answer() {
  using flat::GeometryKind;
  const std::vector<float> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5F, 0.5F, 1};
  const AnswerGeometry faces = {
      .kind = GeometryKind::Faces,
      .name = "faces",
      .positions = points,
      .polygons = {3, 2, 1, 0, -1, 0, 1, 4, -1, 1, 2, 4, -1, 2, 3, 4, -1, 3, 0, 4, -1},
      .texture_coordinates = {0, 0, 1, 0, 1, 1, 0, 1, 0.5F, 0.5F},
      .normals = {0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1},
      .normal_per_vertex = false,
      .colours = {1, 0, 0, 0, 1, 0},
      .colour_polygons = {0, 1, 0, 1, 0},
      .colour_per_vertex = false};
  AnswerGeometry creased = faces;
  creased.normals.clear();
  creased.crease_angle = 0.5F;
  creased.texture_polygons = creased.polygons;
  AnswerGeometry loop = {.kind = GeometryKind::Loop, .positions = points, .polygons = faces.polygons};
  loop.creases = {0, 1, 1, 2};
  loop.corners = {4};
  return {.nodes = {{.name = "a", .matrix = moved(1, 2, 3)},
                    {.parent = 0, .geometry = 0, .appearance = 0},
                    {.parent = 0, .name = "b"},
                    {.parent = 2, .geometry = 1, .appearance = 1},
                    {.parent = 2, .geometry = 0, .appearance = 2, .reused = true},
                    {.parent = 0, .light = AnswerLight{.kind = flat::LightKind::Spot, .location = {1, 2, 3}}},
                    {.viewpoint = AnswerViewpoint{.angle = 1.0}},
                    {.parent = 2, .geometry = 2},
                    {.geometry = 3, .appearance = 1},
                    {.geometry = 4, .appearance = 0},
                    {.geometry = 5, .appearance = 0},
                    {.geometry = 6, .appearance = 2},
                    {.scene = "s", .members = {"a", "b", "c"}}},
          .geometries = {faces,
                         creased,
                         {.kind = GeometryKind::Box, .sizes = {1, 2, 3}},
                         {.kind = GeometryKind::Cone, .sizes = {1, 2}},
                         {.kind = GeometryKind::Csg, .text = "box:1x1x1\nsphere:0.6\ndifference 0 1\n"},
                         {.kind = GeometryKind::Primitive, .text = "torus:0.3x0.1", .along_y = true},
                         loop},
          .appearances = {{.name = "red", .diffuse = {1, 0, 0}, .stiffness = 100.0},
                          {.name = "photo", .picture = 0, .texture_transform = {2, 0, 0, 0, 2, 0, 0, 0, 1}},
                          {.lit = false, .picture = 1}},
          .pictures = {{.urls = {"a", "bb"}, .base = "x"},
                       {.width = 1, .height = 2, .channels = 3, .pixels = {1, 2, 3, 4, 5, 6}}},
          .notes = {{"f", 3, "text"}}};
}

TEST(VrmlFuzz, TheRichAnswerIsGood) {
  const auto design = build_anything(bytes_of(rich_answer()));
  ASSERT_TRUE(design.has_value()) << design.error().message;
  EXPECT_EQ(design->world.geometries().size(), 7U);
  check_world(*design);
}

TEST(VrmlFuzz, DamagedBytesBecomeAWorldOrASentence) {
  const std::string good = bytes_of(rich_answer());
  Random random(11);
  int worlds = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    std::string bytes = good;
    for (std::uint64_t damage = 1 + random.index(4); damage > 0; --damage) {
      const std::size_t place = random.index(bytes.size());
      switch (random.index(4)) {
        case 0:
          bytes[place] = char(random.index(256));
          break;
        case 1:
          bytes[place] = char(bytes[place] ^ (1 << random.index(8)));
          break;
        case 2:
          for (std::size_t i = place; i < std::min(place + 4, bytes.size()); ++i)
            bytes[i] = char(random.index(2) * 255);
          break;
        default:
          bytes.resize(std::max<std::size_t>(place, 1));
      }
    }
    const auto design = build_anything(bytes);
    if (!design) {
      ASSERT_FALSE(design.error().message.empty());
      continue;
    }
    ++worlds;
    check_world(*design);
  }
  EXPECT_GT(worlds, 1000);
}

/// Answers that are whole but make little sense.
class NonsenseMaker {
 public:
  explicit NonsenseMaker(std::uint64_t seed) : random_(seed) {}

  Answer make() {
    Answer answer;
    for (std::uint64_t i = random_.index(5); i > 0; --i) answer.geometries.push_back(geometry());
    for (std::uint64_t i = random_.index(4); i > 0; --i) answer.pictures.push_back(picture());
    for (std::uint64_t i = random_.index(4); i > 0; --i)
      answer.appearances.push_back(appearance(int(answer.pictures.size())));
    for (std::uint64_t i = random_.index(12); i > 0; --i) answer.nodes.push_back(node(answer));
    return answer;
  }

 private:
  bool seldom() { return random_.index(12) == 0; }

  double number() {
    constexpr double kOdd[] = {
        0.0, -0.0, 1.0, -1.0, 1e-300, 1e300, 1e-38, 3e38, std::numeric_limits<double>::infinity()};
    if (random_.index(40) == 0) return std::numeric_limits<double>::quiet_NaN();
    return random_.index(3) == 0 ? kOdd[random_.index(std::size(kOdd))] : random_.uniform(-2.0, 2.0);
  }
  int index(std::size_t count) {
    const int result = int(random_.index(count + 1)) - 1;
    return random_.index(60) == 0 ? result + 3 : result;
  }
  template <typename Number>
  std::vector<Number> numbers(std::size_t count) {
    std::vector<Number> result(count + (seldom() ? random_.index(5) : 0));
    for (Number& it : result) it = Number(number());
    return result;
  }
  std::vector<std::int32_t> polygons(std::size_t vertices) {
    std::vector<std::int32_t> result;
    for (std::uint64_t i = random_.index(10); i > 0; --i) {
      for (std::uint64_t k = random_.index(7); k > 0; --k) result.push_back(index(vertices));
      result.push_back(-1);
    }
    return result;
  }

  AnswerGeometry geometry() {
    AnswerGeometry geometry;
    geometry.kind = flat::GeometryKind(random_.index(seldom() ? 256 : 10));
    geometry.sizes = numbers<double>(random_.index(4));
    for (std::uint64_t i = random_.index(4); i > 0; --i) geometry.urls.emplace_back(random_.index(40), 'u');
    if (random_.index(2) == 0) geometry.unit = number();
    const std::size_t vertices = random_.index(9);
    geometry.positions = numbers<float>(3 * vertices);
    geometry.polygons = polygons(vertices);
    if (random_.index(2) == 0) geometry.texture_coordinates = numbers<float>(2 * vertices);
    if (random_.index(3) == 0)
      geometry.texture_polygons = random_.index(2) ? geometry.polygons : polygons(vertices);
    if (random_.index(2) == 0) geometry.normals = numbers<float>(3 * vertices);
    if (random_.index(3) == 0) geometry.normal_polygons = polygons(vertices);
    geometry.normal_per_vertex = random_.index(2) == 0;
    if (random_.index(2) == 0) geometry.colours = numbers<float>(3 * vertices);
    if (random_.index(3) == 0) geometry.colour_polygons = polygons(vertices);
    geometry.colour_per_vertex = random_.index(2) == 0;
    geometry.ccw = random_.index(2) == 0;
    geometry.crease_angle = float(number());
    geometry.creases = polygons(vertices);
    geometry.corners = polygons(vertices);
    constexpr const char* kTexts[] = {"",          "box:1x1x1", "x^2-1", "sphere:1\nsphere:2\nunion 0 1",
                                      "union 0 0", "((("};
    geometry.text = kTexts[random_.index(std::size(kTexts))];
    geometry.box = numbers<double>(6);
    return geometry;
  }

  AnswerPicture picture() {
    AnswerPicture picture;
    for (std::uint64_t i = random_.index(3); i > 0; --i) picture.urls.emplace_back(random_.index(4), 'u');
    picture.width = std::uint32_t(random_.index(4));
    picture.height = std::uint32_t(seldom() ? 1U << 31 : random_.index(4));
    picture.channels = std::uint32_t(random_.index(6));
    picture.pixels.resize(seldom() ? 3
                                   : std::size_t{picture.width} * (picture.height % 8) * picture.channels);
    return picture;
  }

  AnswerAppearance appearance(int pictures) {
    AnswerAppearance appearance;
    appearance.lit = random_.index(3) != 0;
    for (float& it : appearance.diffuse) it = float(number());
    appearance.transparency = float(number());
    appearance.picture = index(std::size_t(pictures));
    if (random_.index(2) == 0) appearance.texture_transform = numbers<double>(9);
    if (random_.index(2) == 0) appearance.stiffness = number();
    appearance.static_friction = number();
    appearance.dynamic_friction = number();
    return appearance;
  }

  AnswerNode node(const Answer& answer) {
    AnswerNode node;
    node.parent =
        random_.index(100) == 0 ? int(answer.nodes.size()) : int(random_.index(answer.nodes.size() + 1)) - 1;
    if (node.parent < int(answer.nodes.size()) && node.parent >= 0 &&
        answer.nodes[std::size_t(node.parent)].scene)
      node.parent = -1;
    if (random_.index(2) == 0) node.name = std::string(random_.index(2), 'n');
    if (random_.index(3) == 0) node.matrix = random_.index(2) ? moved(1, 2, 3) : numbers<double>(12);
    node.geometry = index(answer.geometries.size());
    node.appearance = index(answer.appearances.size());
    if (random_.index(6) == 0)
      node.light = AnswerLight{
          flat::LightKind(random_.index(4)), {number(), 0, 0}, {0, number(), number()}, float(number())};
    if (random_.index(6) == 0)
      node.viewpoint = AnswerViewpoint{{0, number(), 0}, {number(), 0, 0}, number(), number()};
    node.reused = random_.index(2) == 0;
    if (random_.index(10) == 0) node.scene = "s";
    if (random_.index(4) == 0) node.members = {"n", "", "x"};
    return node;
  }

  Random random_;
};

TEST(VrmlFuzz, NonsenseBecomesAWorldOrASentence) {
  int worlds = 0;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const auto design = build_anything(bytes_of(NonsenseMaker(seed).make()));
    if (!design) {
      ASSERT_FALSE(design.error().message.empty());
      continue;
    }
    ++worlds;
    check_world(*design);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(worlds, 2000);
}

// Parts of a FlatBuffer may lie over each other: few bytes then stand for many.

TEST(VrmlFuzz, SharedPartsDoNotStandForMore) {
  flatbuffers::FlatBufferBuilder flat;
  const auto positions = flat.CreateVector(std::vector<float>(300'000, 1.0F));
  const auto polygons = flat.CreateVector(std::vector<std::int32_t>(300'000, 0));
  std::vector<flatbuffers::Offset<flat::Geometry>> geometries;
  std::vector<flatbuffers::Offset<flat::Node>> nodes;
  for (int i = 0; i < 20'000; ++i) {
    flat::GeometryBuilder geometry(flat);
    geometry.add_kind(flat::GeometryKind::Faces);
    geometry.add_positions(positions);
    geometry.add_polygons(polygons);
    geometries.push_back(geometry.Finish());
    flat::NodeBuilder node(flat);
    node.add_geometry(i);
    nodes.push_back(node.Finish());
  }
  const auto all_nodes = flat.CreateVector(nodes);
  const auto all_geometries = flat.CreateVector(geometries);
  flat.Finish(flat::CreateScene(flat, all_nodes, all_geometries), flat::SceneIdentifier());
  const auto design =
      build_anything({reinterpret_cast<const char*>(flat.GetBufferPointer()), flat.GetSize()});
  ASSERT_FALSE(design.has_value());
  EXPECT_NE(design.error().message.find("stand for more than they hold"), std::string::npos);
}

TEST(VrmlFuzz, SharedTablesAreRefused) {
  flatbuffers::FlatBufferBuilder flat;
  const auto word = flat::CreateStringDirect(flat, "x");
  const auto words = flat.CreateVector(std::vector<flatbuffers::Offset<flat::String>>(10'000, word));
  std::vector<flatbuffers::Offset<flat::Node>> nodes;
  for (int i = 0; i < 10'000; ++i) {
    flat::NodeBuilder node(flat);
    node.add_members(words);
    nodes.push_back(node.Finish());
  }
  const auto all = flat.CreateVector(nodes);
  flat.Finish(flat::CreateScene(flat, all), flat::SceneIdentifier());
  const auto design =
      build_anything({reinterpret_cast<const char*>(flat.GetBufferPointer()), flat.GetSize()});
  ASSERT_FALSE(design.has_value());
  EXPECT_NE(design.error().message.find("is damaged"), std::string::npos);
}

}  // namespace
}  // namespace icome::files
