#include "geometry/mesh/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "geometry/mesh/enclosure.h"
#include "geometry/mesh/weld.h"

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Height of a triangle over its longest edge, as a share of that edge, below which it has no area.
constexpr double kFlatness = 1e-12;

constexpr std::size_t kFlatGrain = std::size_t{1} << 15U;  // triangles

/// Turning an edge can leave a flat triangle on the next one; chains longer than this are rare.
constexpr int kMaximumFlipRounds = 16;

/// Removes the triangles for which `unwanted(triangle)` holds; returns their number.
template <typename Predicate>
std::size_t drop_triangles(TriangleMesh& mesh, Predicate unwanted) {
  const auto first_dropped = std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), unwanted);
  const auto dropped = static_cast<std::size_t>(mesh.triangles.end() - first_dropped);
  mesh.triangles.erase(first_dropped, mesh.triangles.end());
  return dropped;
}

void drop_non_finite(TriangleMesh& mesh, RepairReport& report) {
  for (const Vector3& position : mesh.positions) report.non_finite_vertices += !position.allFinite();
  if (report.non_finite_vertices == 0) return;
  report.non_finite_faces = drop_triangles(mesh, [&](const Triangle& triangle) {
    return std::ranges::any_of(triangle, [&](std::uint32_t v) { return !mesh.positions[v].allFinite(); });
  });
}

bool repeats_a_vertex(const Triangle& triangle) {
  return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

/// The number of the triangle's longest edge.
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

/// The share of a patch, by area, that its holes may have for it still to have an inside.
constexpr double kSmallHoles = 0.1;

/// The volume and the area of a patch, measured from the middle of its box.
struct PatchVolume {
  Bounds box;
  double six_volumes = 0.0;
  double twice_area = 0.0;
  Vector3 twice_area_vector = Vector3::Zero();  ///< of the holes, turned round: zero for a closed surface

  /// Does the patch have an inside and an outside? Its holes must be small, and the volume's sign the
  /// same wherever in the box it is measured from (only for a closed surface is the volume too).
  bool has_inside() const {
    const double variation = twice_area_vector.cwiseAbs().dot(box.sizes() / 2.0);
    return twice_area_vector.norm() <= kSmallHoles * twice_area && std::abs(six_volumes) > variation;
  }
};

std::vector<PatchVolume> measure_patches(const TriangleMesh& mesh, const Patches& patches) {
  std::vector<PatchVolume> measured(patches.count());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) measured[patches.patch_of_triangle[t]].box.extend(mesh.corner(t, i));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    PatchVolume& patch = measured[patches.patch_of_triangle[t]];
    const Vector3 middle = patch.box.center();
    const Vector3 a = mesh.corner(t, 0) - middle;
    const Vector3 b = mesh.corner(t, 1) - middle;
    const Vector3 c = mesh.corner(t, 2) - middle;
    patch.six_volumes += a.dot(b.cross(c));
    const Vector3 twice_area = (b - a).cross(c - a);
    patch.twice_area += twice_area.norm();
    patch.twice_area_vector += twice_area;
  }
  return measured;
}

/// The triangles' patches, kNoTriangle where `counts(patch)` does not hold.
template <typename Predicate>
std::vector<std::uint32_t> parts_where(const Patches& patches, Predicate counts) {
  std::vector<std::uint32_t> parts = patches.patch_of_triangle;
  for (std::uint32_t& part : parts)
    if (!counts(part)) part = kNoTriangle;
  return parts;
}

/// One query for each patch for which `asked(patch)` holds, at the first corner of its first triangle.
template <typename Predicate>
std::vector<EnclosureQuery> queries_where(const TriangleMesh& mesh, const Patches& patches, Predicate asked) {
  std::vector<EnclosureQuery> queries;
  std::vector<bool> seen(patches.count(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t patch = patches.patch_of_triangle[t];
    if (!seen[patch] && asked(patch)) queries.push_back({mesh.corner(t, 0), patch});
    seen[patch] = true;
  }
  return queries;
}

/// The patches to turn: first those that are inside-out and not inside another, then, as the file's
/// fronts are then likely all inside-out, the walls of the cavities in these.
std::vector<bool> patches_to_turn(const TriangleMesh& mesh, const Patches& patches) {
  const std::vector<PatchVolume> volumes = measure_patches(mesh, patches);
  const auto has_inside = [&](std::uint32_t p) { return patches.orientable[p] && volumes[p].has_inside(); };
  const auto inside_out = [&](std::uint32_t p) { return has_inside(p) && volumes[p].six_volumes < 0.0; };
  std::vector<bool> turned(patches.count(), false);
  const std::vector<EnclosureQuery> shells = queries_where(mesh, patches, inside_out);
  const std::vector<bool> in_another = enclosed(mesh, parts_where(patches, has_inside), shells);
  for (std::size_t i = 0; i < shells.size(); ++i) turned[shells[i].part] = !in_another[i];
  const std::vector<EnclosureQuery> walls =
      queries_where(mesh, patches, [&](std::uint32_t p) { return has_inside(p) && !inside_out(p); });
  const std::vector<std::uint32_t> turned_parts =
      parts_where(patches, [&](std::uint32_t p) { return turned[p]; });
  const std::vector<bool> in_turned = enclosed(mesh, turned_parts, walls);
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (in_turned[i]) turned[walls[i].part] = true;
  return turned;
}

void orient(TriangleMesh& mesh, RepairReport& report) {
  const Patches patches = find_patches(mesh, edge_neighbours(mesh));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!patches.turn[t]) continue;
    turn(mesh.triangles[t]);
    ++report.rewound_faces;
  }
  report.unorientable_patches = static_cast<std::size_t>(std::ranges::count(patches.orientable, false));
  const std::vector<bool> turned = patches_to_turn(mesh, patches);
  report.turned_parts = static_cast<std::size_t>(std::ranges::count(turned, true));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (turned[patches.patch_of_triangle[t]]) turn(mesh.triangles[t]);
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
  if (report.crack_vertices > 0)
    lines.push_back(counted(report.crack_vertices, "vertex", "vertices") + " welded across hairline cracks");
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
  if (report.turned_parts > 0)
    lines.push_back(counted(report.turned_parts, "inside-out part", "inside-out parts") + " turned");
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

bool has_flat_triangle(const TriangleMesh& mesh) {
  std::atomic<bool> found = false;
  base::parallel_for(mesh.triangles.size(), kFlatGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end && !found; ++t)
      if (flat(mesh, mesh.triangles[t])) found = true;
  });
  return found;
}

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

bool RepairReport::changed() const {
  return non_finite_vertices + non_finite_faces + welded_vertices + crack_vertices + degenerate_faces +
             flipped_edges + duplicate_faces + unused_vertices + rewound_faces + turned_parts >
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
  report.welded_vertices = weld_equal(mesh);
  report.crack_vertices = weld_cracks(mesh);
  save_or_drop_flat(mesh, report);
  drop_duplicates(mesh, report);
  drop_unused_vertices(mesh);
  report.unused_vertices = vertices_before - mesh.positions.size() - report.non_finite_vertices -
                           report.welded_vertices - report.crack_vertices;
  orient(mesh, report);
  report.surface = analyse_topology(mesh).report;
  return report;
}

}  // namespace icome::geometry
