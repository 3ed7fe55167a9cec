#pragma once
// Loop's subdivision told a second time, from the rules in the literature: slow, explicit, local.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "base/random.h"
#include "geometry/loop/loop_surface.h"

namespace icome::geometry::loop_reference {

using Index = std::uint32_t;
using Edge = std::pair<Index, Index>;

inline Edge edge(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// A mesh with the tags that its subdivision inherits.
struct Mesh {
  std::vector<Vector3> points;
  std::vector<std::array<Index, 3>> faces;
  std::set<Edge> creases;
  std::set<Index> corners;
};

inline Mesh from_control(const ControlMesh& control) {
  Mesh mesh{control.mesh.positions, control.mesh.triangles, {}, {}};
  for (const auto& crease : control.creases) mesh.creases.insert(edge(crease[0], crease[1]));
  mesh.corners.insert(control.corners.begin(), control.corners.end());
  return mesh;
}

/// Who is next to whom.
struct Around {
  std::map<Edge, std::vector<Index>> opposite;     // vertices that face an edge
  std::map<Index, std::set<Index>> neighbours;     // of a vertex
  std::map<Index, std::vector<Index>> sharp_ends;  // other ends of a vertex's boundary and crease edges

  explicit Around(const Mesh& mesh) {
    for (const auto& face : mesh.faces) {
      for (int i = 0; i < 3; ++i) {
        const Index a = face[i], b = face[(i + 1) % 3], c = face[(i + 2) % 3];
        opposite[edge(a, b)].push_back(c);
        neighbours[a].insert({b, c});
      }
    }
    for (const auto& [e, across] : opposite) {
      if (across.size() == 2 && !mesh.creases.contains(e)) continue;
      sharp_ends[e.first].push_back(e.second);
      sharp_ends[e.second].push_back(e.first);
    }
  }
  bool sharp(const Mesh& mesh, const Edge& e) const {
    return opposite.at(e).size() < 2 || mesh.creases.contains(e);
  }
  std::size_t sharp_count(Index v) const { return sharp_ends.contains(v) ? sharp_ends.at(v).size() : 0; }
};

inline double beta(double k) {
  const double a = 3.0 / 8.0 + std::cos(2.0 * std::numbers::pi / k) / 4.0;
  return (5.0 / 8.0 - a * a) / k;
}

inline Vector3 vertex_point(const Mesh& mesh, const Around& around, Index v) {
  const std::size_t sharp = around.sharp_count(v);
  const Vector3& p = mesh.points[v];
  if (mesh.corners.contains(v) || sharp > 2) return p;
  if (sharp == 2) {
    const auto& ends = around.sharp_ends.at(v);
    return 0.75 * p + (mesh.points[ends[0]] + mesh.points[ends[1]]) / 8.0;
  }
  const auto& ring = around.neighbours.at(v);
  Vector3 sum = Vector3::Zero();
  for (const Index n : ring) sum += mesh.points[n] - p;
  return p + beta(double(ring.size())) * sum;
}

inline Vector3 edge_point(const Mesh& mesh, const Around& around, const Edge& e) {
  const Vector3 ends = mesh.points[e.first] + mesh.points[e.second];
  if (around.sharp(mesh, e)) return ends / 2.0;
  const auto& across = around.opposite.at(e);
  return 3.0 / 8.0 * ends + (mesh.points[across[0]] + mesh.points[across[1]]) / 8.0;
}

/// One subdivision; face f becomes 4f to 4f + 2 at its corners and 4f + 3 in the middle, whose corners lie on
/// sides 1, 2 and 0.
inline Mesh subdivide(const Mesh& mesh) {
  const Around around(mesh);
  Mesh fine;
  std::map<Index, Index> vertex_of;
  std::map<Edge, Index> middle_of;
  for (const auto& [v, ring] : around.neighbours) {
    vertex_of[v] = Index(fine.points.size());
    if (mesh.corners.contains(v)) fine.corners.insert(vertex_of[v]);
    fine.points.push_back(vertex_point(mesh, around, v));
  }
  for (const auto& [e, across] : around.opposite) {
    middle_of[e] = Index(fine.points.size());
    fine.points.push_back(edge_point(mesh, around, e));
    if (!mesh.creases.contains(e)) continue;
    fine.creases.insert(edge(vertex_of[e.first], middle_of[e]));
    fine.creases.insert(edge(vertex_of[e.second], middle_of[e]));
  }
  for (const auto& f : mesh.faces) {
    std::array<Index, 3> middle;
    for (int i = 0; i < 3; ++i) middle[i] = middle_of.at(edge(f[i], f[(i + 1) % 3]));
    for (int i = 0; i < 3; ++i) fine.faces.push_back({vertex_of.at(f[i]), middle[i], middle[(i + 2) % 3]});
    fine.faces.push_back({middle[1], middle[2], middle[0]});
  }
  return fine;
}

/// Only the faces within some rings of face `keep`, which becomes face 0: two are all that its descendants
/// depend on.
inline Mesh trimmed(const Mesh& mesh, std::size_t keep, int rings = 2) {
  std::set<Index> near(mesh.faces[keep].begin(), mesh.faces[keep].end());
  Mesh result = mesh;
  for (int ring = 0; ring < rings; ++ring) {
    const std::set<Index> inner = near;
    result.faces = {mesh.faces[keep]};
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& face = mesh.faces[f];
      if (std::none_of(face.begin(), face.end(), [&](Index v) { return inner.contains(v); })) continue;
      near.insert(face.begin(), face.end());
      if (f != keep) result.faces.push_back(face);
    }
  }
  return result;
}

/// The neighbours of `v` in the sector of a face, counter-clockwise; closed when it goes all round.
struct Sector {
  std::vector<Index> ends;
  bool closed = false;
};

inline Sector sector_of(const Mesh& mesh, const Around& around, std::array<Index, 3> face, Index v) {
  std::map<Edge, Index> third;  // by directed edge
  for (const auto& f : mesh.faces) {
    for (int i = 0; i < 3; ++i) third[{f[i], f[(i + 1) % 3]}] = f[(i + 2) % 3];
  }
  const auto at = std::find(face.begin(), face.end(), v) - face.begin();
  const bool dart = around.sharp_count(v) == 1 && !mesh.corners.contains(v);
  const auto ends_here = [&](Index n) { return !dart && around.sharp(mesh, edge(v, n)); };
  Sector sector;
  sector.ends = {face[(at + 1) % 3]};
  while (!ends_here(sector.ends.front())) {  // clockwise: the face on the other side is (end, v, next)
    const Index next = third.at({sector.ends.front(), v});
    if (next == sector.ends.back()) {
      sector.closed = true;
      return sector;
    }
    sector.ends.insert(sector.ends.begin(), next);
  }
  sector.ends.push_back(third.at({v, sector.ends.back()}));
  while (!ends_here(sector.ends.back())) sector.ends.push_back(third.at({v, sector.ends.back()}));
  // The walk above began inside; what it found beyond the face's first spoke is already in order.
  return sector;
}

struct Limit {
  Vector3 point, normal;
  bool has_normal;  // the masks below know one
};

/// Limit position and normal of vertex `v` for the side that `face` is on (Loop 1987; Hoppe et al. 1994).
inline Limit limit_of(const Mesh& mesh, std::array<Index, 3> face, Index v) {
  const Around around(mesh);
  const Sector sector = sector_of(mesh, around, face, v);
  const auto& ends = sector.ends;
  const Vector3& p = mesh.points[v];
  const auto q = [&](std::size_t i) -> Vector3 { return mesh.points[ends[i]] - p; };
  const std::size_t k = ends.size();
  const std::size_t sharp = around.sharp_count(v);
  Limit limit{p, Vector3::Zero(), true};
  Vector3 one = Vector3::Zero(), other = Vector3::Zero();
  if (mesh.corners.contains(v) || sharp > 2) {
    limit.has_normal = !sector.closed && k <= 3;
    one = q(0);
    other = q(k - 1);
  } else if (sharp == 2) {
    limit.point += (q(0) + q(k - 1)) / 6.0;
    one = q(0) - q(k - 1);
    if (k == 2) {
      other = q(0) + q(1);
    } else if (k == 3) {
      other = q(1);
    } else if (k == 4) {
      other = 2.0 * (q(1) + q(2)) - q(0) - q(3);
    } else {
      // The literature's mask (Hoppe 1994) belongs to his rules, which differ from Loop's there.
      limit.has_normal = false;
    }
  } else {
    limit.has_normal = sharp == 0;
    const double share = 1.0 / (double(k) + 3.0 / (8.0 * beta(double(k))));
    for (std::size_t i = 0; i < k; ++i) {
      const double angle = 2.0 * std::numbers::pi * double(i) / double(k);
      limit.point += share * q(i);
      one += std::cos(angle) * q(i);
      other += std::sin(angle) * q(i);
    }
  }
  limit.normal = one.cross(other).normalized();
  return limit;
}

/// A corner of a face of a fine mesh.
struct Spot {
  Mesh mesh;
  Index vertex;
};

/// Subdivides around the place at (u, v) = (i, j) / 2^levels of a face and returns it as a vertex of face 0.
inline Spot descend(Mesh mesh, std::size_t face, Index i, Index j, int levels) {
  mesh = trimmed(mesh, face);
  std::array<std::int64_t, 3> weights = {(std::int64_t(1) << levels) - i - j, i, j};
  for (int level = levels; level > 0; --level) {
    const std::int64_t half = std::int64_t(1) << (level - 1);
    mesh = subdivide(mesh);
    std::size_t child = 3;
    for (std::size_t c = 0; c < 3; ++c) {
      if (weights[c] >= half) child = c;
    }
    if (child < 3) {  // its corners: the old one, the next side's middle, the last side's
      const std::array<std::int64_t, 3> w = weights;
      weights = {w[child] - half, w[(child + 1) % 3], w[(child + 2) % 3]};
      weights[0] = half - weights[1] - weights[2];
    } else {
      for (auto& w : weights) w = half - w;
    }
    mesh = trimmed(mesh, child);
  }
  const auto at = std::max_element(weights.begin(), weights.end()) - weights.begin();
  const Index vertex = mesh.faces[0][std::size_t(at)];
  return {std::move(mesh), vertex};
}

// ---- Control meshes ----------------------------------------------------------------------------

/// Two poles of `valence`, an equator of valence 4, and a jolt that makes nothing symmetric.
inline TriangleMesh bipyramid(Index valence, double jolt, std::uint64_t seed) {
  base::Random random(seed);
  TriangleMesh mesh;
  mesh.positions = {{0.1, 0.0, 1.0}, {0.0, -0.1, -0.8}};
  for (Index i = 0; i < valence; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / valence;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.1 * std::sin(3.0 * angle));
    mesh.triangles.push_back({0, 2 + i, 2 + (i + 1) % valence});
    mesh.triangles.push_back({1, 2 + (i + 1) % valence, 2 + i});
  }
  for (Vector3& p : mesh.positions) p += jolt * random.uniform() * random.direction();
  return mesh;
}

/// A closed surface around the origin with all kinds of valences: a ball whose edges were turned at random.
inline TriangleMesh wild_ball(int subdivisions, int flips, double jolt, std::uint64_t seed) {
  base::Random random(seed);
  Mesh mesh;
  const TriangleMesh start = bipyramid(5, 0.0, 1);
  mesh.points = start.positions;
  mesh.faces = start.triangles;
  for (int i = 0; i < subdivisions; ++i) mesh = subdivide(mesh);
  for (Vector3& p : mesh.points) p.normalize();
  std::set<Edge> edges;
  for (const auto& f : mesh.faces) {
    for (int i = 0; i < 3; ++i) edges.insert(edge(f[i], f[(i + 1) % 3]));
  }
  std::map<Index, int> valence;
  for (const Edge& e : edges) ++valence[e.first], ++valence[e.second];
  for (int flip = 0; flip < flips; ++flip) {
    auto& one = mesh.faces[random.index(mesh.faces.size())];
    const auto i = random.index(3);
    const Index a = one[i], b = one[(i + 1) % 3], c = one[(i + 2) % 3];
    for (auto& other : mesh.faces) {
      for (int k = 0; k < 3; ++k) {
        if (other[k] != b || other[(k + 1) % 3] != a) continue;
        const Index d = other[(k + 2) % 3];
        if (d == c || edges.contains(edge(c, d)) || valence[a] < 4 || valence[b] < 4) continue;
        const auto volume = [&](Index x, Index y, Index z) {
          return mesh.points[x].dot(mesh.points[y].cross(mesh.points[z]));
        };
        const double least = 0.3 * volume(a, b, c);  // so that nothing folds over
        if (volume(a, d, c) < least || volume(d, b, c) < least) continue;
        edges.erase(edge(a, b));
        edges.insert(edge(c, d));
        --valence[a], --valence[b], ++valence[c], ++valence[d];
        one = {a, d, c};
        other = {d, b, c};
        k = 3;
      }
    }
  }
  TriangleMesh result{mesh.points, mesh.faces};
  for (Vector3& p : result.positions) p *= 1.0 + jolt * random.uniform(-1.0, 1.0);
  return result;
}

/// The mesh with holes, creases and corners at random.
inline ControlMesh torn(const TriangleMesh& mesh, double holes, double creases, double corners,
                        std::uint64_t seed) {
  base::Random random(seed);
  ControlMesh control;
  control.mesh.positions = mesh.positions;
  for (const auto& f : mesh.triangles) {
    if (random.uniform() < holes) continue;
    control.mesh.triangles.push_back(f);
    for (int i = 0; i < 3; ++i) {
      if (random.uniform() < creases) control.creases.push_back({f[i], f[(i + 1) % 3]});
    }
  }
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (random.uniform() < corners) control.corners.push_back(v);
  }
  return control;
}

}  // namespace icome::geometry::loop_reference
