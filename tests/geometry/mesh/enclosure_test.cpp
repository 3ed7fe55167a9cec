#include "geometry/mesh/enclosure.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

TEST(Enclosure, RandomPointsInANestOfBoxes) {
  // Boxes from -k to k, k = 1, 2, 3: a point at largest coordinate m is in those with k > m.
  TriangleMesh mesh;
  std::vector<std::uint32_t> parts;
  for (std::uint32_t k = 1; k <= 3; ++k) {
    mesh = together(mesh, box_mesh(Vector3::Constant(-double(k)), Vector3::Constant(double(k))));
    parts.insert(parts.end(), 12, k);
  }
  base::Random random(3);
  std::vector<EnclosureQuery> queries;
  for (int i = 0; i < 500; ++i)
    queries.push_back({{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)}, 0});
  const std::vector<bool> odd = enclosed(mesh, parts, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double m = queries[i].point.cwiseAbs().maxCoeff();
    EXPECT_EQ(odd[i], ((m < 1) + (m < 2) + (m < 3)) % 2 == 1) << queries[i].point.transpose();
  }
}

TEST(Enclosure, RayThroughEdgesAndVerticesCountsThemOnce) {
  const TriangleMesh mesh = unit_box();
  const std::vector<std::uint32_t> parts(12, 1);
  // Below the box's diagonal, its middle, and inside it on the diagonal.
  const std::vector<EnclosureQuery> queries{
      {{0.25, 0.25, -1}, 0}, {{0.5, 0.5, 0.5}, 0}, {{0.25, 0.25, 0.5}, 0}};
  EXPECT_EQ(enclosed(mesh, parts, queries), (std::vector<bool>{false, true, true}));
}

TEST(Enclosure, APartDoesNotEncloseItself) {
  const std::vector<EnclosureQuery> queries{{{0.5, 0.5, 0.5}, 1}};
  EXPECT_EQ(enclosed(unit_box(), std::vector<std::uint32_t>(12, 1), queries), std::vector<bool>{false});
}

}  // namespace
}  // namespace icome::geometry
