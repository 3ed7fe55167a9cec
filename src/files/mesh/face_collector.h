#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "io/time_budget.h"

namespace icome::files {

/// Gathers the faces of a file, whose vertices may come later, and makes a triangle mesh of them.
class FaceCollector {
 public:
  void reserve(std::size_t faces) { mesh_.triangles.reserve(faces); }
  void add_position(const geometry::Vector3& position) { mesh_.positions.push_back(position); }
  void reserve_positions(std::size_t count) { mesh_.positions.reserve(count); }
  std::size_t positions() const { return mesh_.positions.size(); }

  /// Takes a polygon of any size; those with fewer than three corners are counted and left out. False
  /// when it has more than geometry::kMaximumPolygonCorners.
  bool add_face(const std::vector<std::uint32_t>& corners);

  /// The mesh: triangular faces in their order, then the polygons cut into triangles. Every index must be
  /// below positions(). Leaves the collector empty. The mesh is incomplete when the time budget (may be
  /// null) ends.
  geometry::TriangleMesh take(io::TimeBudget* time_budget = nullptr);

  /// One sentence on each kind of loss.
  std::vector<std::string> notes() const;

 private:
  geometry::TriangleMesh mesh_;
  std::vector<std::uint32_t> polygon_corners_;  // of all polygons, one after the other
  std::vector<std::uint32_t> polygon_sizes_;
  std::size_t short_faces_ = 0;
};

/// The sentence for a face that add_face() refuses.
std::string too_many_corners(std::size_t corners);

}  // namespace icome::files
