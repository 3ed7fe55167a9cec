#include "geometry/csg/csg_surfaces.h"

#include <gtest/gtest.h>

#include <numeric>

#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace {

std::vector<CsgSurfaces::Index> all_surfaces(const CsgSurfaces& surfaces) {
  std::vector<CsgSurfaces::Index> all(surfaces.size());
  std::iota(all.begin(), all.end(), CsgSurfaces::Index{0});
  return all;
}

TEST(CsgSurfaces, MeshesHaveAPlaneForEachFlatFace) {
  base::Random random(5);
  CsgTree tree;
  tree.add_leaf(mesh_solid(box_mesh({-0.4, -0.3, -0.5}, {0.2, 0.5, 0.4})), random_affine(random, 1.0));
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  EXPECT_EQ(surfaces.size(), 6u);
  for (const auto surface : all_surfaces(surfaces)) {
    EXPECT_TRUE(surfaces.is_plane(surface));
    EXPECT_EQ(surfaces.like(surface), surface);
  }
}

TEST(CsgSurfaces, FlushFacesOfMeshesAndBoxesAreAlike) {
  // Side by side: the box's face at x = 0.5 and the mesh's look at each other, four others go on.
  CsgTree tree;
  const auto box = tree.add_leaf(Primitive(Box{Vector3::Constant(0.5)}));
  const auto mesh = tree.add_leaf(mesh_solid(box_mesh({0.5, -0.5, -0.5}, {1.5, 0.5, 0.5})));
  tree.add(CsgOperator::Union, box, mesh);
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  ASSERT_EQ(surfaces.size(), 12u);
  EXPECT_EQ(surfaces.unlike(all_surfaces(surfaces)).size(), 7u);
  int opposite = 0;
  for (const auto surface : all_surfaces(surfaces)) opposite += surfaces.opposite(surface) ? 1 : 0;
  EXPECT_EQ(opposite, 1);
}

TEST(CsgSurfaces, OnlyFacesNearABoxAreOpenThere) {
  CsgTree tree;
  tree.add_leaf(mesh_solid(box_mesh({-1, -1, -1}, {1, 1, 1})));
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  const auto near =
      surfaces.open(Bounds(Vector3(0.9, 0.9, 0.0), Vector3(1.1, 1.1, 0.2)), all_surfaces(surfaces));
  EXPECT_EQ(near.size(), 2u);
  EXPECT_EQ(surfaces.atoms(near), std::vector<std::uint32_t>{0});
  // In the plane of a face, but beside it.
  EXPECT_TRUE(
      surfaces.open(Bounds(Vector3(0.9, 2.0, 0.0), Vector3(1.1, 2.1, 0.2)), all_surfaces(surfaces)).empty());
}

}  // namespace
}  // namespace icome::geometry
