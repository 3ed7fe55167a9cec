#pragma once
// What the tests of contact share: scenes, meshes with known trouble in them, paths, and answers found by
// looking at every triangle, without the code under test.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/random.h"
#include "geometry/mesh/triangle_mesh.h"
#include "haptics/contact/haptic_scene.h"
#include "haptics/contact/scp_solver.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/primitive_shape.h"
#include "repeats.h"

namespace icome::haptics {

using base::Random;
using geometry::TriangleMesh;
using MeshPointer = std::shared_ptr<const TriangleMesh>;
using ScenePointer = std::shared_ptr<const HapticScene>;

inline geometry::Primitive primitive(std::string_view text) { return *geometry::parse_primitive(text); }

inline std::shared_ptr<const Shape> shape_of(const geometry::Primitive& primitive) {
  return std::make_shared<PrimitiveShape>(primitive);
}

/// `tip_radius`: what the shape prepares for (m); it must serve any other as well.
inline std::shared_ptr<const Shape> shape_of(const MeshPointer& mesh, bool closed = true,
                                             double tip_radius = 0.0) {
  MeshShapeSettings settings;
  settings.closed = closed;
  settings.tip_radius = tip_radius;
  return std::make_shared<MeshShape>(mesh, settings);
}

inline MeshPointer shared(TriangleMesh mesh) { return std::make_shared<const TriangleMesh>(std::move(mesh)); }

inline HapticObject object(std::uint32_t id, std::shared_ptr<const Shape> shape,
                           const Pose& pose = Pose::Identity(),
                           TouchableSides sides = TouchableSides::Front) {
  HapticObject result;
  result.id = {id, 1};
  result.shape = std::move(shape);
  result.world_from_object = pose;
  result.surface.sides = sides;
  return result;
}

inline Pose random_pose(Random& random, double distance) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(random.uniform(0.0, 6.28), random.direction()).toRotationMatrix();
  pose.translation() = distance * random.direction();
  return pose;
}

inline Pose translation(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Vector3(x, y, z);
  return pose;
}

/// A solver that follows one tip through one scene, and keeps the scene. It has the product's budgets unless
/// told otherwise.
struct Toucher {
  explicit Toucher(ScenePointer touched, double tip_radius = 0.0,
                   int max_elements = ScpSettings().max_elements)
      : scene(std::move(touched)), solver({tip_radius, ScpSettings().max_iterations, max_elements}) {
    solver.adopt(*scene, {});
  }
  const ScpState& step(const Vector3& tip) { return solver.step(tip, 0.0); }

  /// Goes straight from `a` to `b` in `ticks` steps; the last state.
  const ScpState& go(const Vector3& a, const Vector3& b, int ticks) {
    for (int i = 1; i < ticks; ++i) step(a + (double(i) / ticks) * (b - a));
    return step(b);
  }

  ScenePointer scene;
  ScpSolver solver;
};

/// A box of 12 triangles, vertices shared, centred.
inline TriangleMesh box_mesh(const Vector3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        Vector3(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5).cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A height field z = height(x, y) on a square of side `size`, `cells` by `cells`, facing +z: open.
template <typename Height>
TriangleMesh height_field(double size, int cells, Height&& height) {
  TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = size * (double(i) / cells - 0.5);
      const double y = size * (double(j) / cells - 0.5);
      mesh.positions.emplace_back(x, y, height(x, y));
    }
  }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// An outline in the x-y plane (counter-clockwise, cut into triangles by `inner`) drawn out along z: closed.
inline TriangleMesh prism(const std::vector<base::Vector2>& outline,
                          const std::vector<TriangleMesh::Triangle>& inner, double height) {
  TriangleMesh mesh;
  const auto count = std::uint32_t(outline.size());
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const base::Vector2& p : outline) mesh.positions.emplace_back(p.x(), p.y(), z);
  }
  for (const auto& [a, b, c] : inner) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  return mesh;
}

/// Many triangles around an apex at the origin: a closed cone or, with `depth` < 0, a pit; rim at z = -depth.
inline TriangleMesh fan(int count, double radius, double depth) {
  TriangleMesh mesh;
  mesh.positions.push_back(Vector3::Zero());
  for (int i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count;
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -depth);
  }
  for (int i = 0; i < count; ++i) {
    mesh.triangles.push_back({0, std::uint32_t(1 + i), std::uint32_t(1 + (i + 1) % count)});
  }
  return mesh;
}

/// `to` with the triangles of `from` added.
inline TriangleMesh joined(TriangleMesh to, const TriangleMesh& from,
                           const Vector3& shift = Vector3::Zero()) {
  const auto base = std::uint32_t(to.positions.size());
  for (const Vector3& p : from.positions) to.positions.push_back(p + shift);
  for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({a + base, b + base, c + base});
  return to;
}

inline TriangleMesh scaled(TriangleMesh mesh, double scale, const Vector3& shift = Vector3::Zero()) {
  for (Vector3& p : mesh.positions) p = scale * p + shift;
  return mesh;
}

// ---- Answers by brute force over all triangles ----

/// The point of the triangle nearest to `p`: by the plane when its foot is within, else by the edges.
inline Vector3 brute_nearest(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  const auto on_edge = [&](const Vector3& from, const Vector3& to) {
    const Vector3 way = to - from;
    const double squared = way.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((p - from).dot(way) / squared, 0.0, 1.0) : 0.0;
    return Vector3(from + t * way);
  };
  const Vector3 n = (b - a).cross(c - a);
  if (n.squaredNorm() > 0.0 && (b - a).cross(p - a).dot(n) >= 0.0 && (c - b).cross(p - b).dot(n) >= 0.0 &&
      (a - c).cross(p - c).dot(n) >= 0.0) {
    return p - n * (n.dot(p - a) / n.squaredNorm());
  }
  Vector3 best = on_edge(a, b);
  for (const Vector3& q : {on_edge(b, c), on_edge(c, a)}) {
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

struct BruteNearest {
  Vector3 point;
  std::size_t triangle;
  double distance;
};

inline BruteNearest brute_nearest(const TriangleMesh& mesh, const Vector3& p) {
  BruteNearest best{Vector3::Zero(), 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 q = brute_nearest(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2), p);
    if ((q - p).norm() < best.distance) best = {q, i, (q - p).norm()};
  }
  return best;
}

inline Vector3 face_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const Vector3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).normalized();
}

/// Unit normals, from the surface to `p`, of all triangles that come within `reach` of `p`.
inline std::vector<Vector3> brute_normals(const TriangleMesh& mesh, const Vector3& p, double reach) {
  std::vector<Vector3> normals;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 q = brute_nearest(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2), p);
    if ((q - p).norm() <= reach) normals.push_back(face_normal(mesh, i));
  }
  return normals;
}

/// Six times the signed volume of a tetrahedron.
inline double brute_side(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  return (b - a).cross(c - a).dot(p - a);
}

/// Does the open segment pass through the triangle, from its front (or from either side)?
inline bool brute_crosses(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p,
                          const Vector3& q, bool either_side) {
  const double at_p = brute_side(a, b, c, p);
  const double at_q = brute_side(a, b, c, q);
  if (!(at_p > 0.0 && at_q < 0.0) && !(either_side && at_p < 0.0 && at_q > 0.0)) return false;
  const double u = brute_side(p, q, a, b);
  const double v = brute_side(p, q, b, c);
  const double w = brute_side(p, q, c, a);
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

inline bool brute_crosses(const TriangleMesh& mesh, const Vector3& p, const Vector3& q, bool either_side) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (brute_crosses(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2), p, q, either_side))
      return true;
  }
  return false;
}

/// Solid angle by Van Oosterom and Strackee (1983), summed: how often the mesh winds around `p`.
inline double brute_winding(const TriangleMesh& mesh, const Vector3& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 a = mesh.corner(i, 0) - p;
    const Vector3 b = mesh.corner(i, 1) - p;
    const Vector3 c = mesh.corner(i, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / 12.566370614359172;
}

/// The length of the part of `pull` that no combination of the (outward) normals can hold, relative to
/// pull: 0 when `pull` points into their cone. By cyclic projection onto the half-spaces (Dykstra).
inline double unheld_part(const std::vector<Vector3>& normals, const Vector3& pull) {
  if (normals.empty()) return 1.0;
  Vector3 step = pull;
  std::vector<double> push(normals.size(), 0.0);
  for (int round = 0; round < 2000; ++round) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double change = std::max(-push[i], -normals[i].dot(step));
      push[i] += change;
      step += change * normals[i];
    }
  }
  return step.norm() / pull.norm();
}

}  // namespace icome::haptics
