#pragma once
// Control meshes of Loop surfaces to be touched.
#include "haptics/loop_brute.h"

namespace icome::haptics {

constexpr double kLoopSize = 0.1;  // m

/// Its limit around the origin, the longest side kLoopSize.
inline ControlMesh fitted(ControlMesh control) {
  base::Bounds box;
  for (const Vector3& p : brute_limits(geometry::loop_reference::from_control(control))) box.extend(p);
  const double scale = kLoopSize / box.sizes().maxCoeff();
  control.mesh = scaled(control.mesh, scale, -scale * box.center());
  return control;
}

inline ControlMesh bipyramid(std::uint32_t valence, double jolt = 0.0) {
  return fitted({geometry::loop_reference::bipyramid(valence, jolt, valence), {}, {}});
}

inline ControlMesh icosahedron() {
  const double g = 1.618033988749895;
  TriangleMesh mesh;
  for (const double one : {-1.0, 1.0}) {
    for (const double other : {-g, g}) {
      mesh.positions.insert(mesh.positions.end(), {{0, one, other}, {one, other, 0}, {other, 0, one}});
    }
  }
  const auto count = std::uint32_t(mesh.positions.size());
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return (mesh.positions[a] - mesh.positions[b]).norm() < 2.1;  // its edges are 2 long
  };
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      for (std::uint32_t c = b + 1; c < count; ++c) {
        if (!joined(a, b) || !joined(b, c) || !joined(c, a)) continue;
        const auto& p = mesh.positions;
        const bool out = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[a]) > 0.0;
        mesh.triangles.push_back(out ? TriangleMesh::Triangle{a, b, c} : TriangleMesh::Triangle{a, c, b});
      }
    }
  }
  return fitted({mesh, {}, {}});
}

inline ControlMesh quad_torus(std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 6.283185307179586 * i / around, b = 6.283185307179586 * j / across;
      const double rho = 1.0 + 0.45 * std::cos(b);
      mesh.positions.emplace_back(rho * std::cos(a), rho * std::sin(a), 0.45 * std::sin(b));
      const auto at = [&](std::uint32_t k, std::uint32_t l) { return k % around * across + l % across; };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return fitted({mesh, {}, {}});
}

inline ControlMesh open_sheet() {
  return fitted(
      {height_field(1.0, 5, [](double x, double y) { return 0.2 * std::sin(5 * x) * std::cos(4 * y); }),
       {},
       {}});
}

/// A box whose top is framed by creases, and one of its lower vertices stays a corner.
inline ControlMesh creased_box() {
  ControlMesh control{box_mesh({1.0, 0.8, 0.6}), {}, {}};
  control.creases = {{4, 5}, {5, 7}, {7, 6}, {6, 4}};
  control.corners = {0};
  return fitted(control);
}

struct TouchedLoop {
  std::string name;
  ControlMesh control;

  friend std::ostream& operator<<(std::ostream& out, const TouchedLoop& it) { return out << it.name; }
};

inline std::vector<TouchedLoop> touched_loops() {
  return {{"Octahedron", bipyramid(4)},
          {"Icosahedron", icosahedron()},
          {"Torus", quad_torus(10, 6)},
          {"OpenSheet", open_sheet()},
          {"CreasedBox", creased_box()},
          {"Valence3", bipyramid(3, 0.05)},
          {"Valence12", bipyramid(12, 0.05)},
          {"WildBall", fitted({geometry::loop_reference::wild_ball(1, 30, 0.15, 1), {}, {}})}};
}

/// The ground under a sheet, for ways that press on it.
struct SheetGround {
  const BruteLoop& loop;
  bool inside(const Vector3& p) const {
    return p.z() > -0.5 * kLoopSize && loop.tree().first_hit(p, p + kLoopSize * Vector3::UnitZ());
  }
};

}  // namespace icome::haptics
