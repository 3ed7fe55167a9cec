#include "geometry/mesh/geodesic_sphere.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace icome::geometry {
namespace {

constexpr int kCorners = 12;
constexpr int kEdges = 30;

/// The icosahedron: three golden rectangles, each in a plane of two axes.
const std::array<Vector3, kCorners>& icosahedron_corners() {
  constexpr double kGolden = std::numbers::phi;
  static const std::array<Vector3, kCorners> kPositions{{{-1, kGolden, 0},
                                                         {1, kGolden, 0},
                                                         {-1, -kGolden, 0},
                                                         {1, -kGolden, 0},
                                                         {0, -1, kGolden},
                                                         {0, 1, kGolden},
                                                         {0, -1, -kGolden},
                                                         {0, 1, -kGolden},
                                                         {kGolden, 0, -1},
                                                         {kGolden, 0, 1},
                                                         {-kGolden, 0, -1},
                                                         {-kGolden, 0, 1}}};
  return kPositions;
}

/// The faces of the icosahedron, counter-clockwise seen from outside.
constexpr std::array<TriangleMesh::Triangle, 20> kFaces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// The number of each vertex of the subdivided icosahedron in the list of positions: the 12 corners,
/// then the inner vertices of the 30 edges, then those of the 20 faces. Numbers are computed, so that
/// faces share the vertices of an edge without a search.
class VertexNumbers {
 public:
  explicit VertexNumbers(int frequency) : frequency_(frequency) {
    int edges = 0;
    for (const auto& face : kFaces) {
      for (int i = 0; i < 3; ++i) {
        const auto a = face[i], b = face[(i + 1) % 3];
        if (a < b) edge_[a][b] = edge_[b][a] = edges++;
      }
    }
    assert(edges == kEdges);
  }

  /// Vertex `step` (0 to frequency) of the edge from corner `a` to corner `b`.
  std::uint32_t on_edge(std::uint32_t a, std::uint32_t b, int step) const {
    if (step == 0) return a;
    if (step == frequency_) return b;
    const int from_lower = a < b ? step : frequency_ - step;
    return kCorners + edge_[a][b] * (frequency_ - 1) + from_lower - 1;
  }

  /// The vertex of a face that lies `i` steps from its first corner towards the second, then `j`
  /// towards the third; i, j >= 0, i + j <= frequency.
  std::uint32_t in_face(int face, int i, int j) const {
    const auto& [a, b, c] = kFaces[face];
    if (j == 0) return on_edge(a, b, i);
    if (i == 0) return on_edge(a, c, j);
    if (i + j == frequency_) return on_edge(b, c, j);
    const int inner = frequency_ - 2;  // inner vertices of the longest row, j = 1
    const int rows_before = j - 1;     // each one shorter than the one before it
    return kCorners + kEdges * (frequency_ - 1) + face * (inner * (inner + 1) / 2) + rows_before * inner -
           rows_before * (rows_before - 1) / 2 + i - 1;
  }

 private:
  int frequency_;
  std::array<std::array<int, kCorners>, kCorners> edge_{};
};

Vector3 with_bumps(const Vector3& direction, double radius, double bump_height, int bumps) {
  const Vector3 unit = direction.normalized();
  const double field = std::sin(bumps * unit.x()) * std::sin(bumps * unit.y()) * std::sin(bumps * unit.z());
  return radius * (1.0 + bump_height * field) * unit;
}

/// Calls `visit(number, point)` once for every vertex with its point on the flat icosahedron, times
/// `frequency`.
template <typename Visit>
void for_each_vertex(const VertexNumbers& numbers, int frequency, const Visit& visit) {
  const auto& corners = icosahedron_corners();
  for (int corner = 0; corner < kCorners; ++corner) visit(corner, frequency * corners[corner]);
  for (int face = 0; face < static_cast<int>(kFaces.size()); ++face) {
    const auto& [a, b, c] = kFaces[face];
    for (int i = 0; i < 3; ++i) {
      const auto from = kFaces[face][i], to = kFaces[face][(i + 1) % 3];
      if (from > to) continue;  // the neighbouring face does this edge
      for (int step = 1; step < frequency; ++step) {
        visit(numbers.on_edge(from, to, step), (frequency - step) * corners[from] + step * corners[to]);
      }
    }
    for (int j = 1; j < frequency; ++j) {
      for (int i = 1; i + j < frequency; ++i) {
        visit(numbers.in_face(face, i, j),
              (frequency - i - j) * corners[a] + i * corners[b] + j * corners[c]);
      }
    }
  }
}

void add_triangles(const VertexNumbers& numbers, int frequency, int face, TriangleMesh& mesh) {
  for (int j = 0; j < frequency; ++j) {
    for (int i = 0; i + j < frequency; ++i) {
      const std::uint32_t here = numbers.in_face(face, i, j);
      const std::uint32_t next = numbers.in_face(face, i + 1, j);
      const std::uint32_t above = numbers.in_face(face, i, j + 1);
      mesh.triangles.push_back({here, next, above});
      if (i + j + 1 < frequency) mesh.triangles.push_back({next, numbers.in_face(face, i + 1, j + 1), above});
    }
  }
}

}  // namespace

TriangleMesh bumpy_geodesic_sphere(int frequency, double radius, double bump_height, int bumps) {
  assert(frequency >= 1 && frequency <= 10'000 && radius > 0.0 && std::abs(bump_height) < 1.0);
  const auto squared = static_cast<std::size_t>(frequency) * frequency;
  const VertexNumbers numbers(frequency);
  TriangleMesh mesh;
  mesh.positions.resize(10 * squared + 2);
  for_each_vertex(numbers, frequency, [&](std::uint32_t number, const Vector3& point) {
    mesh.positions[number] = with_bumps(point, radius, bump_height, bumps);
  });
  mesh.triangles.reserve(20 * squared);
  for (int face = 0; face < static_cast<int>(kFaces.size()); ++face) {
    add_triangles(numbers, frequency, face, mesh);
  }
  return mesh;
}

}  // namespace icome::geometry
