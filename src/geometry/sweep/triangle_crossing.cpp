#include "geometry/sweep/triangle_crossing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/tree/box_tree.h"

namespace icome::geometry {
namespace {

bool goes_through(const Vector3& a, const Vector3& b, const std::array<Vector3, 3>& corners,
                  double tolerance) {
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const double height_a = normal.dot(a - corners[0]);
  const double height_b = normal.dot(b - corners[0]);
  if (std::min(height_a, height_b) >= -tolerance || std::max(height_a, height_b) <= tolerance) return false;
  const Vector3 meeting = a + height_a / (height_a - height_b) * (b - a);
  for (int i = 0; i < 3; ++i) {
    const Vector3 inward = normal.cross(corners[(i + 1) % 3] - corners[i]).normalized();
    if (inward.dot(meeting - corners[i]) <= tolerance) return false;
  }
  return true;
}

/// The triangles, seen from one of their corners so that single precision tells them apart.
class EdgeThroughTriangles {
 public:
  EdgeThroughTriangles(const TriangleMesh& mesh, std::size_t first, double tolerance)
      : mesh_(mesh), first_(first), tolerance_(tolerance), origin_(mesh.corner(first, 0)) {
    std::vector<FloatBox> boxes;
    for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
      Bounds box;
      for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i) - origin_);
      boxes.push_back(float_box(box));
    }
    tree_ = BoxTree(boxes);
  }

  TriangleCrossing sought_along(std::uint32_t a, std::uint32_t b, std::uint64_t& tests_left) const {
    const SegmentQuery query(mesh_.positions[a] - origin_, mesh_.positions[b] - origin_, 0.0);
    TriangleCrossing crossing = TriangleCrossing::None;
    tree_.near(query, [&](std::uint32_t leaf) {
      if (tests_left == 0) {
        crossing = TriangleCrossing::NotSought;
        return false;
      }
      --tests_left;
      const TriangleMesh::Triangle& triangle = mesh_.triangles[first_ + leaf];
      const bool shares = std::ranges::any_of(triangle, [&](std::uint32_t v) { return v == a || v == b; });
      if (shares || !goes_through(mesh_.positions[a], mesh_.positions[b],
                                  {mesh_.corner(first_ + leaf, 0), mesh_.corner(first_ + leaf, 1),
                                   mesh_.corner(first_ + leaf, 2)},
                                  tolerance_))
        return true;
      crossing = TriangleCrossing::Found;
      return false;
    });
    return crossing;
  }

 private:
  const TriangleMesh& mesh_;
  std::size_t first_;
  double tolerance_;
  Vector3 origin_;
  BoxTree tree_ = {};
};

}  // namespace

TriangleCrossing find_crossing(const TriangleMesh& mesh, std::size_t first, double tolerance, bool closed,
                               std::uint64_t& tests_left) {
  if (first >= mesh.triangles.size()) return TriangleCrossing::None;
  const EdgeThroughTriangles search(mesh, first, tolerance);
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    const TriangleMesh::Triangle& corners = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i];
      const std::uint32_t b = corners[(i + 1) % 3];
      if (closed && a > b) continue;
      const TriangleCrossing crossing = search.sought_along(a, b, tests_left);
      if (crossing != TriangleCrossing::None) return crossing;
    }
  }
  return TriangleCrossing::None;
}

}  // namespace icome::geometry
