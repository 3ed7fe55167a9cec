// The shared VRML files, and worlds made at random, through files of our own and back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "files/design_files.h"
#include "files/same_design.h"
#include "files/sample_files.h"
#include "files/vrml/read/vrml_reader.h"
#include "files/vrml/write/vrml_writer.h"
#include "io/file_bytes.h"
#include "places.h"
#include "world/random_edits.h"

namespace icome::files {
namespace {

using namespace world;
namespace fs = std::filesystem;

// Turns are told to six decimals, several of them make one transform.
constexpr double kWritten = 3e-6;

/// What is different after the design went through a file, or in that file when it is written again; empty
/// when nothing is.
std::string difference_through_file(const World& world, const fs::path& path) {
  if (const auto first = write_vrml(path, world); !first) return first.error().message;
  const std::string text = io::read_bytes(path, 1U << 30U).value();
  const auto once = read_design(path);
  if (!once) return once.error().message;
  // VRML 2.0 has directional lights for groups alone, which writing tells.
  const Likeness likeness{.tolerance = kWritten, .texture_names = false, .recipes = false, .scopes = false};
  std::string why = difference(world, once->world, likeness);
  if (!why.empty()) return why;
  if (const auto second = write_vrml(path, once->world); !second) return second.error().message;
  return io::read_bytes(path, 1U << 30U).value() == text ? "" : "it is written otherwise";
}

TEST(VrmlDataRoundTrip, EverySharedFileThatCanBeReadStaysAsItIs) {
  const fs::path shared = places::shared_data() / "vrml";
  if (!fs::exists(shared)) GTEST_SKIP() << shared << " is not there";
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(shared)) {
    if (entry.is_regular_file()) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  const ScratchFolder folder;
  int read = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string ending = paths[i].extension();
    if (ending != ".wrl" && ending != ".wrz" && ending != ".vrml") continue;
    const auto design = read_design(paths[i]);
    if (!design) continue;
    ++read;
    EXPECT_EQ(difference_through_file(design->world, folder.path() / fmt::format("{}.wrl", i)), "")
        << paths[i];
  }
  EXPECT_GT(read, 100);
}

/// Without what VRML keeps otherwise: scripts that are parts of objects, and pictures that are none.
World kept_by_vrml(World world) {
  std::vector<Edit> edits;
  for (const auto& [id, object] : world.objects()) {
    if (object.fixture && std::holds_alternative<Inert>(*object.fixture))
      edits.push_back(ChangeFixture{id, nullptr});
  }
  for (const auto& [id, material] : world.materials()) {
    Material plain = material;
    plain.texture = {};
    edits.push_back(ChangeMaterial{id, plain});
  }
  for (const Edit& edit : edits) applied(world, edit);
  return world;
}

TEST(VrmlDataRoundTrip, WorldsMadeAtRandom) {
  const ScratchFolder folder;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    RandomEdits edits(seed);
    World world;
    for (int i = 0; i < 300; ++i) (void)apply(world, edits.next(world));
    EXPECT_EQ(difference_through_file(kept_by_vrml(world), folder.path() / "random.wrl"), "") << seed;
  }
}

}  // namespace
}  // namespace icome::files
