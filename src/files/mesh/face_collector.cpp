#include "files/mesh/face_collector.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "geometry/mesh/polygon_triangulation.h"

namespace icome::files {

bool FaceCollector::add_face(const std::vector<std::uint32_t>& corners) {
  if (corners.size() > geometry::kMaximumPolygonCorners) return false;
  if (corners.size() < 3) {
    ++short_faces_;
  } else if (corners.size() == 3) {
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
  } else {
    polygon_corners_.insert(polygon_corners_.end(), corners.begin(), corners.end());
    polygon_sizes_.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return true;
}

geometry::TriangleMesh FaceCollector::take(io::TimeBudget* time_budget) {
  std::vector<geometry::Vector3> corners;
  std::vector<std::array<std::uint32_t, 3>> cut;
  const std::uint32_t* polygon = polygon_corners_.data();
  for (const std::uint32_t size : polygon_sizes_) {
    if (time_budget && !time_budget->lasts_for_polygon(size)) break;
    corners.clear();
    cut.clear();
    for (std::uint32_t i = 0; i < size; ++i) corners.push_back(mesh_.positions[polygon[i]]);
    geometry::triangulate_polygon(corners, cut);
    for (const auto& [a, b, c] : cut) mesh_.triangles.push_back({polygon[a], polygon[b], polygon[c]});
    polygon += size;
  }
  return std::move(mesh_);
}

std::vector<std::string> FaceCollector::notes() const {
  if (short_faces_ == 0) return {};
  return {fmt::format("{} fewer than three corners left out",
                      short_faces_ == 1 ? "1 face with" : fmt::format("{} faces with", short_faces_))};
}

std::string too_many_corners(std::size_t corners) {
  return fmt::format("a face has {} corners; {} are the most that can be read", corners,
                     geometry::kMaximumPolygonCorners);
}

}  // namespace icome::files
