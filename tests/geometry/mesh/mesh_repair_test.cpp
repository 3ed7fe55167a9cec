#include "geometry/mesh/mesh_repair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

using Lines = std::vector<std::string>;

TEST(MeshRepair, SoundMeshIsLeftAloneAndHasNothingToSay) {
  TriangleMesh mesh = unit_box();
  const RepairReport report = repair(mesh);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(report.sentences(), Lines{});
  EXPECT_EQ(mesh.positions, unit_box().positions);
  EXPECT_EQ(mesh.triangles, unit_box().triangles);
}

TEST(MeshRepair, SoupIsWeldedIntoAClosedSurface) {
  TriangleMesh mesh = soup(unit_box());
  mesh.positions[0] = {-0.0, 0.0, -0.0};  // equal to 0, though its bits are not
  const RepairReport report = repair(mesh);
  EXPECT_EQ(mesh.positions.size(), 8U);
  EXPECT_EQ(report.welded_vertices, 28U);
  EXPECT_TRUE(report.surface.closed);
  EXPECT_EQ(report.sentences(), Lines{"28 duplicate vertices welded"});
}

TEST(MeshRepair, TrianglesWithNonFiniteVerticesAreDropped) {
  TriangleMesh mesh = unit_box();
  mesh.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.non_finite_vertices, 1U);
  EXPECT_EQ(report.non_finite_faces, 6U);  // two a side: every diagonal here runs to vertex 0 or 7
  EXPECT_EQ(mesh.triangles.size(), 6U);
  for (const Vector3& position : mesh.positions) EXPECT_TRUE(position.allFinite());
}

TEST(MeshRepair, NothingMayBeLeft) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  const RepairReport report = repair(mesh);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(report.degenerate_faces, 1U);
}

/// A unit square whose lower edge is split on one side only: the flat triangle 0-4-1 fills the gap.
TriangleMesh square_with_flat_triangle() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}};
  return mesh;
}

TEST(MeshRepair, FlatTriangleIsMergedIntoItsNeighbourSoThatNoCrackOpens) {
  TriangleMesh mesh = square_with_flat_triangle();
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.flipped_edges, 1U);
  EXPECT_EQ(report.degenerate_faces, 0U);
  EXPECT_EQ(report.surface.boundary_edges, 5U);
  EXPECT_DOUBLE_EQ(surface_area(mesh), 1.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 normal =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    EXPECT_GT(std::abs(normal.z()), 0.1) << "triangle " << t << " is flat";
  }
}

TEST(MeshRepair, FlatTriangleOnItsOwnIsDropped) {
  TriangleMesh mesh = together(unit_box(), TriangleMesh{{{5, 0, 0}, {6, 0, 0}, {7, 0, 0}}, {{0, 1, 2}}});
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.sentences(), (Lines{"1 degenerate face dropped", "3 unused vertices removed"}));
}

TEST(MeshRepair, SliversOfFarLessThanAMillimetreAreKept) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(repair(mesh).degenerate_faces, 0U);
}

TEST(MeshRepair, RepeatedTriangleIsDroppedWhicheverCornerItBeginsWith) {
  TriangleMesh mesh = unit_box();
  const auto [a, b, c] = mesh.triangles[3];
  mesh.triangles.push_back({b, c, a});
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.duplicate_faces, 1U);
  EXPECT_EQ(mesh.triangles, unit_box().triangles);
}

TEST(MeshRepair, SheetOfTwoSidesKeepsBoth) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_FALSE(repair(mesh).changed());
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(MeshRepair, CracksOfRoundingAreWeldedAndRealGapsAreNot) {
  for (const auto& [gap, closes] : {std::pair{3e-8, true}, std::pair{1e-5, false}}) {
    TriangleMesh mesh = soup(unit_box());
    for (std::size_t v = 0; v < 6; ++v) mesh.positions[v].z() -= gap;  // lifts off the bottom face
    EXPECT_EQ(repair(mesh).surface.closed, closes) << gap;
  }
}

TEST(MeshRepair, DisagreeingTriangleIsTurned) {
  TriangleMesh mesh = unit_box();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.rewound_faces, 1U);
  EXPECT_EQ(report.surface.inconsistent_edges, 0U);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0);
}

TEST(MeshRepair, InsideOutBoxIsTurned) {
  TriangleMesh mesh = turned(unit_box());
  const RepairReport report = repair(mesh);
  EXPECT_EQ(report.sentences(), Lines{"1 inside-out part turned"});
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0);
}

TEST(MeshRepair, InsideOutBoxWithASmallHoleIsTurnedAndABowlIsNot) {
  TriangleMesh mesh = turned(unit_box());
  mesh.triangles.pop_back();
  EXPECT_EQ(repair(mesh).turned_parts, 1U);
  TriangleMesh bowl = turned(unit_box());
  bowl.triangles.erase(bowl.triangles.begin() + 2, bowl.triangles.begin() + 4);  // the whole lid
  EXPECT_EQ(repair(bowl).turned_parts, 0U);
}

const TriangleMesh kCavity = turned(box_mesh({1, 1, 1}, {3, 3, 3}));
const TriangleMesh kShell = together(box_mesh({0, 0, 0}, {4, 4, 4}), kCavity);

TEST(MeshRepair, CavityStaysACavity) {
  TriangleMesh mesh = kShell;
  EXPECT_FALSE(repair(mesh).changed());
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 64.0 - 8.0);
}

TEST(MeshRepair, InsideOutShellIsTurnedWithItsCavityAndWhatFloatsInIt) {
  const TriangleMesh pebble = box_mesh({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  TriangleMesh mesh = turned(together(kShell, pebble));
  EXPECT_EQ(repair(mesh).turned_parts, 3U);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 64.0 - 8.0 + 1.0);
}

TEST(MeshRepair, InsideOutPartBesideASoundOneIsTurnedAlone) {
  TriangleMesh mesh = together(unit_box(), turned(box_mesh({2, 0, 0}, {3, 1, 1})));
  EXPECT_EQ(repair(mesh).turned_parts, 1U);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 2.0);
}

TEST(MeshRepair, MoebiusStripIsKeptAndReported) {
  TriangleMesh mesh = ring(12, true);
  const std::vector<TriangleMesh::Triangle> before = mesh.triangles;
  const RepairReport report = repair(mesh);
  EXPECT_EQ(mesh.triangles, before);
  EXPECT_EQ(report.sentences(),
            (Lines{"the surface is open: 24 boundary edges",
                   "1 part is one-sided, like a Moebius strip: fronts cannot be made to agree"}));
}

TEST(MeshRepair, SizeOfTheModelChangesNothing) {
  for (const double scale : {1e-9, 1e-3, 1.0, 1e6}) {
    TriangleMesh mesh = together(turned(soup(square_with_flat_triangle())), soup(kShell));
    for (Vector3& position : mesh.positions) position *= scale;
    const RepairReport report = repair(mesh);
    EXPECT_EQ(report.flipped_edges, 1U) << scale;
    EXPECT_EQ(report.surface.boundary_edges, 5U) << scale;
    EXPECT_EQ(mesh.positions.size(), 5U + 16U - 1U) << scale;  // the two parts meet at the origin
  }
}

TEST(MeshRepair, ASecondRepairFindsNothing) {
  TriangleMesh mesh = together(turned(soup(square_with_flat_triangle())), turned(soup(kShell)));
  EXPECT_TRUE(repair(mesh).changed());
  EXPECT_FALSE(repair(mesh).changed());
}

}  // namespace
}  // namespace icome::geometry
