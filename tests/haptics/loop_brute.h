#pragma once
// A second opinion on Loop surfaces and on where a surface contact point (SCP) belongs on them, by the rules
// of subdivision as the literature has them (geometry/loop_reference.h): nothing of what is under test.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "geometry/loop_reference.h"
#include "geometry/tree/triangle_tree.h"
#include "haptics/csg_touch.h"

namespace icome::haptics {

using geometry::ControlMesh;
using LoopMesh = geometry::loop_reference::Mesh;

/// Where the vertices of a subdivided mesh end up on the limit surface; those that no face uses stay.
inline std::vector<Vector3> brute_limits(const LoopMesh& mesh) {
  const geometry::loop_reference::Around around(mesh);
  std::vector<Vector3> limits = mesh.points;
  for (const auto& [v, ring] : around.neighbours) {
    const std::size_t sharp = around.sharp_count(v);
    if (mesh.corners.contains(v) || sharp > 2) continue;
    const Vector3& p = mesh.points[v];
    if (sharp == 2) {
      for (const auto end : around.sharp_ends.at(v)) limits[v] += (mesh.points[end] - p) / 6.0;
    } else {
      const double count = double(ring.size());
      const double share = 1.0 / (count + 3.0 / (8.0 * geometry::loop_reference::beta(count)));
      for (const auto n : ring) limits[v] += share * (mesh.points[n] - p);
    }
  }
  return limits;
}

/// A Loop surface as a fine mesh with its vertices on the limit, with the functions of BruteSolid. Sheets
/// have no inside.
class BruteLoop {
 public:
  explicit BruteLoop(const ControlMesh& control, std::size_t triangles = 6000) {
    mesh_ = geometry::loop_reference::from_control(control);
    limits_ = brute_limits(mesh_);
    for (bool first = true; first || mesh_.faces.size() < triangles; first = false) subdivide();
    tree_ = std::make_shared<const geometry::TriangleTree>(TriangleMesh{limits_, mesh_.faces});
    const geometry::loop_reference::Around around(mesh_);
    for (const auto& [edge, across] : around.opposite) closed_ = closed_ && across.size() == 2;
  }

  /// How far the mesh may be from the surface: half of what the last subdivision changed, as the next one
  /// changes a quarter of that where the surface is regular, and less than 0.4 around any valence here.
  double margin() const { return margin_; }
  const LoopMesh& mesh() const { return mesh_; }
  TriangleMesh triangles() const { return {limits_, mesh_.faces}; }
  const geometry::TriangleTree& tree() const { return *tree_; }
  bool closed() const { return closed_; }
  std::uint32_t nearest_face(const Vector3& point) const { return tree_->nearest(point)->triangle; }

  bool inside(const Vector3& point) const { return closed_ && tree_->encloses(point); }
  double bound(const Vector3& point) const {
    if (!closed_) return margin_;
    const double distance = tree_->nearest(point)->parameter;
    if (distance <= margin_) return 0.0;
    return tree_->encloses(point) ? -distance : distance;
  }
  const BruteLoop& near(const Vector3&, double) const { return *this; }

 private:
  void subdivide() {
    LoopMesh fine = geometry::loop_reference::subdivide(mesh_);
    std::vector<Vector3> limits = brute_limits(fine);
    margin_ = 0.0;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {  // the middle of side i is corner i - 1 of the inner child
        const Vector3 chord = 0.5 * (limits_[mesh_.faces[f][i]] + limits_[mesh_.faces[f][(i + 1) % 3]]);
        margin_ = std::max(margin_, (limits[fine.faces[4 * f + 3][(i + 2) % 3]] - chord).norm());
      }
    }
    mesh_ = std::move(fine);
    limits_ = std::move(limits);
    margin_ *= 0.5;
  }

  LoopMesh mesh_;
  std::vector<Vector3> limits_;
  std::shared_ptr<const geometry::TriangleTree> tree_;
  double margin_ = 0.0;  // m
  bool closed_ = true;
};

/// The surface around a place, ever finer: a face, and three rings of faces around it.
class LoopZoom {
 public:
  static constexpr int kRings = 3;  // within two of them limits are known, and after a subdivision again

  LoopZoom(const BruteLoop& loop, const Vector3& place)
      : place_(place),
        mesh_(geometry::loop_reference::trimmed(loop.mesh(), loop.nearest_face(place), kRings)) {
    look();
  }

  void refine() {
    LoopMesh fine = geometry::loop_reference::subdivide(mesh_);
    const std::vector<Vector3> limits = brute_limits(fine);
    std::size_t keep = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto& corners = mesh_.faces[f];
      if (std::none_of(corners.begin(), corners.end(), [&](auto v) { return ring_.at(v) == 0; })) continue;
      for (std::size_t child = 4 * f; child < 4 * f + 4; ++child) {
        const auto& [a, b, c] = fine.faces[child];
        const double distance = (brute_nearest(limits[a], limits[b], limits[c], place_) - place_).norm();
        if (distance < least) least = distance, keep = child;
      }
    }
    mesh_ = geometry::loop_reference::trimmed(fine, keep, kRings);
    look();
  }

  /// Of the place over the face next to it, along that face's normal (m).
  double height() const {
    const auto& [a, b, c] = mesh_.faces[0];
    const Vector3 out = (limits_[b] - limits_[a]).cross(limits_[c] - limits_[a]);
    return out.normalized().dot(place_ - limits_[a]);
  }

  /// Calls `visit(point, frontier)` for all known places of the surface; those at the frontier surround the
  /// others (but for the rim of a sheet).
  template <typename Visit>
  void samples(Visit&& visit) const {
    for (const auto& [v, ring] : ring_) {
      if (ring < kRings) visit(limits_[v], ring == kRings - 1);
    }
  }

 private:
  void look() {
    limits_ = brute_limits(mesh_);
    ring_.clear();
    for (const auto v : mesh_.faces[0]) ring_[v] = 0;
    for (int ring = 1; ring <= kRings; ++ring) {
      const std::map<std::uint32_t, int> inner = ring_;
      for (const auto& face : mesh_.faces) {
        if (std::none_of(face.begin(), face.end(), [&](auto v) { return inner.contains(v); })) continue;
        for (const auto v : face) ring_.try_emplace(v, ring);
      }
    }
  }

  Vector3 place_;
  LoopMesh mesh_;
  std::vector<Vector3> limits_;
  std::map<std::uint32_t, int> ring_;  // of vertices, around face 0
};

/// Looks at the surface around the SCP, first at the least scale, then at greater ones, until all that
/// surrounds it is farther from the tip: then this basin holds the best place.
inline ScpError brute_scp_error(const BruteLoop& loop, const Vector3& tip, const Vector3& scp, double size) {
  constexpr int kScales = 11;
  std::vector<LoopZoom> scales{LoopZoom(loop, scp)};
  while (scales.size() < kScales) {
    scales.push_back(scales.back());
    scales.back().refine();
  }
  ScpError result;
  result.inside = std::max(0.0, -scales.back().height());
  result.rest = scp;
  const double here = (scp - tip).norm(), tell = 1e-9 * size;
  for (auto zoom = scales.rbegin(); zoom != scales.rend(); ++zoom) {
    bool surrounded = true;
    zoom->samples([&](const Vector3& point, bool frontier) {
      const double drop = here - (point - tip).norm();
      if (frontier && drop > 0.0) surrounded = false;
      if (drop < tell || drop < result.drop) return;
      result.drop = drop;
      result.error = (point - scp).norm();
      result.rest = point;
    });
    if (surrounded) break;
  }
  return result;
}

/// As for a solid; the chord of a smooth way may dip below the surface, by little for its length.
inline Way brute_way(const BruteLoop& loop, const Vector3& from, const Vector3& to, const Vector3& tip,
                     double size) {
  constexpr int kSamples = 16;
  const double length = (to - from).norm();
  if (length <= 1e-6 * size) return Way::Straight;
  double deepest = 0.0;
  for (int i = 1; i < kSamples; ++i) {
    deepest = std::max(deepest, -loop.bound(from + (double(i) / kSamples) * (to - from)));
  }
  if (deepest <= 0.2 * length) return Way::Straight;
  return BruteWay<BruteLoop>(loop, from, to, tip).search(length / 12.0, 20'000);
}

}  // namespace icome::haptics
