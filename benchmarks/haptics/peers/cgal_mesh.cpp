#include "peers/cgal_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <malloc.h>

#include <vector>

#include "base/clock.h"

namespace icome::benchmarks {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using CgalTriangle = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

std::size_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

struct CgalMesh::Tree {
  Triangles triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CgalTriangle>> boxes;
};

CgalMesh::CgalMesh(const geometry::TriangleMesh& mesh) {
  const std::size_t before = heap_bytes();
  const std::int64_t begin = base::steady_nanoseconds();
  tree_ = std::make_unique<Tree>();
  tree_->triangles.reserve(mesh.triangles.size());
  const auto corner = [&](std::size_t triangle, int which) {
    const base::Vector3& position = mesh.corner(triangle, which);
    return Kernel::Point_3(position.x(), position.y(), position.z());
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    tree_->triangles.emplace_back(corner(i, 0), corner(i, 1), corner(i, 2));
  }
  tree_->boxes.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->boxes.build();
  tree_->boxes.accelerate_distance_queries();
  build_seconds_ = double(base::steady_nanoseconds() - begin) * 1e-9;
  bytes_ = heap_bytes() - before;
}

CgalMesh::~CgalMesh() = default;

base::Vector3 CgalMesh::nearest(const base::Vector3& point) const {
  const Kernel::Point_3 place = tree_->boxes.closest_point({point.x(), point.y(), point.z()});
  return {place.x(), place.y(), place.z()};
}

}  // namespace icome::benchmarks
