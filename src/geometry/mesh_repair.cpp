#include "geometry/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/enclosure.h"

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Height of a triangle over its longest edge, as a share of that edge, below which it has no area.
constexpr double kFlatness = 1e-12;

/// Turning an edge can leave a flat triangle on the next one; chains longer than this are rare.
constexpr int kMaximumFlipRounds = 16;

/// Removes the triangles for which `unwanted(triangle)` holds; returns how many.
template <typename Predicate>
std::size_t drop_triangles(TriangleMesh& mesh, Predicate unwanted) {
  const auto first_dropped = std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), unwanted);
  const auto dropped = static_cast<std::size_t>(mesh.triangles.end() - first_dropped);
  mesh.triangles.erase(first_dropped, mesh.triangles.end());
  return dropped;
}

/// Removes vertices that no triangle uses, keeping the order of the others.
void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint32_t> renamed(mesh.positions.size(), kNoTriangle);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle) renamed[index] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == kNoTriangle) continue;
    mesh.positions[kept] = mesh.positions[v];
    renamed[v] = kept++;
  }
  mesh.positions.resize(kept);
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& index : triangle) index = renamed[index];
}

void drop_non_finite(TriangleMesh& mesh, RepairReport& report) {
  for (const Vector3& position : mesh.positions) report.non_finite_vertices += !position.allFinite();
  if (report.non_finite_vertices == 0) return;
  report.non_finite_faces = drop_triangles(mesh, [&](const Triangle& triangle) {
    return std::ranges::any_of(triangle, [&](std::uint32_t v) { return !mesh.positions[v].allFinite(); });
  });
}

std::uint64_t position_hash(const Vector3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Adding +0 turns -0 into +0: they are equal and must hash alike.
    hash = (hash ^ std::bit_cast<std::uint64_t>(position[axis] + 0.0)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

/// For each vertex the first one at exactly its position (itself when it is the first). Non-finite
/// vertices equal nothing. An open-addressing hash table: one probe a vertex on average.
std::vector<std::uint32_t> first_at_position(const std::vector<Vector3>& positions) {
  std::vector<std::uint32_t> first(positions.size());
  const std::size_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
  std::vector<std::uint32_t> slots(mask + 1, kNoTriangle);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    first[v] = v;
    if (!positions[v].allFinite()) continue;
    std::size_t slot = position_hash(positions[v]) & mask;
    while (slots[slot] != kNoTriangle && positions[slots[slot]] != positions[v]) slot = (slot + 1) & mask;
    if (slots[slot] == kNoTriangle) slots[slot] = v;
    first[v] = slots[slot];
  }
  return first;
}

void weld(TriangleMesh& mesh, RepairReport& report) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.positions);
  for (std::uint32_t v = 0; v < first.size(); ++v) report.welded_vertices += first[v] != v;
  if (report.welded_vertices == 0) return;
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& index : triangle) index = first[index];
}

bool repeats_a_vertex(const Triangle& triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

/// Which edge of the triangle is longest.
int longest_edge(const TriangleMesh& mesh, const Triangle& triangle) {
  std::array<double, 3> squared_lengths{};
  for (int i = 0; i < 3; ++i)
    squared_lengths[i] = (mesh.positions[triangle[(i + 1) % 3]] - mesh.positions[triangle[i]]).squaredNorm();
  return static_cast<int>(std::ranges::max_element(squared_lengths) - squared_lengths.begin());
}

bool flat(const TriangleMesh& mesh, const Triangle& triangle) {
  if (repeats_a_vertex(triangle)) return true;
  const int edge = longest_edge(mesh, triangle);
  const Vector3& from = mesh.positions[triangle[edge]];
  const Vector3 along = mesh.positions[triangle[(edge + 1) % 3]] - from;
  const Vector3 aside = mesh.positions[triangle[(edge + 2) % 3]] - from;
  return along.cross(aside).squaredNorm() <=
         kFlatness * kFlatness * along.squaredNorm() * along.squaredNorm();
}

/// The corner of `triangle` that is neither `a` nor `b`.
std::uint32_t opposite(const Triangle& triangle, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : triangle)
    if (v != a && v != b) return v;
  return a;
}

/// Replaces the edge that a flat triangle lies on by the one across: flat (a, b, c) with b on edge c-a,
/// and its neighbour with corners a, c, d, become a, b, d and b, c, d, wound like the neighbour.
void turn_edge(TriangleMesh& mesh, std::uint32_t flat_triangle, int edge, std::uint32_t neighbour) {
  const Triangle old = mesh.triangles[flat_triangle];
  const std::uint32_t c = old[edge];
  const std::uint32_t a = old[(edge + 1) % 3];
  const std::uint32_t b = old[(edge + 2) % 3];
  Triangle near_a = mesh.triangles[neighbour];
  Triangle near_c = near_a;
  std::ranges::replace(near_a, c, b);
  std::ranges::replace(near_c, a, b);
  mesh.triangles[flat_triangle] = near_a;
  mesh.triangles[neighbour] = near_c;
}

/// Turns the edges under flat triangles, each triangle at most once in a round (neighbours go stale).
std::size_t flip_round(TriangleMesh& mesh, const std::vector<std::uint32_t>& flat_triangles) {
  const EdgeNeighbours neighbours = edge_neighbours(mesh);
  std::vector<bool> touched(mesh.triangles.size(), false);
  std::size_t flips = 0;
  for (const std::uint32_t t : flat_triangles) {
    const int edge = longest_edge(mesh, mesh.triangles[t]);
    const std::uint32_t other = neighbours[t][edge];
    if (other == kNoTriangle || touched[t] || touched[other]) continue;
    const Triangle& corners = mesh.triangles[t];
    const std::uint32_t tip = corners[(edge + 2) % 3];
    if (opposite(mesh.triangles[other], corners[edge], corners[(edge + 1) % 3]) == tip) continue;
    turn_edge(mesh, t, edge, other);
    touched[t] = touched[other] = true;
    ++flips;
  }
  return flips;
}

/// A flat triangle with three different corners closes the gap between one long edge and two short ones.
/// Dropping it would open the surface there, so the neighbour on the long edge is split instead.
void save_or_drop_flat(TriangleMesh& mesh, RepairReport& report) {
  report.degenerate_faces = drop_triangles(mesh, repeats_a_vertex);
  for (int round = 0; round < kMaximumFlipRounds; ++round) {
    std::vector<std::uint32_t> flat_triangles;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (flat(mesh, mesh.triangles[t])) flat_triangles.push_back(t);
    if (flat_triangles.empty()) return;
    const std::size_t flips = flip_round(mesh, flat_triangles);
    report.flipped_edges += flips;
    if (flips == 0) break;
  }
  report.degenerate_faces += drop_triangles(mesh, [&](const Triangle& t) { return flat(mesh, t); });
}

/// The triangle's corners from the lowest index on, in their cyclic order.
Triangle from_lowest(const Triangle& triangle) {
  const auto lowest = std::ranges::min_element(triangle);
  Triangle turned = triangle;
  std::ranges::rotate(turned, turned.begin() + (lowest - triangle.begin()));
  return turned;
}

/// Keeps the first of each set of triangles with the same corners in the same cyclic order. Grouped by
/// lowest corner with a counting sort, then compared within the group.
void drop_duplicates(TriangleMesh& mesh, RepairReport& report) {
  std::vector<std::uint32_t> first(mesh.positions.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) ++first[*std::ranges::min_element(triangle) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  std::vector<std::pair<Triangle, std::uint32_t>> sorted(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle turned = from_lowest(mesh.triangles[t]);
    sorted[next[turned[0]]++] = {turned, t};
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
    std::sort(sorted.begin() + first[v], sorted.begin() + first[v + 1]);
  std::vector<bool> repeated(mesh.triangles.size(), false);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    repeated[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  std::size_t t = 0;
  report.duplicate_faces = drop_triangles(mesh, [&](const Triangle&) { return repeated[t++]; });
}

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

/// True for each patch whose own triangles meet every edge an even number of times.
std::vector<bool> closed_patches(const TriangleMesh& mesh, const Patches& patches,
                                 const EdgeNeighbours& neighbours) {
  // Only edges without a neighbour need counting, and only within their patch.
  std::vector<std::array<std::uint32_t, 3>> loose;  // patch, low vertex, high vertex
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int side = 0; side < 3; ++side) {
      if (neighbours[t][side] != kNoTriangle) continue;
      const auto [low, high] = std::minmax(mesh.triangles[t][side], mesh.triangles[t][(side + 1) % 3]);
      loose.push_back({patches.patch_of_triangle[t], low, high});
    }
  std::ranges::sort(loose);
  std::vector<bool> closed(patches.count(), true);
  for (std::size_t begin = 0, end = 0; begin < loose.size(); begin = end) {
    while (end < loose.size() && loose[end] == loose[begin]) ++end;
    if ((end - begin) % 2 == 1) closed[loose[begin][0]] = false;
  }
  return closed;
}

/// Six times the signed volume of each patch, measured from a vertex of its own.
std::vector<double> patch_volumes(const TriangleMesh& mesh, const Patches& patches) {
  std::vector<std::optional<Vector3>> origins(patches.count());
  std::vector<double> volumes(patches.count(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::optional<Vector3>& origin = origins[patches.patch_of_triangle[t]];
    if (!origin) origin = mesh.corner(t, 0);
    const Vector3 a = mesh.corner(t, 0) - *origin;
    const Vector3 b = mesh.corner(t, 1) - *origin;
    const Vector3 c = mesh.corner(t, 2) - *origin;
    volumes[patches.patch_of_triangle[t]] += a.dot(b.cross(c));
  }
  return volumes;
}

/// The closed patches that are inside-out and not inside another closed patch.
std::vector<bool> patches_to_turn_out(const TriangleMesh& mesh, const Patches& patches,
                                      const std::vector<bool>& closed) {
  const std::vector<double> volumes = patch_volumes(mesh, patches);
  std::vector<std::uint32_t> closed_patch_of_triangle = patches.patch_of_triangle;
  std::vector<bool> asked(patches.count(), false);
  std::vector<EnclosureQuery> queries;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t patch = patches.patch_of_triangle[t];
    if (!closed[patch]) closed_patch_of_triangle[t] = kNoTriangle;
    if (!closed[patch] || !patches.orientable[patch] || !(volumes[patch] < 0.0) || asked[patch]) continue;
    asked[patch] = true;
    queries.push_back({mesh.corner(t, 0), patch});
  }
  const std::vector<bool> inside = enclosed(mesh, closed_patch_of_triangle, queries);
  std::vector<bool> turn_out(patches.count(), false);
  for (std::size_t i = 0; i < queries.size(); ++i) turn_out[queries[i].part] = !inside[i];
  return turn_out;
}

void orient(TriangleMesh& mesh, RepairReport& report) {
  const EdgeNeighbours neighbours = edge_neighbours(mesh);
  const Patches patches = find_patches(mesh, neighbours);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!patches.turn[t]) continue;
    turn(mesh.triangles[t]);
    ++report.rewound_faces;
  }
  report.unorientable_patches = static_cast<std::size_t>(std::ranges::count(patches.orientable, false));
  const std::vector<bool> turn_out =
      patches_to_turn_out(mesh, patches, closed_patches(mesh, patches, neighbours));
  report.components_turned_out = static_cast<std::size_t>(std::ranges::count(turn_out, true));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (turn_out[patches.patch_of_triangle[t]]) turn(mesh.triangles[t]);
}

/// "1 face", "12 faces".
std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void describe_changes(const RepairReport& report, std::vector<std::string>& lines) {
  if (report.non_finite_vertices > 0)
    lines.push_back(fmt::format("{} with NaN or infinite coordinates removed, {} using them dropped",
                                counted(report.non_finite_vertices, "vertex", "vertices"),
                                counted(report.non_finite_faces, "face", "faces")));
  if (report.welded_vertices > 0)
    lines.push_back(counted(report.welded_vertices, "duplicate vertex", "duplicate vertices") + " welded");
  if (report.degenerate_faces > 0)
    lines.push_back(counted(report.degenerate_faces, "degenerate face", "degenerate faces") + " dropped");
  if (report.flipped_edges > 0)
    lines.push_back(counted(report.flipped_edges, "flat face", "flat faces") +
                    " merged into the neighbour on the long edge");
  if (report.duplicate_faces > 0)
    lines.push_back(counted(report.duplicate_faces, "duplicate face", "duplicate faces") + " dropped");
  if (report.unused_vertices > 0)
    lines.push_back(counted(report.unused_vertices, "unused vertex", "unused vertices") + " removed");
  if (report.rewound_faces > 0)
    lines.push_back(counted(report.rewound_faces, "face", "faces") + " turned to agree with the neighbours");
  if (report.components_turned_out > 0)
    lines.push_back(counted(report.components_turned_out, "inside-out part", "inside-out parts") +
                    " turned outward");
}

void describe_surface(const RepairReport& report, std::vector<std::string>& lines) {
  if (report.surface.boundary_edges > 0)
    lines.push_back("the surface is open: " +
                    counted(report.surface.boundary_edges, "boundary edge", "boundary edges"));
  if (report.surface.non_manifold_edges > 0)
    lines.push_back(counted(report.surface.non_manifold_edges, "edge is", "edges are") +
                    " shared by more than two faces");
  if (report.unorientable_patches > 0)
    lines.push_back(counted(report.unorientable_patches, "part is", "parts are") +
                    " one-sided, like a Moebius strip: fronts cannot be made to agree");
}

}  // namespace

bool RepairReport::changed() const {
  return non_finite_vertices + non_finite_faces + welded_vertices + degenerate_faces + flipped_edges +
             duplicate_faces + unused_vertices + rewound_faces + components_turned_out >
         0;
}

std::vector<std::string> RepairReport::sentences() const {
  std::vector<std::string> lines;
  describe_changes(*this, lines);
  describe_surface(*this, lines);
  return lines;
}

RepairReport repair(TriangleMesh& mesh) {
  RepairReport report;
  const std::size_t vertices_before = mesh.positions.size();
  drop_non_finite(mesh, report);
  weld(mesh, report);
  save_or_drop_flat(mesh, report);
  drop_duplicates(mesh, report);
  drop_unused_vertices(mesh);
  report.unused_vertices =
      vertices_before - mesh.positions.size() - report.non_finite_vertices - report.welded_vertices;
  orient(mesh, report);
  report.surface = analyse_topology(mesh).report;
  return report;
}

}  // namespace icome::geometry
