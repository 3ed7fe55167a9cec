// Every shared .csg file that can be read, as a closed mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "files/csg/csg_reader.h"
#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/mesh/mesh_topology.h"
#include "places.h"
#include "repeats.h"

namespace icome::files {
namespace {

// Sanitizers take a minute for a file of 41 primitives.
#ifdef ICOME_ADDRESS_SANITIZER
constexpr std::size_t kMostPrimitives = 40;
#else
constexpr std::size_t kMostPrimitives = 150;
#endif

using geometry::Bounds;
using geometry::CsgTree;
using geometry::Vector3;

/// The share of the box that the solid fills, by throws of dice.
double filled_share(const CsgTree& tree, const Bounds& box, int throws) {
  base::Random random(1);
  int hits = 0;
  for (int i = 0; i < throws; ++i) {
    const Vector3 part(random.uniform(), random.uniform(), random.uniform());
    hits += inside(tree, box.min() + part.cwiseProduct(box.sizes()));
  }
  return static_cast<double>(hits) / throws;
}

void expect_meshed(const CsgTree& tree) {
  const Bounds box = bounds(tree);
  if (box.isEmpty()) return;
  const double cell = box.diagonal().norm() / 40;
  const auto made = contour(tree, {.cell = cell});
  ASSERT_TRUE(made) << made.error().message;
  const geometry::MeshReport report = analyse_topology(made->mesh).report;
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0U);
  EXPECT_LT(made->error, 2 * cell);

  constexpr int kThrows = 5000;
  const double share = filled_share(tree, box, kThrows);
  const double spread = std::sqrt(share * (1 - share) / kThrows);
  const double thin = 0.2 * cell * surface_area(made->mesh) / box.volume();  // what a coarse grid may miss
  EXPECT_NEAR(signed_volume(made->mesh) / box.volume(), share, 5 * spread + thin + 0.01);
}

struct SharedSolid {
  std::string file;
  CsgTree tree;
};

/// Those that can be read, less the files of hundreds of bars thinner than a cell: nothing to compare, and
/// slow.
std::vector<SharedSolid> shared_solids(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<SharedSolid> solids;
  for (const std::filesystem::path& file : files) {
    auto loaded = read_csg(file);
    if (!loaded || count(loaded->tree).primitives > kMostPrimitives) continue;
    solids.push_back({file.filename().string(), std::move(loaded->tree)});
  }
  return solids;
}

/// Every so many of them, in a test of its own: shards share them out.
constexpr std::size_t kRounds = 6;
class CsgMeshData : public testing::TestWithParam<std::size_t> {};

TEST_P(CsgMeshData, SharedFilesGiveClosedMeshes) {
  const std::filesystem::path data = places::shared_data() / "csg" / "pure";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the shared data is not there: " << data;
  const std::vector<SharedSolid> solids = shared_solids(data);
  EXPECT_GE(solids.size(), 20U);
  const std::size_t step = kSanitizerShare > 1 ? 3 * kRounds : kRounds;
  for (std::size_t i = GetParam(); i < solids.size(); i += step) {
    SCOPED_TRACE(solids[i].file);
    expect_meshed(solids[i].tree);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, CsgMeshData, testing::Range(std::size_t{0}, kRounds));

}  // namespace
}  // namespace icome::files
