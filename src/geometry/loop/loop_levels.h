#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "geometry/loop/loop_surface.h"

namespace icome::geometry {

/// One refinement of a control mesh by Loop's scheme.
struct LoopLevel {
  TriangleMesh mesh;  // face f has the children 4f to 4f + 3 in the next level

  /// The normal of the limit surface at each corner of each face, as an index into `normals`: both sides
  /// of a crease have their own.
  std::vector<std::array<std::uint32_t, 3>> corner_normals;
  std::vector<Vector3> normals;  // unit

  // The faces around vertex v: around[first_around[v]] up to, not including, around[first_around[v + 1]].
  // Both are empty in the finest level, whose neighbourhoods are not needed.
  std::vector<std::uint32_t> first_around;
  std::vector<std::uint32_t> around;

  std::span<const std::uint32_t> faces_around(std::uint32_t vertex) const {
    return std::span(around).subspan(first_around[vertex], first_around[vertex + 1] - first_around[vertex]);
  }
  std::size_t bytes() const;
};

struct LoopLevelsSettings {
  int finest = 4;                                // subdivisions, 0 to LoopLevels::kMost; usually 3 to 5
  std::size_t max_bytes = std::size_t(1) << 30;  // held when done; refining takes some more for a while
};

/// A control mesh and its refinements with the links from faces to their children, made once
/// (thesis 5.4.1: every face of a level has four in the next). Immutable.
class LoopLevels {
 public:
  static constexpr int kMost = 10;

  /// Boundaries become subdivision curves, creases and corners stay sharp. Fails with a sentence on meshes
  /// that are no surface, and when the levels would take more memory than allowed.
  static base::Result<std::shared_ptr<const LoopLevels>> create(const ControlMesh& control,
                                                                const LoopLevelsSettings& settings = {});

  int finest() const { return int(levels_.size()) - 1; }
  const LoopLevel& level(int which) const { return levels_[std::size_t(which)]; }
  /// Does the mesh divide inside from outside?
  bool closed() const { return closed_; }
  /// Bounds of every level: refined vertices are means of control vertices.
  Bounds bounds() const { return geometry::bounds(levels_.front().mesh); }
  std::size_t bytes() const;

 private:
  LoopLevels() = default;

  std::vector<LoopLevel> levels_;
  bool closed_ = false;
};

}  // namespace icome::geometry
