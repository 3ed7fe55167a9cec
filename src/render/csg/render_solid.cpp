#include "render/csg/render_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "render/csg/csg_cost.h"
#include "world/shape/csg_colours.h"

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;
using world::MeshGeometry;
using Surface = std::shared_ptr<const MeshGeometry>;

// Shares of the solid's size: solids are sampled through their volume, so finer takes much longer.
constexpr double kFine = 1.0 / 160.0;
constexpr double kCoarse = 1.0 / 64.0;

/// The filled cells of a grid.
class Cells {
 public:
  explicit Cells(double side) : side_(side) {}

  /// Fills cells so densely that all of a triangle has one of them within reach: flat faces have large ones.
  void add(std::array<Vector3, 3> corners) {
    const auto edge = [&](std::size_t i) { return (corners[(i + 1) % 3] - corners[i]).norm(); };
    const std::size_t longest = edge(0) >= edge(1) && edge(0) >= edge(2) ? 0 : edge(1) >= edge(2) ? 1 : 2;
    std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(longest), corners.end());
    const auto& [a, b, tip] = corners;
    const double area = (b - a).cross(tip - a).norm(), length = (b - a).norm();
    const int rows = steps_over(length > 0.0 ? area / length : 0.0);
    for (int r = 0; r <= rows; ++r) {
      const double up = double(r) / rows;
      const Vector3 begin = a + up * (tip - a), end = b + up * (tip - b);
      const int steps = steps_over((end - begin).norm());
      for (int i = 0; i <= steps; ++i) add_point(begin + double(i) / steps * (end - begin));
    }
  }

  /// Is the point's cell or one beside it filled?
  bool has_near(const Vector3& point) const {
    const std::array<std::int64_t, 3> middle = cell(point);
    for (int i = 0; i < 27; ++i) {
      if (filled_.contains(key({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1})))
        return true;
    }
    return false;
  }

 private:
  void add_point(const Vector3& point) { filled_.insert(key(cell(point))); }
  /// Number of steps over a length, each no longer than a side.
  int steps_over(double length) const { return std::max(1, int(std::ceil(length / side_))); }

  std::array<std::int64_t, 3> cell(const Vector3& point) const {
    std::array<std::int64_t, 3> c;
    for (int i = 0; i < 3; ++i) c[std::size_t(i)] = std::int64_t(std::floor(point[i] / side_));
    return c;
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
    return std::uint64_t(c[0]) * 0x9e3779b97f4a7c15ULL ^ std::uint64_t(c[1]) * 0xc2b2ae3d27d4eb4fULL ^
           std::uint64_t(c[2]) * 0x165667b19e3779f9ULL;
  }

  double side_;
  std::unordered_set<std::uint64_t> filled_;
};

/// Is there nothing but solid around a point of an operand's surface? There products of a union overlap.
bool is_within(const geometry::CsgTree& tree, const Vector3& point, double reach) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      if (!geometry::inside(tree, point + sign * reach * Vector3::Unit(axis))) return false;
    }
  }
  return true;
}

/// Are there triangles wherever the solid has surface? Sampling loses parts that are thinner than a cell.
bool is_whole(const MeshGeometry& surface, const CsgGeometry& images, const geometry::CsgTree& tree,
              double cell) {
  constexpr std::size_t kMostAsked = 20'000;
  Cells cells(2.0 * cell);
  const auto corner = [&](std::size_t t, int k) -> Vector3 {
    return surface.mesh.corner(t, k) - images.centre;
  };
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    cells.add({corner(t, 0), corner(t, 1), corner(t, 2)});
  const std::size_t step = 1 + images.surface.size() / kMostAsked;
  for (std::size_t i = 0; i < images.surface.size(); i += step) {
    const Vector3& point = images.surface[i];
    if (!cells.has_near(point - images.centre) && !is_within(tree, point, 0.5 * cell)) return false;
  }
  return true;
}

/// Time of images, s, in a view of usual size that the solid fills.
double usual_seconds(const CsgGeometry& images) {
  constexpr double kWidth = 1280.0, kHeight = 800.0;  // pixels
  FitOptions fit;
  fit.toward_eye = Vector3(1.0, 0.8, 1.2);
  fit.aspect = kWidth / kHeight;
  return software_seconds(images, fit_camera(images.surface, fit).clip_from_world(), kWidth * kHeight);
}

/// The images with the triangles that they need beside them; the quickest to make are tried first.
DrawnSolid with_triangles(const world::CsgGeometry& shape, CsgGeometry images, double size) {
  auto solid = std::make_shared<RenderSolid>();
  solid->images = std::move(images);
  DrawnSolid drawn;
  std::optional<Surface> made;
  if (usual_seconds(solid->images) <= kLongestLiveView) {
    if (auto coarse = shape.surface(size * kCoarse);
        coarse && !coarse->lost && is_whole(*coarse->mesh, solid->images, shape.tree, size * kCoarse))
      made = coarse->mesh;
  }
  if (!made) {
    auto fine = shape.surface(size * kFine);
    const bool whole = fine && !fine->lost && is_whole(*fine->mesh, solid->images, shape.tree, size * kFine);
    solid->triangles = whole ? RenderSolid::Triangles::Fine : RenderSolid::Triangles::Partial;
    made = fine ? fine->mesh : std::make_shared<const MeshGeometry>(geometry::TriangleMesh{});
  }
  return {std::move(solid), world::coloured_by_operands(shape.tree, *made)};
}

}  // namespace

base::Result<DrawnSolid> make_drawn_solid(const world::CsgGeometry& shape) {
  const Bounds box = shape.bounds();
  const double size = box.isEmpty() ? 0.0 : box.sizes().stableNorm();
  const double unit = std::isfinite(size) && size > 0.0 ? size : 1.0;
  auto images = make_csg_geometry(shape.tree);
  if (images && !images->products.empty()) return with_triangles(shape, std::move(*images), unit);
  auto surface = shape.surface(unit * kFine);
  if (!surface) return tl::unexpected(surface.error());
  return DrawnSolid{nullptr, world::coloured_by_operands(shape.tree, surface->mesh),
                    surface->lost.has_value()};
}

}  // namespace icome::render
