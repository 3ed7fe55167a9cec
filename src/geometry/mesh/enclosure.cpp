#include "geometry/mesh/enclosure.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

/// The queries sorted into the cells of a square grid over their x and y, so that a triangle meets only
/// those below or above it.
class QueryGrid {
 public:
  explicit QueryGrid(std::span<const EnclosureQuery> queries) {
    for (const EnclosureQuery& query : queries) box_.extend(query.point);
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(queries.size()))));
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (std::uint32_t i = 0; i < queries.size(); ++i)
      cells_[cell_index(column(queries[i].point.x(), 0), column(queries[i].point.y(), 1))].push_back(i);
  }

  /// Calls visit(query index) for every query whose cell touches the box's shadow.
  template <typename Visit>
  void for_each_under(const Bounds& box, Visit visit) const {
    if (box.max().x() < box_.min().x() || box.min().x() > box_.max().x()) return;
    if (box.max().y() < box_.min().y() || box.min().y() > box_.max().y()) return;
    const int x_end = column(box.max().x(), 0);
    const int y_end = column(box.max().y(), 1);
    for (int y = column(box.min().y(), 1); y <= y_end; ++y)
      for (int x = column(box.min().x(), 0); x <= x_end; ++x)
        for (const std::uint32_t query : cells_[cell_index(x, y)]) visit(query);
  }

 private:
  std::size_t cell_index(int x, int y) const { return static_cast<std::size_t>(y) * side_ + x; }

  int column(double value, int axis) const {
    const double extent = box_.sizes()[axis];
    if (!(extent > 0.0)) return 0;
    const double column = (value - box_.min()[axis]) / extent * side_;
    return static_cast<int>(std::clamp(column, 0.0, side_ - 1.0));
  }

  Bounds box_;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// Does the edge's shadow cross the half-line from `point` in +x? Endpoints in a fixed order, so that
/// the two triangles of an edge always agree and the ray never slips between them.
bool edge_right_of(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, const Vector3& point) {
  if (a > b) std::swap(a, b);
  const Vector3& p = mesh.positions[a];
  const Vector3& q = mesh.positions[b];
  if ((p.y() > point.y()) == (q.y() > point.y())) return false;
  return p.x() + (point.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x()) > point.x();
}

/// Does the ray from `point` in +z pass through the triangle?
bool triangle_above(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle, const Vector3& point) {
  bool under = false;
  for (int corner = 0; corner < 3; ++corner)
    under ^= edge_right_of(mesh, triangle[corner], triangle[(corner + 1) % 3], point);
  if (!under) return false;
  const Vector3 a = mesh.positions[triangle[0]];
  const Vector3 normal = (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a);
  const double side = normal.dot(point - a);
  return normal.z() > 0.0 ? side < 0.0 : side > 0.0;
}

}  // namespace

std::vector<bool> enclosed(const TriangleMesh& mesh, std::span<const std::uint32_t> part_of_triangle,
                           std::span<const EnclosureQuery> queries) {
  assert(part_of_triangle.size() == mesh.triangles.size());
  std::vector<bool> odd(queries.size(), false);
  if (queries.empty()) return odd;
  const QueryGrid grid(queries);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (part_of_triangle[t] == kNoTriangle) continue;
    Bounds box;
    for (int corner = 0; corner < 3; ++corner) box.extend(mesh.corner(t, corner));
    grid.for_each_under(box, [&](std::uint32_t i) {
      if (queries[i].part != part_of_triangle[t] && triangle_above(mesh, mesh.triangles[t], queries[i].point))
        odd[i] = !odd[i];
    });
  }
  return odd;
}

}  // namespace icome::geometry
