#include "geometry/loop/loop_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace icome::geometry {
namespace {

constexpr std::uint32_t kNoSpoke = 0xffffffff;

/// A part of the faces around a vertex between two sharp edges, or all of them.
struct Sector {
  std::vector<std::uint32_t> ring;   // the vertices around, counter-clockwise
  std::vector<std::uint32_t> faces;  // one fewer than `ring`, or as many when the sector goes all around
};

/// The faces around one vertex, divided into sectors.
class VertexFan {
 public:
  VertexFan(const LoopLevel& level, const LoopSharpness& sharp, std::uint32_t vertex)
      : sharp_(sharp), vertex_(vertex) {
    for (const std::uint32_t face : level.faces_around(vertex)) {
      const TriangleMesh::Triangle& t = level.mesh.triangles[face];
      const int at = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      const auto spoke = std::uint32_t(spokes_.size());
      spokes_.push_back({t[(at + 1) % 3], t[(at + 2) % 3], face});
      by_from_.emplace_back(spokes_.back().from, spoke);
      by_to_.emplace_back(spokes_.back().to, spoke);
    }
    std::sort(by_from_.begin(), by_from_.end());
    std::sort(by_to_.begin(), by_to_.end());
  }

  /// Calls `take(sector)` for every sector.
  template <typename Take>
  void sectors(Take&& take) {
    for (const Spoke& spoke : spokes_) {
      const bool rim = before(spoke.from) == kNoSpoke;
      sharp_edges_ += rim || is_sharp(spoke.from);
      sharp_edges_ += after(spoke.to) == kNoSpoke;  // the other rim
      parts_ += rim;
    }
    bool began = false;
    for (std::uint32_t i = 0; i < spokes_.size(); ++i) {
      if (before(spokes_[i].from) != kNoSpoke && !is_sharp(spokes_[i].from)) continue;
      began = true;
      take(walk(i));
    }
    if (!began && !spokes_.empty()) take(walk(0));
  }

  // These are known once sectors() has begun to call `take`.

  /// Is there one sharp edge only, the ring's first, which ends here?
  bool dart() const { return sharp_edges_ == 1; }
  /// Does the surface keep the vertex in place?
  bool corner() const { return sharp_edges_ > 2 || parts_ > 1 || sharp_.corners.contains(vertex_); }
  bool smooth() const { return sharp_edges_ < 2 && !corner(); }

 private:
  struct Spoke {
    std::uint32_t from, to, face;
  };

  /// The spoke that ends in / begins with a neighbour; kNoSpoke at a boundary.
  std::uint32_t before(std::uint32_t from) const { return look_up(by_to_, from); }
  std::uint32_t after(std::uint32_t to) const { return look_up(by_from_, to); }

  using Links = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // neighbour, spoke; sorted
  static std::uint32_t look_up(const Links& links, std::uint32_t neighbour) {
    const auto place = std::lower_bound(links.begin(), links.end(), std::pair(neighbour, 0u));
    return place != links.end() && place->first == neighbour ? place->second : kNoSpoke;
  }

  bool is_sharp(std::uint32_t neighbour) const {
    return !sharp_.edges.empty() && sharp_.edges.contains(LoopSharpness::edge_key(vertex_, neighbour));
  }

  Sector walk(std::uint32_t first) const {
    Sector sector;
    for (std::uint32_t i = first;;) {
      sector.ring.push_back(spokes_[i].from);
      sector.faces.push_back(spokes_[i].face);
      const std::uint32_t next = after(spokes_[i].to);
      if (next == kNoSpoke || (is_sharp(spokes_[i].to) && next != first)) {
        sector.ring.push_back(spokes_[i].to);
        break;
      }
      if (next == first) break;
      i = next;
    }
    return sector;
  }

  const LoopSharpness& sharp_;
  std::uint32_t vertex_;
  std::vector<Spoke> spokes_;
  Links by_from_, by_to_;
  int sharp_edges_ = 0;
  int parts_ = 0;  // separated by boundary
};

/// Weights of a vertex (first) and its ring.
using Mask = std::vector<double>;

double ring_angle(std::size_t i, std::size_t k) { return 2.0 * std::numbers::pi * double(i) / double(k); }

Mask cosines(std::size_t k) {
  Mask mask(k + 1, 0.0);
  for (std::size_t i = 0; i < k; ++i) mask[i + 1] = std::cos(ring_angle(i, k));
  return mask;
}

Mask sines(std::size_t k) {
  Mask mask(k + 1, 0.0);
  for (std::size_t i = 0; i < k; ++i) mask[i + 1] = std::sin(ring_angle(i, k));
  return mask;
}

/// The tangent mask across a boundary or crease, towards the sector. The ring's inner vertices obey a
/// tridiagonal matrix with eigenvectors sin(i angle); the weights of the vertex and of the two ends follow
/// from the refinement of the curve.
Mask across_crease(std::size_t k) {
  Mask mask(k + 1, 0.0);
  if (k == 2) return {-2.0, 1.0, 1.0};
  const double angle = std::numbers::pi / double(k - 1);
  const double value = 0.375 + 0.25 * std::cos(angle);
  for (std::size_t i = 1; i + 1 < k; ++i) mask[i + 1] = std::sin(double(i) * angle);
  const double end = (0.375 / std::tan(0.5 * angle) + std::sin(angle) * (value - 0.75)) /
                     (8.0 * (value - 1.0) * (value - 0.25));
  mask[1] = mask[k] = end;
  mask[0] = 8.0 * end * (value - 0.5) - std::sin(angle);
  return mask;
}

/// Applies the transposed matrix of a vertex in which one crease ends, along the ring's first edge.
Mask refine_dart(const Mask& mask) {
  const std::size_t k = mask.size() - 1;
  const double turn = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / double(k));
  const double beta = (0.625 - turn * turn) / double(k);
  Mask next(k + 1, beta * mask[0]);
  next[0] = mask[0] * (1.0 - double(k) * beta) + 0.5 * mask[1];
  next[1] += 0.5 * mask[1];
  for (std::size_t i = 1; i < k; ++i) {
    next[0] += 0.375 * mask[i + 1];
    next[i] += 0.125 * mask[i + 1];
    next[i + 1] += 0.375 * mask[i + 1];
    next[(i + 1) % k + 1] += 0.125 * mask[i + 1];
  }
  return next;
}

/// The tangent mask along a crease that ends in a vertex: no closed form, so the transposed matrix is applied
/// until the largest eigenvalue is left that is symmetric and not 1. Weights that add up to zero have no part
/// in the eigenvalue 1.
Mask along_dart(std::size_t k) {
  constexpr int kSteps = 200;
  Mask mask = cosines(k);
  for (int step = 0; step < kSteps; ++step) {
    mask = refine_dart(mask);
    mask[0] -= std::accumulate(mask.begin(), mask.end(), 0.0);
    double largest = 0.0;
    for (const double weight : mask) largest = std::max(largest, std::abs(weight));
    for (double& weight : mask) weight /= largest;
  }
  const Mask towards = cosines(k);
  if (std::inner_product(mask.begin(), mask.end(), towards.begin(), 0.0) < 0.0)
    for (double& weight : mask) weight = -weight;
  return mask;
}

class LimitNormals {
 public:
  LimitNormals(LoopLevel& level, const LoopSharpness& sharp) : level_(level), sharp_(sharp) {}

  void find() {
    level_.corner_normals.resize(level_.mesh.triangles.size());
    for (std::uint32_t v = 0; v < level_.mesh.positions.size(); ++v) {
      VertexFan fan(level_, sharp_, v);
      fan.sectors([&](const Sector& sector) {
        const auto index = std::uint32_t(level_.normals.size());
        level_.normals.push_back(normal(v, sector, fan));
        for (const std::uint32_t face : sector.faces) {
          for (int i = 0; i < 3; ++i)
            if (level_.mesh.triangles[face][i] == v) level_.corner_normals[face][i] = index;
        }
      });
    }
  }

 private:
  Vector3 normal(std::uint32_t vertex, const Sector& sector, const VertexFan& fan) const {
    const std::vector<std::uint32_t>& ring = sector.ring;
    const bool round = ring.size() == sector.faces.size();
    Vector3 one, two;
    if (round && fan.smooth()) {
      one = apply(vertex, ring, fan.dart() ? along_dart(ring.size()) : cosines(ring.size()));
      two = apply(vertex, ring, sines(ring.size()));
    } else if (round) {  // all around a vertex that is kept in place
      return flat_normal(sector);
    } else if (fan.corner()) {
      one = at(ring.front()) - at(vertex);
      two = at(ring.back()) - at(vertex);
    } else {
      one = at(ring.front()) - at(ring.back());
      two = apply(vertex, ring, across_crease(ring.size()));
    }
    const Vector3 flat = flat_normal(sector);
    const Vector3 cross = one.cross(two);
    // Parallel tangents (a corner that is straight, a degenerate fan) have no normal.
    constexpr double kParallel = 1e-9;
    const double length = cross.norm();
    if (!(length > kParallel * one.norm() * two.norm())) return flat;
    // The sides of a re-entrant corner turn the other way round.
    return fan.corner() && cross.dot(flat) < 0.0 ? Vector3(-cross / length) : Vector3(cross / length);
  }

  Vector3 apply(std::uint32_t vertex, const std::vector<std::uint32_t>& ring, const Mask& mask) const {
    Vector3 sum = Vector3::Zero();  // the weights add up to zero, so positions may count from the vertex
    for (std::size_t i = 0; i < ring.size(); ++i) sum += mask[i + 1] * (at(ring[i]) - at(vertex));
    return sum;
  }

  Vector3 flat_normal(const Sector& sector) const {
    Vector3 sum = Vector3::Zero();
    for (const std::uint32_t face : sector.faces) {
      const Vector3& a = level_.mesh.corner(face, 0);
      sum += (level_.mesh.corner(face, 1) - a).cross(level_.mesh.corner(face, 2) - a);
    }
    const double length = sum.norm();
    return length > 0.0 ? Vector3(sum / length) : Vector3(Vector3::UnitZ());
  }

  const Vector3& at(std::uint32_t vertex) const { return level_.mesh.positions[vertex]; }

  LoopLevel& level_;
  const LoopSharpness& sharp_;
};

}  // namespace

void find_limit_normals(LoopLevel& level, const LoopSharpness& sharp) { LimitNormals(level, sharp).find(); }

}  // namespace icome::geometry
