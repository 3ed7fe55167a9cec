// Damaged files must be read or refused, never crash: seeded mutations of a small file of each format.
// The sanitizer presets run this too.
#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "files/damage.h"
#include "files/mesh/mesh_formats.h"
#include "files/sample_files.h"
#include "geometry/mesh/mesh_repair.h"

namespace icome::files {
namespace {

constexpr int kVariants = 3000;

/// Words that parsers stumble over.
constexpr std::array<std::string_view, 16> kNastyWords{
    "-1",   "0", "4294967295", "4294967296", "9223372036854775807", "1e308", "nan", "-inf", "", " ", "\n",
    "\\\n", "#", "/",          "f ",         "\xff\xff\xff\xff"};

void check_parsed(geometry::TriangleMesh mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) ASSERT_LT(v, mesh.positions.size());
  // What read_mesh() refuses before it repairs.
  for (const geometry::Vector3& p : mesh.positions)
    if (p.allFinite() && p.cwiseAbs().maxCoeff() > 1e15) return;
  geometry::repair(mesh);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) ASSERT_TRUE(mesh.positions[v].allFinite());
}

using Parser = base::Result<ParsedMesh> (*)(std::string_view, const std::string&, io::TimeBudget*);
struct Sample {
  const char* name;
  Parser parse;
  std::string bytes;
};

class MeshFuzz : public testing::TestWithParam<Sample> {};

TEST_P(MeshFuzz, DamagedFilesAreReadOrRefusedInOneLine) {
  base::Random random(20240229);
  int refused = 0;
  for (int i = 0; i < kVariants; ++i) {
    const auto parsed = GetParam().parse(damaged(GetParam().bytes, kNastyWords, random), "f", nullptr);
    if (parsed) {
      check_parsed(parsed->mesh);
    } else {
      ++refused;
      EXPECT_EQ(parsed.error().message.find('\n'), std::string::npos) << parsed.error().message;
      EXPECT_TRUE(parsed.error().message.starts_with("f:")) << parsed.error().message;
    }
  }
  EXPECT_GT(refused, kVariants / 20);
}

INSTANTIATE_TEST_SUITE_P(Files, MeshFuzz,
                         testing::Values(Sample{"obj", parse_obj, sample_obj()},
                                         Sample{"off", parse_off, sample_off()},
                                         Sample{"asciiply", parse_ply, sample_ascii_ply()},
                                         Sample{"littleply", parse_ply, sample_binary_ply(false)},
                                         Sample{"bigply", parse_ply, sample_binary_ply(true)},
                                         Sample{"asciistl", parse_stl, sample_ascii_stl()},
                                         Sample{"binarystl", parse_stl, sample_binary_stl()},
                                         Sample{"glb", parse_glb, sample_glb()}),
                         [](const auto& suite) { return std::string(suite.param.name); });

}  // namespace
}  // namespace icome::files
