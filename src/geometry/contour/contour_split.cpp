#include "geometry/contour/contour_split.h"

#include <algorithm>
#include <cmath>

#include "geometry/contour/contour_search.h"

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Quads whose triangles, however divided, are within this cosine of the surface's normal have no edge of the
/// surface inside them.
constexpr double kNearlyFlat = 0.9;
/// Quads whose diagonals pass each other at this part of a cell are planar: either diagonal will do.
constexpr double kPlanar = 1e-9;
/// Triangles less high than this part of their longest edge are slivers.
constexpr double kSliver = 1e-6;
constexpr double kSliverFault = 8.0;  // cells

/// The triangles of a quad divided along its diagonal from corner 0 to 2, or from 1 to 3. The diagonal runs
/// from the first to the last corner of the first triangle.
std::array<Triangle, 2> divide(const ContourQuad& quad, bool from_first) {
  if (from_first) return {{{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}}};
  return {{{quad[1], quad[2], quad[3]}, {quad[1], quad[3], quad[0]}}};
}

}  // namespace

QuadSplit QuadSplitter::split(const ContourQuad& quad, const Vector3& normal) const {
  const auto first = divide(quad, true), second = divide(quad, false);
  const Vector3 one = at(quad[2]) - at(quad[0]), other = at(quad[3]) - at(quad[1]);
  const Vector3 across = one.cross(other).normalized();
  if (std::min(agreement(first, normal), agreement(second, normal)) > kNearlyFlat) {
    const bool planar = std::abs(across.dot(at(quad[1]) - at(quad[0]))) <= kPlanar * cell_;
    if (planar) return {one.squaredNorm() <= other.squaredNorm() ? first : second};
    return {off_surface(quad[0], quad[2], across) <= off_surface(quad[1], quad[3], across) ? first : second};
  }
  const double first_fault = fault(first, across), second_fault = fault(second, across);
  return first_fault <= second_fault ? QuadSplit{first, first_fault} : QuadSplit{second, second_fault};
}

bool QuadSplitter::sliver(const Triangle& triangle) const {
  double longest = 0.0;
  for (int i = 0; i < 3; ++i) {
    longest = std::max(longest, (at(triangle[(i + 1) % 3]) - at(triangle[i])).squaredNorm());
  }
  return !(doubled_area(triangle).norm() > kSliver * longest);
}

/// The smaller cosine between the triangles' normals and this one.
double QuadSplitter::agreement(const std::array<Triangle, 2>& triangles, const Vector3& normal) const {
  double least = 1.0;
  for (const Triangle& triangle : triangles) {
    least = std::min(least, sliver(triangle) ? -1.0 : this->normal(triangle).dot(normal));
  }
  return least;
}

/// The distance of a diagonal's middle from the surface along `direction`; one cell where none is found.
double QuadSplitter::off_surface(std::uint32_t from, std::uint32_t to, const Vector3& direction) const {
  const Vector3 middle = (at(from) + at(to)) / 2;
  const auto found = search_along(*solid_, middle, direction, cell_);
  return found ? (found->point - middle).norm() : cell_;
}

double QuadSplitter::fault(const std::array<Triangle, 2>& triangles, const Vector3& across) const {
  for (const Triangle& triangle : triangles) {
    if (sliver(triangle)) return kSliverFault * cell_;
  }
  double worst = off_surface(triangles[0][0], triangles[0][2], across);
  for (const Triangle& triangle : triangles) {
    const Vector3 faces = normal(triangle), middle = centre(triangle);
    const auto found = search_along(*solid_, middle, faces, cell_);
    const double off = found ? (found->point - middle).norm() : cell_;
    const double turned = found ? 1 - found->normal.dot(faces) : 1.0;
    worst = std::max(worst, off + turned * cell_);
  }
  return worst;
}

}  // namespace icome::geometry
