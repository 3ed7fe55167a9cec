#pragma once
#include <gtest/gtest.h>

#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {

inline void expect_closed(const TriangleMesh& mesh) {
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0u);
  EXPECT_TRUE(is_closed(mesh));
}

/// The mesh of a tree, which must be closed.
inline ContourMesh csg_meshed(const CsgTree& tree, double cell) {
  auto made = contour(tree, {.cell = cell});
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message);
  if (!made) return {};
  expect_closed(made->mesh);
  return std::move(*made);
}

}  // namespace icome::geometry
