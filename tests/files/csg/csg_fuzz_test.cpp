// Damaged .csg files must be read or refused, never crash: seeded mutations of real files. The sanitizer
// presets run this too.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

#include "base/random.h"
#include "files/csg/csg_reader.h"
#include "files/damage.h"
#include "io/file_bytes.h"
#include "places.h"

namespace icome::files {
namespace {

constexpr int kDamagedVariants = 4000;

/// One of everything, for machines without the shared data.
constexpr const char* kEverything =
    "// all\n!group() { difference() { cube(size = [1, 2, 3], center = true); sphere($fn = 5, r = 2); }\n"
    "multmatrix([[1, 0, 0.5, 0], [0, -1, 0, 2], [0, 0, 3, -1e-3], [0, 0, 0, 1]]) { intersection() {\n"
    "%cylinder(h = 2, r1 = 1, r2 = 0, $fn = 0); #cylinder(2, 1, .5, $fn = 16); cube(2); } }\n"
    "color(\"red\", 0.5) { render(convexity = 2) { polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]],\n"
    "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]); } } *hull() { } /* end */ color([1, 0, 0, 1]) { cube(); } "
    "}\n";

constexpr std::array<std::string_view, 22> kNastyCsgWords{
    "[",  "]",    "{",     "}",        "(",    ")",       ";",  ",",     "\"",       "/*",      "*/",
    "//", "1e99", "-1e-9", "99999999", "hull", "group()", "\\", "undef", "cube(1);", "$fn = 3", "[[[["};

/// Asks a tree that came out of damaged bytes what a program would ask it.
void check_tree(const geometry::CsgTree& tree) {
  ASSERT_FALSE(tree.empty());
  const geometry::Bounds box = geometry::bounds(tree);
  for (const geometry::Affine3& transform : tree.tree_from_node())
    ASSERT_TRUE(transform.matrix().allFinite() && transform.inverse().matrix().allFinite());
  if (!box.isEmpty()) {
    ASSERT_TRUE(box.min().allFinite() && box.max().allFinite());
    geometry::inside(tree, box.center());
  }
}

std::vector<std::string> small_real_files() {
  std::vector<std::string> texts{kEverything};
  const std::filesystem::path folder = places::shared_data() / "csg";
  if (!std::filesystem::exists(folder)) return texts;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.file_size() < 2500) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) texts.push_back(*io::read_bytes(file, 1U << 20U));
  return texts;
}

TEST(CsgFuzz, DamagedFilesAreReadOrRefusedInOneLine) {
  base::Random random(20240301);
  const std::vector<std::string> texts = small_real_files();
  int refused = 0;
  for (int i = 0; i < kDamagedVariants; ++i) {
    const std::string text = damaged(texts[random.index(texts.size())], kNastyCsgWords, random);
    const auto loaded = parse_csg(text, "f");
    if (loaded) {
      check_tree(loaded->tree);
    } else {
      ++refused;
      EXPECT_EQ(loaded.error().message.find('\n'), std::string::npos) << loaded.error().message;
      EXPECT_TRUE(loaded.error().message.starts_with("f:")) << loaded.error().message;
    }
  }
  EXPECT_GT(refused, kDamagedVariants / 20);
  EXPECT_LT(refused, kDamagedVariants);
}

TEST(CsgFuzz, EveryBeginningOfAFileIsReadOrRefused) {
  const std::string whole = kEverything;
  ASSERT_TRUE(parse_csg(whole, "f")) << parse_csg(whole, "f").error().message;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto loaded = parse_csg(whole.substr(0, length), "f");
    if (!loaded) {
      EXPECT_TRUE(loaded.error().message.starts_with("f:")) << loaded.error().message;
    }
  }
}

}  // namespace
}  // namespace icome::files
