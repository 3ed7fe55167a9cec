#include "geometry/deform/triangle_subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "base/random.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/mesh/mesh_topology.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices every_triangle(const TriangleMesh& mesh) {
  Indices all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

Indices random_triangles(const TriangleMesh& mesh, double share, base::Random& random) {
  Indices chosen;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (random.uniform() < share) chosen.push_back(t);
  return chosen;
}

/// Twice the share of the parent that a piece covers, negative when it is turned over. Exact: all numbers
/// have few binary digits.
double share_of_parent(const TriangleSubdivision::Piece& piece) {
  const Vector2 a = piece.corners[0].cast<double>();
  const Vector2 ab = piece.corners[1].cast<double>() - a, ac = piece.corners[2].cast<double>() - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/// Summed in more digits than the meshes have: so many terms would lose some.
double exact_area(const TriangleMesh& mesh) {
  long double twice = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    twice += (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm();
  return double(twice / 2);
}

double exact_volume(const TriangleMesh& mesh) {
  long double six_volumes = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    six_volumes += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2)));
  return double(six_volumes / 6);
}

/// What holds for every subdivision.
void expect_sound(const TriangleMesh& mesh, const Indices& selection, int levels,
                  const TriangleSubdivision& result) {
  ASSERT_EQ(result.pieces.size(), result.mesh.triangles.size());
  ASSERT_GE(result.mesh.positions.size(), mesh.positions.size());
  EXPECT_TRUE(std::equal(mesh.positions.begin(), mesh.positions.end(), result.mesh.positions.begin()));
  const std::set<std::uint32_t> selected(selection.begin(), selection.end());
  std::vector<double> covered(mesh.triangles.size(), 0.0);
  std::size_t from_selection = 0;
  for (std::size_t t = 0; t < result.pieces.size(); ++t) {
    const TriangleSubdivision::Piece& piece = result.pieces[t];
    ASSERT_LT(piece.parent, mesh.triangles.size());
    if (t > 0) {
      EXPECT_GE(piece.parent, result.pieces[t - 1].parent);
    }
    EXPECT_EQ(piece.selected, selected.count(piece.parent) == 1);
    EXPECT_GT(share_of_parent(piece), 0.0);
    if (piece.selected) {
      EXPECT_EQ(share_of_parent(piece), std::pow(0.25, levels));
    }
    from_selection += piece.selected;
    covered[piece.parent] += share_of_parent(piece);
    const std::array<Vector3, 3> parent = {mesh.corner(piece.parent, 0), mesh.corner(piece.parent, 1),
                                           mesh.corner(piece.parent, 2)};
    const double size = std::max({parent[0].norm(), parent[1].norm(), parent[2].norm()});
    for (int i = 0; i < 3; ++i)
      EXPECT_LE((blend_corners(parent, piece.corners[i]) - result.mesh.corner(t, i)).norm(), 1e-14 * size);
  }
  EXPECT_EQ(from_selection, selected.size() << (2 * levels));
  EXPECT_EQ(covered, std::vector<double>(mesh.triangles.size(), 1.0));
  EXPECT_NEAR(exact_area(result.mesh), exact_area(mesh), 1e-13 * exact_area(mesh));
}

/// Does a vertex of the mesh lie inside an edge of it? Exact where coordinates have few binary digits.
bool has_t_vertex(const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vector3& a = mesh.positions[triangle[i]];
      const Vector3 along = mesh.positions[triangle[(i + 1) % 3]] - a;
      for (const Vector3& p : mesh.positions) {
        const double at = (p - a).dot(along);
        if ((p - a).cross(along) == Vector3::Zero() && at > 0 && at < along.squaredNorm()) return true;
      }
    }
  }
  return false;
}

TEST(TriangleSubdivision, OneOfTwoTrianglesCutsTheOtherInTwo) {
  const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto result = subdivide_triangles(square, Indices{0}, 1);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->mesh.positions.size(), 7U);
  EXPECT_EQ(result->mesh.positions[4], Vector3(0.5, 0, 0));
  EXPECT_EQ(result->mesh.positions[5], Vector3(0.5, 0.5, 0));
  EXPECT_EQ(result->mesh.positions[6], Vector3(1, 0.5, 0));
  const std::vector<TriangleMesh::Triangle> wanted = {{0, 4, 5}, {4, 1, 6}, {5, 6, 2},
                                                      {4, 6, 5}, {0, 5, 3}, {5, 2, 3}};
  EXPECT_EQ(result->mesh.triangles, wanted);
  EXPECT_EQ(result->pieces[5].parent, 1U);
  EXPECT_FALSE(result->pieces[5].selected);
  EXPECT_EQ(result->pieces[5].corners[0], Eigen::Vector2f(0.5F, 0));
}

TEST(TriangleSubdivision, TwoCutSidesLeaveThreePiecesAlongTheShorterDiagonal) {
  // The middle triangle's sides to its neighbours are cut; the whole side is that from vertex 0 to 1.
  for (const double lean : {-0.75, 0.75}) {
    const TriangleMesh mesh{{{-1, 0, 0}, {1, 0, 0}, {lean, 1, 0}, {3, 1, 0}, {-3, 1, 0}},
                            {{0, 1, 2}, {1, 3, 2}, {0, 2, 4}}};
    const auto result = subdivide_triangles(mesh, Indices{1, 2}, 1);
    ASSERT_TRUE(result);
    expect_sound(mesh, {1, 2}, 1, *result);
    const auto pieces = std::ranges::count(result->pieces, 0U, &TriangleSubdivision::Piece::parent);
    EXPECT_EQ(pieces, 3);
    // From the foot on the side that the apex leans to, to the middle of the far side.
    const std::uint32_t foot = lean < 0 ? 0 : 1;
    const Vector3 far_middle = 0.5 * (mesh.positions[1 - foot] + mesh.positions[2]);
    const double other = (0.5 * (mesh.positions[foot] + mesh.positions[2]) - mesh.positions[1 - foot]).norm();
    ASSERT_NE((far_middle - mesh.positions[foot]).norm(), other);
    const std::uint32_t from = (far_middle - mesh.positions[foot]).norm() < other ? foot : 1 - foot;
    int at_from = 0;
    for (int t = 0; t < 3; ++t) at_from += int(std::ranges::count(result->mesh.triangles[t], from));
    EXPECT_EQ(at_from, 2);
  }
}

TEST(TriangleSubdivision, RandomSelectionsOfAClosedMeshStayClosedAndSound) {
  base::Random random(61);
  const TriangleMesh mesh = bumpy_geodesic_sphere(5, 0.3, 0.2, 3);
  const std::int64_t euler = euler_characteristic(mesh);
  for (int levels = 0; levels <= 5; ++levels) {
    for (const double share : {0.01, 0.2, 0.6, 1.0}) {
      const Indices selection = random_triangles(mesh, share, random);
      const auto result = subdivide_triangles(mesh, selection, levels);
      ASSERT_TRUE(result) << result.error().message;
      expect_sound(mesh, selection, levels, *result);
      EXPECT_TRUE(is_closed(result->mesh));
      EXPECT_EQ(euler_characteristic(result->mesh), euler);
      EXPECT_EQ(analyse_topology(result->mesh).report.non_manifold_edges, 0U);
      EXPECT_NEAR(exact_volume(result->mesh), exact_volume(mesh), 1e-13 * exact_volume(mesh));
    }
  }
}

TEST(TriangleSubdivision, WhatDoesNotTouchTheSelectionIsLeftAlone) {
  base::Random random(62);
  const TriangleMesh mesh = bumpy_geodesic_sphere(6, 1.0, 0.0, 1);
  const EdgeNeighbours neighbours = edge_neighbours(mesh);
  const Indices selection = random_triangles(mesh, 0.1, random);
  std::set<std::uint32_t> touched(selection.begin(), selection.end());
  for (const std::uint32_t t : selection) touched.insert(neighbours[t].begin(), neighbours[t].end());
  for (int levels = 1; levels <= 3; ++levels) {
    const auto result = subdivide_triangles(mesh, selection, levels);
    ASSERT_TRUE(result);
    std::map<std::uint32_t, int> pieces;
    for (const auto& piece : result->pieces) ++pieces[piece.parent];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_EQ(pieces[t] > 1, touched.count(t) == 1);
  }
}

TEST(TriangleSubdivision, NoVertexLiesInsideAnEdge) {
  base::Random random(63);
  TriangleMesh grid;  // open, of integer coordinates so that the test is exact
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) grid.positions.emplace_back(x, y, x * y % 3);
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      const std::uint32_t a = 5 * y + x;
      grid.triangles.push_back({a, a + 1, a + 6});
      grid.triangles.push_back({a, a + 6, a + 5});
    }
  }
  for (const TriangleMesh& mesh : {grid, unit_box(), turned(unit_box())}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Indices selection = random_triangles(mesh, random.uniform(), random);
      const int levels = int(random.index(3));
      const auto result = subdivide_triangles(mesh, selection, levels);
      ASSERT_TRUE(result);
      expect_sound(mesh, selection, levels, *result);
      EXPECT_FALSE(has_t_vertex(result->mesh));
      EXPECT_EQ(analyse_topology(result->mesh).report.inconsistent_edges, 0U);
    }
  }
}

TEST(TriangleSubdivision, AllTrianglesOfAnEdgeShareItsMiddle) {
  // Four leaves of a book: an edge of four triangles.
  const TriangleMesh book{{{0, 0, 0}, {0, 0, 2}, {2, 0, 1}, {0, 2, 1}, {-2, 0, 1}, {0, -2, 1}},
                          {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 5}}};
  for (int levels = 0; levels <= 4; ++levels) {
    const auto result = subdivide_triangles(book, Indices{2}, levels);
    ASSERT_TRUE(result);
    expect_sound(book, {2}, levels, *result);
    EXPECT_FALSE(has_t_vertex(result->mesh));
    const MeshReport report = analyse_topology(result->mesh).report;
    EXPECT_EQ(report.non_manifold_edges, std::size_t(1) << levels);
    EXPECT_EQ(report.components, 1U);
    const auto on_spine = std::ranges::count_if(result->mesh.positions,
                                                [](const Vector3& p) { return p.x() == 0 && p.y() == 0; });
    EXPECT_EQ(on_spine, (1 << levels) + 1);
  }
}

TEST(TriangleSubdivision, OpenBordersAndOneSidedStripsStayAsTheyAre) {
  base::Random random(64);
  for (const bool twisted : {false, true}) {
    const TriangleMesh mesh = ring(12, twisted);
    const MeshReport before = analyse_topology(mesh).report;
    for (int levels = 1; levels <= 5; ++levels) {
      const Indices selection = random_triangles(mesh, 0.4, random);
      const auto result = subdivide_triangles(mesh, selection, levels);
      ASSERT_TRUE(result);
      expect_sound(mesh, selection, levels, *result);
      const MeshReport after = analyse_topology(result->mesh).report;
      EXPECT_EQ(after.non_manifold_edges, 0U);
      EXPECT_EQ(after.components, before.components);
      EXPECT_EQ(after.orientable, before.orientable);
    }
    const auto whole = subdivide_triangles(mesh, every_triangle(mesh), 3);
    ASSERT_TRUE(whole);
    EXPECT_EQ(analyse_topology(whole->mesh).report.boundary_edges, 8 * before.boundary_edges);
  }
}

TEST(TriangleSubdivision, TheSameSelectionInAnyOrderGivesTheSameMesh) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(4, 1.0, 0.1, 2);
  const auto one = subdivide_triangles(mesh, Indices{5, 9, 100}, 2);
  const auto other = subdivide_triangles(mesh, Indices{100, 5, 9, 5}, 2);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->mesh.positions, other->mesh.positions);
  EXPECT_EQ(one->mesh.triangles, other->mesh.triangles);
}

TEST(TriangleSubdivision, CornerValuesAreCarriedOverWithoutSeams) {
  base::Random random(65);
  const TriangleMesh mesh = bumpy_geodesic_sphere(3, 1.0, 0.1, 2);
  std::vector<Vector2> value(mesh.positions.size());
  for (Vector2& v : value) v = {random.uniform(-3, 3), 0.1};
  std::vector<std::array<Vector2, 3>> at_corners;
  std::vector<std::array<std::array<float, 3>, 3>> colours;
  for (const auto& [a, b, c] : mesh.triangles) {
    at_corners.push_back({value[a], value[b], value[c]});
    colours.push_back({{{0.1F, 0, 1}, {0.1F, 1, 1}, {0.1F, 0.5F, 0}}});
  }
  const auto result = subdivide_triangles(mesh, random_triangles(mesh, 0.5, random), 3);
  ASSERT_TRUE(result);
  const auto carried = carry_corners(*result, at_corners);
  ASSERT_EQ(carried.size(), result->mesh.triangles.size());
  std::map<std::uint32_t, Vector2> seen;
  for (std::size_t t = 0; t < carried.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = result->mesh.triangles[t][i];
      const Vector2& first = seen.try_emplace(v, carried[t][i]).first->second;
      EXPECT_EQ(first, carried[t][i]);  // to the last digit, from whichever triangle
      EXPECT_EQ(carried[t][i].y(), 0.1);
      if (v < value.size()) {
        EXPECT_EQ(carried[t][i], value[v]);
      }
    }
  }
  for (const auto& corners : carry_corners(*result, colours))
    for (const auto& colour : corners) EXPECT_EQ(colour[0], 0.1F);
  EXPECT_TRUE(carry_corners(*result, std::vector<std::array<Vector3, 3>>{}).empty());
}

TEST(TriangleSubdivision, TrianglesThatNameAVertexTwiceKeepTheOthersWhole) {
  TriangleMesh mesh = unit_box();
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({5, 5, 5});
  const auto result = subdivide_triangles(mesh, every_triangle(mesh), 2);
  ASSERT_TRUE(result);
  EXPECT_NEAR(signed_volume(result->mesh), 1.0, 1e-12);
  EXPECT_TRUE(analyse_topology(result->mesh).report.closed);
  EXPECT_EQ(result->pieces.size(), 14U * 16U);
  const auto neighbour = subdivide_triangles(mesh, Indices{0, 1}, 2);
  ASSERT_TRUE(neighbour);
  EXPECT_TRUE(analyse_topology(neighbour->mesh).report.closed);
  EXPECT_EQ(analyse_topology(neighbour->mesh).report.non_manifold_edges, 0U);
}

TEST(TriangleSubdivision, EnormousAndTinyCoordinatesStayFinite) {
  for (const double size : {1.7e308, 1e-300}) {
    const TriangleMesh mesh{{{-size, 0, 0}, {size, 0, 0}, {size, size, 0}, {-size, size, size}},
                            {{0, 1, 2}, {0, 2, 3}}};
    const auto result = subdivide_triangles(mesh, Indices{0}, 3);
    ASSERT_TRUE(result);
    for (const Vector3& p : result->mesh.positions) EXPECT_TRUE(p.allFinite());
  }
}

TEST(TriangleSubdivision, AMillionTriangles) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(56, 0.5, 0.1, 3);
  const auto result = subdivide_triangles(mesh, every_triangle(mesh), 2);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.triangles.size(), 16 * mesh.triangles.size());
  EXPECT_EQ(result->mesh.positions.size(), 8 * mesh.triangles.size() + 2);
  EXPECT_TRUE(is_closed(result->mesh));
  EXPECT_NEAR(exact_volume(result->mesh), exact_volume(mesh), 1e-13 * exact_volume(mesh));
}

TEST(TriangleSubdivision, RefusesWhatItCannotDo) {
  const TriangleMesh box = unit_box();
  const auto message = [](const base::Result<TriangleSubdivision>& result) {
    return result ? std::string() : result.error().message;
  };
  EXPECT_NE(message(subdivide_triangles(box, Indices{0}, -1)).find("0 or more"), std::string::npos);
  EXPECT_NE(message(subdivide_triangles(box, Indices{12}, 1)).find("triangle 12 is not there"),
            std::string::npos);
  EXPECT_NE(message(subdivide_triangles(box, Indices{0}, 13)).find("20 million"), std::string::npos);
  EXPECT_FALSE(subdivide_triangles(box, Indices{0}, std::numeric_limits<int>::max()));
  TriangleMesh broken = box;
  broken.triangles[3][1] = 8;
  EXPECT_NE(message(subdivide_triangles(broken, Indices{0}, 1)).find("vertex 8"), std::string::npos);
  broken = box;
  broken.positions[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(subdivide_triangles(broken, Indices{0}, 1)).find("vertex 2"), std::string::npos);

  // Nothing to do is not too much.
  const auto untouched = subdivide_triangles(box, {}, std::numeric_limits<int>::max());
  ASSERT_TRUE(untouched);
  EXPECT_EQ(untouched->mesh.triangles, box.triangles);
  EXPECT_TRUE(subdivide_triangles(TriangleMesh{}, {}, 3));
}

TEST(TriangleSubdivision, NeighboursCountTowardsTheLimit) {
  // The selection alone stays below the limit, but each cut spine edge cuts all leaves of the book.
  TriangleMesh book{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (std::uint32_t leaf = 0; leaf < 20'000; ++leaf) {
    book.positions.emplace_back(std::cos(leaf), std::sin(leaf), 0.5);
    book.triangles.push_back({0, 1, leaf + 2});
  }
  EXPECT_FALSE(subdivide_triangles(book, Indices{7}, 10));  // 4^10 + 19,999 * 2^10
  const auto few = subdivide_triangles(book, Indices{7}, 3);
  ASSERT_TRUE(few);
  EXPECT_EQ(few->pieces.size(), 64U + 19'999U * 8U);
}

}  // namespace
}  // namespace icome::geometry
