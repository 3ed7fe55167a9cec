#include "geometry/loop/loop_topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>

namespace icome::geometry {
namespace {

constexpr std::uint32_t kNoSide = LoopTopology::kNone;
constexpr std::uint32_t kTooMany = 1u << 29;  // triangles: four pieces each are numbered with 32 bits

std::uint32_t next_corner(std::uint32_t i) { return i == 2 ? 0 : i + 1; }
std::uint32_t last_corner(std::uint32_t i) { return i == 0 ? 2 : i - 1; }

struct SideOfEdge {
  std::uint32_t low, high;
  std::uint32_t side;
};

std::vector<SideOfEdge> sorted_sides(const TriangleMesh& mesh) {
  std::vector<SideOfEdge> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][i], to = mesh.triangles[t][next_corner(i)];
      sides.push_back({std::min(from, to), std::max(from, to), 3 * t + i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const SideOfEdge& a, const SideOfEdge& b) {
    return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
  });
  return sides;
}

base::Result<void> check_control(const ControlMesh& control) {
  const TriangleMesh& mesh = control.mesh;
  const std::size_t vertices = mesh.positions.size();
  if (mesh.triangles.empty()) return base::fail("the control mesh has no triangles");
  if (mesh.triangles.size() > kTooMany || vertices > 3 * std::size_t(kTooMany)) {
    return base::fail("the control mesh has too many triangles: simplify it first");
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!mesh.positions[v].allFinite()) {
      return base::fail(fmt::format("vertex {} of the control mesh is not finite", v));
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (std::max({a, b, c}) >= vertices) {
      return base::fail(fmt::format("triangle {} names vertex {}, but the control mesh has only {}", t,
                                    std::max({a, b, c}), vertices));
    }
    if (a == b || b == c || c == a) {
      return base::fail(
          fmt::format("triangle {} of the control mesh names a vertex twice: remove the triangle", t));
    }
  }
  for (const auto& crease : control.creases) {
    if (std::max(crease[0], crease[1]) >= vertices) {
      return base::fail(fmt::format("a crease names vertex {}, but the control mesh has only {}",
                                    std::max(crease[0], crease[1]), vertices));
    }
  }
  for (const std::uint32_t corner : control.corners) {
    if (corner >= vertices) {
      return base::fail(
          fmt::format("a corner names vertex {}, but the control mesh has only {}", corner, vertices));
    }
  }
  return {};
}

/// The third corner of the triangle, if it has a side from `a` to `b`.
std::optional<std::uint32_t> third_after(const TriangleMesh::Triangle& t, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (t[i] == a && t[next_corner(i)] == b) return t[last_corner(i)];
  }
  return {};
}

/// Two polygons that share two sides (a, m) and (m, b), both cut along the line from a to b, leave two
/// triangles a, b, m back to back. Cuts both polygons the other way, from m.
void recut_pillow(TriangleMesh& mesh, std::span<const SideOfEdge> sides) {
  const std::uint32_t a = sides[0].low, b = sides[0].high;
  std::array<std::array<std::uint32_t, 2>, 2> triangles{}, thirds{};  // [along a to b, along b to a][which]
  std::array<std::size_t, 2> count{};
  for (const SideOfEdge& side : sides) {
    const auto& t = mesh.triangles[side.side / 3];
    auto third = third_after(t, a, b);
    const bool back = !third;
    if (back) third = third_after(t, b, a);
    if (!third || count[back] == 2) return;  // cut otherwise already, or none
    thirds[back][count[back]] = *third;
    triangles[back][count[back]++] = side.side / 3;
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const std::uint32_t m = thirds[0][i], z = thirds[0][1 - i], y = thirds[1][1 - j];
      if (thirds[1][j] != m || y == m || z == m) continue;
      mesh.triangles[triangles[0][i]] = {y, b, m};
      mesh.triangles[triangles[1][1 - j]] = {y, m, a};
      mesh.triangles[triangles[1][j]] = {m, b, z};
      mesh.triangles[triangles[0][1 - i]] = {m, z, a};
      return;
    }
  }
}

void recut_pillows(TriangleMesh& mesh) {
  const std::vector<SideOfEdge> sides = sorted_sides(mesh);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin == 4) recut_pillow(mesh, std::span(sides).subspan(begin, 4));
  }
}

/// Joins the sides of each edge. Sides that run the same way stay apart, and their vertices are noted.
base::Result<void> join_sides(LoopTopology& topology, std::vector<bool>& keep) {
  const TriangleMesh& mesh = topology.mesh;
  const std::vector<SideOfEdge> sides = sorted_sides(mesh);
  topology.across.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  topology.closed = true;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const SideOfEdge& first = sides[begin];
    while (end < sides.size() && sides[end].low == first.low && sides[end].high == first.high) ++end;
    if (end - begin > 2) {
      return base::fail(
          fmt::format("{} triangles of the control mesh meet at the edge from vertex {} to {}; a "
                      "subdivision surface has at most two: split the mesh there",
                      end - begin, first.low, first.high));
    }
    if (end - begin < 2) {
      topology.closed = false;
      continue;
    }
    const std::uint32_t one = sides[begin].side, other = sides[begin + 1].side;
    if (mesh.triangles[one / 3][one % 3] == mesh.triangles[other / 3][other % 3]) {
      keep[first.low] = keep[first.high] = true;
      topology.closed = false;
      continue;
    }
    topology.across[one / 3][one % 3] = other;
    topology.across[other / 3][other % 3] = one;
  }
  return {};
}

/// Cuts `smooth` at the creases.
base::Result<void> cut_creases(LoopTopology& topology, const ControlMesh& control) {
  topology.smooth = topology.across;
  if (control.creases.empty()) return {};
  const std::vector<SideOfEdge> sides = sorted_sides(topology.mesh);
  for (const auto& crease : control.creases) {
    const SideOfEdge wanted{std::min(crease[0], crease[1]), std::max(crease[0], crease[1]), 0};
    const auto before = [](const SideOfEdge& a, const SideOfEdge& b) {
      return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    };
    const auto [begin, end] = std::equal_range(sides.begin(), sides.end(), wanted, before);
    if (begin == end) {
      return base::fail(fmt::format("the crease from vertex {} to {} is not an edge of the control mesh",
                                    crease[0], crease[1]));
    }
    for (auto side = begin; side != end; ++side) topology.smooth[side->side / 3][side->side % 3] = kNoSide;
  }
  return {};
}

std::uint32_t turn(const LoopTopology::Sides& sides, std::uint32_t face, bool counter_clockwise) {
  const std::uint32_t triangle = face / 3, corner = face % 3;
  if (counter_clockwise) return sides[triangle][last_corner(corner)];
  const std::uint32_t side = sides[triangle][corner];
  return side == kNoSide ? kNoSide : side / 3 * 3 + next_corner(side % 3);
}

/// The faces round a corner, from the clockwise end of an open fan or from the face itself.
std::vector<std::uint32_t> faces_around(const LoopTopology::Sides& sides, std::uint32_t face) {
  std::uint32_t first = face;
  for (std::uint32_t next = turn(sides, first, false); next != kNoSide && next != face;) {
    first = next;
    next = turn(sides, first, false);
  }
  if (turn(sides, first, false) != kNoSide) first = face;
  std::vector<std::uint32_t> faces;
  for (std::uint32_t at = first;;) {
    faces.push_back(at);
    at = turn(sides, at, true);
    if (at == kNoSide || at == first) return faces;
  }
}

/// Gives each fan a vertex of its own and drops vertices without triangles. Returns the old vertex of each
/// new one; vertices of several fans are kept in place.
std::vector<std::uint32_t> split_fans(LoopTopology& topology, std::vector<bool>& keep) {
  TriangleMesh& mesh = topology.mesh;
  const std::vector<TriangleMesh::Triangle> old = mesh.triangles;
  std::vector<bool> seen(3 * old.size(), false), used(mesh.positions.size(), false);
  std::vector<std::uint32_t> origin;
  for (std::uint32_t face = 0; face < seen.size(); ++face) {
    if (seen[face]) continue;
    const std::uint32_t vertex = old[face / 3][face % 3];
    if (used[vertex]) keep[vertex] = true;
    used[vertex] = true;
    for (const std::uint32_t at : faces_around(topology.across, face)) {
      seen[at] = true;
      mesh.triangles[at / 3][at % 3] = std::uint32_t(origin.size());
    }
    origin.push_back(vertex);
  }
  std::vector<Vector3> positions;
  for (const std::uint32_t vertex : origin) positions.push_back(mesh.positions[vertex]);
  mesh.positions = std::move(positions);
  return origin;
}

base::Result<FanRule> rule_of(const LoopTopology& topology, std::uint32_t face, bool keep,
                              std::uint32_t original) {
  const auto faces = faces_around(topology.across, face);
  const bool open = turn(topology.across, faces.front(), false) == kNoSide;
  std::size_t sharp = open ? 2 : 0;
  for (const std::uint32_t at : faces) {
    const std::uint32_t t = at / 3, i = at % 3;
    if (topology.across[t][i] != kNoSide && topology.smooth[t][i] == kNoSide) ++sharp;
  }
  if (!open && faces.size() < 3) {
    return base::fail(
        fmt::format("only {} triangles go round vertex {} of the control mesh: two triangles lie back to "
                    "back there, remove them",
                    faces.size(), original));
  }
  if (keep || sharp > 2) return sharp == 0 ? FanRule::Spike : FanRule::Corner;
  return sharp == 0 ? FanRule::Smooth : sharp == 1 ? FanRule::Dart : FanRule::Crease;
}

base::Result<void> set_rules(LoopTopology& topology, const std::vector<bool>& keep,
                             const std::vector<std::uint32_t>& origin) {
  const auto& triangles = topology.mesh.triangles;
  std::vector<bool> done(origin.size(), false);
  topology.rules.resize(origin.size());
  for (std::uint32_t face = 0; face < 3 * triangles.size(); ++face) {
    const std::uint32_t vertex = triangles[face / 3][face % 3];
    if (done[vertex]) continue;
    done[vertex] = true;
    const auto rule = rule_of(topology, face, keep[origin[vertex]], origin[vertex]);
    if (!rule) return tl::unexpected(rule.error());
    topology.rules[vertex] = *rule;
    if (*rule == FanRule::Corner || *rule == FanRule::Spike) topology.corners.push_back(vertex);
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t other = topology.across[t][i];
      if (other == kNoSide || topology.smooth[t][i] != kNoSide || other < 3 * t + i) continue;
      topology.creases.push_back({triangles[t][i], triangles[t][next_corner(i)]});
    }
  }
  return {};
}

}  // namespace

base::Result<LoopTopology> loop_topology(const ControlMesh& control) {
  LoopTopology topology;
  if (const auto fine = check_control(control); !fine) return tl::unexpected(fine.error());
  topology.mesh = control.mesh;
  recut_pillows(topology.mesh);
  std::vector<bool> keep(control.mesh.positions.size(), false);
  for (const std::uint32_t corner : control.corners) keep[corner] = true;
  if (const auto fine = join_sides(topology, keep); !fine) return tl::unexpected(fine.error());
  if (const auto fine = cut_creases(topology, control); !fine) return tl::unexpected(fine.error());
  const std::vector<std::uint32_t> origin = split_fans(topology, keep);
  if (const auto fine = set_rules(topology, keep, origin); !fine) return tl::unexpected(fine.error());
  return topology;
}

LoopFan fan_at(const LoopTopology& topology, std::uint32_t triangle, std::uint32_t corner) {
  const std::uint32_t face = 3 * triangle + corner;
  LoopFan fan;
  fan.type.rule = topology.rules[topology.mesh.triangles[triangle][corner]];
  fan.faces = faces_around(fan.type.all_round() ? topology.across : topology.smooth, face);
  fan.type.faces = std::uint32_t(fan.faces.size());
  if (!fan.type.all_round()) {
    const auto self = std::find(fan.faces.begin(), fan.faces.end(), face);
    fan.type.face = std::uint32_t(self - fan.faces.begin());
  }
  if (fan.type.rule == FanRule::Dart) {
    for (std::uint32_t i = 0; i < fan.type.faces; ++i) {
      const std::uint32_t at = fan.faces[i];
      if (topology.smooth[at / 3][at % 3] == kNoSide) fan.type.crease = i;
    }
  }
  return fan;
}

}  // namespace icome::geometry
