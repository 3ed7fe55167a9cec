#include "io/memory_budget.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>

#include "base/clock.h"
#include "files/design_files.h"
#include "files/packed_xz.h"
#include "files/sample_journals.h"

namespace icome::files {
namespace {

TEST(MemoryBudget, IsTwentyTimesTheFilesAnd256MegabytesUnlessSomebodySays) {
  io::MemoryBudget memory;
  EXPECT_EQ(memory.allowed(), 256'000'000u);
  EXPECT_TRUE(memory.add_file(1'000'000));
  EXPECT_EQ(memory.allowed(), 276'000'000u);
  EXPECT_EQ(memory.left(), 275'000'000u);
  EXPECT_TRUE(memory.take(275'000'000));
  memory.give_back(1);
  EXPECT_TRUE(memory.has_room(1));
  EXPECT_FALSE(memory.take(2));
  EXPECT_TRUE(memory.is_exceeded());
  EXPECT_FALSE(memory.take(0)) << "who was refused once gets nothing more";
  EXPECT_EQ(io::MemoryBudget(7).allowed(), 7u);
}

#ifndef ICOME_ADDRESS_SANITIZER
// Designs made to exhaust the machine. What is taken is told by the system, of the program and of its
// children.

std::uint64_t peak_bytes(int who) {
  rusage use{};
  ::getrusage(who, &use);
  return std::uint64_t(use.ru_maxrss) * 1024;
}

/// Reads a design that is refused; gives the bytes by which memory went beyond what was ever taken before.
std::uint64_t bytes_to_refuse(const std::filesystem::path& path, const DesignReadOptions& options = {}) {
  const std::uint64_t before = peak_bytes(RUSAGE_SELF);
  const auto design = read_design(path, options);
  EXPECT_FALSE(design);
  if (design) return 0;
  EXPECT_NE(design.error().message.find("MB of memory"), std::string::npos) << design.error().message;
  EXPECT_NE(design.error().message.find(path.string()), std::string::npos) << design.error().message;
  return peak_bytes(RUSAGE_SELF) - before;
}

TEST(MemoryBudget, BoundsProtosThatDoubleEachOther) {
  std::string text = "#VRML V2.0 utf8\nPROTO P0 [] { Group { children [ Group {} Group {} ] } }\n";
  for (int i = 1; i < 26; ++i)
    text += fmt::format("PROTO P{0} [] {{ Group {{ children [ P{1} {{}} P{1} {{}} ] }} }}\n", i, i - 1);
  const ScratchFolder folder;
  bytes_to_refuse(folder.write("a.wrl", text + "P25 {}\n"));
  // A child counts what this process has until it becomes another program.
  EXPECT_LT(peak_bytes(RUSAGE_CHILDREN),
            std::max<std::uint64_t>(400'000'000, peak_bytes(RUSAGE_SELF) + 50'000'000));
}

/// A mesh, and a tail of copies of it of which each has one vertex moved.
std::string copies_of_a_mesh(std::size_t vertices, std::size_t copies) {
  const ScratchFolder folder(memory_folder());
  const auto path = folder.path() / "a.icome";
  {
    JournaledWorld journal = opened(path, {.create = true, .compact_factor = 1e9});
    geometry::TriangleMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) mesh.positions.emplace_back(double(i), 0.0, double(i * i));
    for (std::uint32_t i = 0; i + 2 < vertices; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
    const world::GeometryId first{101};
    performed(journal, world::CreateGeometry{first, std::make_shared<world::MeshGeometry>(std::move(mesh))});
    for (std::size_t i = 1; i <= copies; ++i) {
      const world::GeometryId copy{101 + i};
      performed(journal, world::EditGroup{{world::CopyGeometry{copy, first},
                                           world::MoveVertices{copy, {0}, {{0.0, 1.0, double(i)}}}}});
    }
  }
  return content_of(path);
}

TEST(MemoryBudget, BoundsCopiesThatAJournalMakes) {
  const ScratchFolder folder;
  // 3.6 MB a copy.
  std::string bytes = copies_of_a_mesh(100'000, 20);
  const auto good = folder.write("good.icome", bytes);
  const auto whole = read_design(good);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->world.geometries().size(), 21u);
  EXPECT_LT(bytes_to_refuse(good, {.memory_limit = 50'000'000}), 60'000'000u);
  ::malloc_trim(0);
  bytes = copies_of_a_mesh(100'000, 120);
  bytes_to_refuse(folder.write("many.icome", bytes));
  const auto allowed = read_design(folder.path() / "many.icome", {.memory_limit = 1'000'000'000});
  EXPECT_TRUE(allowed) << allowed.error().message;
}

TEST(MemoryBudget, BoundsWhatUnpacks) {
  const ScratchFolder folder;
  ASSERT_EQ(std::system(fmt::format("head -c 400000000 /dev/zero | xz -1 >{0}/a.obj.xz && "
                                    "head -c 400000000 /dev/zero | gzip -1 >{0}/a.wrz",
                                    folder.path().string())
                            .c_str()),
            0);
  bytes_to_refuse(folder.path() / "a.obj.xz");
  bytes_to_refuse(folder.path() / "a.wrz");
}

TEST(MemoryBudget, BoundsPartsOfObj) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 600'000; ++i) text += fmt::format("g {}\nf 1 2 3\n", i);
  const ScratchFolder folder;
  EXPECT_LT(bytes_to_refuse(folder.write("a.obj", text)), 20 * text.size() + 256'000'000);
}

TEST(MemoryBudget, BoundsWhatBecomesOfWhatUnpacks) {
  const ScratchFolder folder;
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto faces = folder.write("a.obj.xz", packed_xz(corners + repeated("f 1 2 3\n", 8'000'000)));
  EXPECT_LT(bytes_to_refuse(faces), 300'000'000u);
  const std::string head = "OFF 3 8000000 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_LT(bytes_to_refuse(folder.write("a.off.xz", packed_xz(head + repeated("3 0 1 2\n", 8'000'000)))),
            300'000'000u);
  EXPECT_LT(
      bytes_to_refuse(folder.write("a.csg.xz", packed_xz(repeated("group();", 4'000'000) + "cube(1);"))),
      300'000'000u);
}

TEST(MemoryBudget, BoundsStripsOfGltf) {
  // Each byte of the strip stands for a triangle with normals and coordinates, of 132 bytes.
  constexpr std::size_t kStrip = 4'000'000;
  std::string data(4 * 24, '\0');
  for (std::size_t i = 0; i < kStrip; ++i) data += char(i % 3);
  const std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[)"
      R"({{"attributes":{{"POSITION":0,"NORMAL":0,"TEXCOORD_0":1}},"indices":2,"mode":5}}]}}],)"
      R"("buffers":[{{"byteLength":{0}}}],"bufferViews":[{{"buffer":0,"byteLength":96}},)"
      R"({{"buffer":0,"byteOffset":96,"byteLength":{1}}}],"accessors":[)"
      R"({{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},)"
      R"({{"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"}},)"
      R"({{"bufferView":1,"componentType":5121,"count":{1},"type":"SCALAR"}}]}})",
      data.size(), kStrip);
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = std::uint32_t(12 + 8 + text.size() + 8 + data.size());
  const ScratchFolder folder;
  bytes_to_refuse(folder.write(
      "a.glb", "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(size) + bytes_of(std::uint32_t(text.size())) +
                   "JSON" + text + bytes_of(std::uint32_t(data.size())) + std::string("BIN\0", 4) + data));
}
#endif

TEST(MemoryBudget, GoesWithOneOfTimeForEveryFormat) {
  const ScratchFolder folder;
  const auto journal = folder.write("a.icome", sample_journal().bytes);
  for (const auto& path : {journal, folder.write("a.obj", sample_obj()), folder.write("a.off", sample_off()),
                           folder.write("a.stl", sample_binary_stl()), folder.write("a.glb", sample_glb()),
                           folder.write("a.csg", "cube(size = [1, 2, 3], center = false);"),
                           folder.write("a.wrl", "#VRML V2.0 utf8\nGroup {}\n")}) {
    EXPECT_TRUE(read_design(path)) << path;
    const auto late = read_design(path, {.seconds_limit = 0.0});
    ASSERT_FALSE(late) << path;
    EXPECT_NE(late.error().message.find("longer than"), std::string::npos) << late.error().message;
  }
}

TEST(MemoryBudget, StopsAJournalWithinOneLongEdit) {
  // One record: each object goes before all others, which takes longer the more there are.
  const ScratchFolder folder;
  const auto path = folder.path() / "a.icome";
  {
    JournaledWorld journal = opened(path, {.create = true});
    world::EditGroup group;
    for (std::uint64_t i = 1; i <= 50'000; ++i)
      group.edits.push_back(world::CreateObject{world::ObjectId{i}, 0, {}});
    performed(journal, group);
  }
  int looks = 0;
  DesignReadOptions options;
  options.progress = [&](double) { return ++looks < 100; };
  const auto stopped = read_design(path, options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(looks, 100) << "the reading ends with the look that says so";
}

}  // namespace
}  // namespace icome::files
