#include "render/model/render_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/srgb.h"
#include "world/shape/csg_colours.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/picture_places.h"
#include "world/shape/solid_geometry.h"

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;
using world::MeshGeometry;

constexpr double kMeshCrease = 0.9;                // rad
constexpr double kScanCrease = 2.2;                // rad
constexpr double kSolidCrease = 0.6;               // rad, of fine triangles made of an exact shape
constexpr std::size_t kScanFrom = 20'000;          // triangles
constexpr std::size_t kFewTriangles = 300;         // need no coarser ones
constexpr std::uint32_t kNoVertex = 0xffffffff;    // ends a list of vertices
constexpr std::size_t kMostVerticesCompared = 64;  // at the tip of a fine cone each triangle has its own

/// Largest distance of triangles from the surface, as a share of its size: solids are sampled through
/// their volume, so finer takes much longer there.
double fineness(const world::Geometry& shape) {
  return shape.kind() == "implicit" ? 1.0 / 160.0 : 1.0 / 1500.0;
}

/// Fineness of a shape that is made again and again: an eighth of the work.
constexpr double kMovingFineness = 1.0 / 80.0;

const world::ImplicitGeometry* changing(const world::Geometry& shape) {
  const auto* implicit = dynamic_cast<const world::ImplicitGeometry*>(&shape);
  return implicit && implicit->surface()->changes() ? implicit : nullptr;
}

/// Linear; the value that stands for the material's own colour is passed on.
Eigen::Vector3f light_of_corner(const world::Colour& colour) {
  return Eigen::Vector3f(
      (colour == world::kMaterialsColour ? colour : base::linear_from_srgb(colour)).data());
}

/// All that a corner of a triangle brings along.
struct CornerLook {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector2f place = Eigen::Vector2f::Zero();
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();

  bool operator==(const CornerLook&) const = default;
};

/// Puts corners that look the same into one vertex each.
class ShapeWelder {
 public:
  ShapeWelder(const MeshGeometry& surface, RenderShape& out, double crease)
      : surface_(surface), out_(out), newest_(surface.mesh.positions.size(), kNoVertex) {
    normals_ = crease_normals(surface.mesh, crease);
    out_.mesh.vertices.reserve(surface.mesh.positions.size());
    out_.mesh.indices.reserve(3 * surface.mesh.triangles.size());
  }

  void add_triangles() {
    for (std::size_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
      // Triangles without area or with corners that make no sense have no normal.
      if (normals_[t][0].isZero()) continue;
      for (std::size_t k = 0; k < 3; ++k)
        out_.mesh.indices.push_back(vertex_of(surface_.mesh.triangles[t][k], look(t, k)));
    }
  }

 private:
  CornerLook look(std::size_t t, std::size_t k) const {
    CornerLook it;
    it.normal = normals_[t][k];
    if (!surface_.normals.empty()) {
      const Eigen::Vector3f own = surface_.normals[t][k].cast<float>();
      if (own.allFinite() && own.squaredNorm() > 0.01F) it.normal = own;
    }
    if (!surface_.texture_coordinates.empty()) it.place = surface_.texture_coordinates[t][k].cast<float>();
    if (!surface_.colours.empty()) it.colour = light_of_corner(surface_.colours[t][k]);
    return it;
  }

  CornerLook look(std::uint32_t vertex) const {
    CornerLook it;
    it.normal = out_.mesh.vertices[vertex].normal;
    if (!out_.picture_places.empty()) it.place = out_.picture_places[vertex];
    if (!out_.colours.empty()) it.colour = out_.colours[vertex];
    return it;
  }

  std::uint32_t vertex_of(std::uint32_t position, const CornerLook& wanted) {
    std::size_t compared = 0;
    for (std::uint32_t v = newest_[position]; v != kNoVertex && compared < kMostVerticesCompared;
         v = older_[v]) {
      if (look(v) == wanted) return v;
      ++compared;
    }
    const Vector3& at = surface_.mesh.positions[position];
    const auto made = std::uint32_t(out_.mesh.vertices.size());
    out_.mesh.vertices.push_back({((at - out_.mesh.centre) / out_.mesh.radius).cast<float>(), wanted.normal});
    if (!surface_.texture_coordinates.empty()) out_.picture_places.push_back(wanted.place);
    if (!surface_.colours.empty()) out_.colours.push_back(wanted.colour);
    older_.push_back(newest_[position]);
    return newest_[position] = made;
  }

  const MeshGeometry& surface_;
  RenderShape& out_;
  std::vector<std::array<Eigen::Vector3f, 3>> normals_;
  std::vector<std::uint32_t> newest_;  // newest vertex of each position
  std::vector<std::uint32_t> older_;   // the next older one at the same position, by vertex
};

/// Bounds of the corners that triangles use: a file may have others, far away.
Bounds used_bounds(const geometry::TriangleMesh& mesh) {
  Bounds box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      if (v < mesh.positions.size() && mesh.positions[v].allFinite()) box.extend(mesh.positions[v]);
    }
  }
  return box;
}

std::vector<Vector3> positions_of(const ShadingMesh& mesh) {
  std::vector<Vector3> positions;
  positions.reserve(mesh.vertices.size());
  for (const auto& vertex : mesh.vertices)
    positions.push_back(mesh.centre + mesh.radius * vertex.position.cast<double>());
  return positions;
}

using SolidPointer = std::shared_ptr<const RenderSolid>;

/// Sets the frame in which the numbers of buffers are small.
void choose_frame(RenderShape& shape) {
  if (shape.solid) {
    shape.mesh.centre = shape.solid->images.centre;
    shape.mesh.radius = shape.solid->images.radius;
    return;
  }
  shape.mesh.centre = 0.5 * shape.bounds.min() + 0.5 * shape.bounds.max();
  const double half = 0.5 * shape.bounds.sizes().stableNorm();
  if (half > 0.0 && std::isfinite(half)) shape.mesh.radius = half;
}

std::shared_ptr<RenderShape> make_from_surface(const MeshGeometry& surface, double crease,
                                               const SolidPointer& solid = nullptr) {
  auto shape = std::make_shared<RenderShape>();
  shape->bounds = used_bounds(surface.mesh);
  if (solid) {
    for (const Vector3& point : solid->images.surface) shape->bounds.extend(point);
  }
  if (shape->bounds.isEmpty()) return shape;
  shape->solid = solid;
  choose_frame(*shape);
  ShapeWelder(surface, *shape, crease).add_triangles();
  if (shape->mesh.indices.empty() && !solid) shape->bounds.setEmpty();
  shape->extremes = outermost(solid ? solid->images.surface : positions_of(shape->mesh));
  return shape;
}

/// Exact shapes are made of fewer triangles anew, which keeps their normals exact.
std::vector<ShapeLevel> coarser_primitives(const world::PrimitiveGeometry& primitive, const RenderShape& full,
                                           double tolerance) {
  std::vector<ShapeLevel> levels;
  std::size_t triangles = full.triangle_count();
  for (double coarser = 4.0 * tolerance; triangles > kFewTriangles; coarser *= 3.0) {
    const auto surface = primitive.triangles(coarser);
    if (!surface || 3 * (*surface)->mesh.triangles.size() > 2 * triangles) break;
    ShapeLevel level{make_from_surface(**surface, kSolidCrease)->mesh, {}, 2.0 * coarser / full.mesh.radius};
    change_frame(level.mesh, full.mesh.centre, full.mesh.radius);
    triangles = level.mesh.indices.size() / 3;
    levels.push_back(std::move(level));
  }
  return levels;
}

std::shared_ptr<RenderShape> with_levels(std::shared_ptr<RenderShape> shape) {
  shape->coarser = make_shape_levels(shape->mesh, shape->colours);
  return shape;
}

}  // namespace

bool changes(const world::Geometry& shape) { return changing(shape) != nullptr; }

base::Result<RenderShapePointer> make_render_shape(const world::Geometry& shape, double time) {
  if (const auto* mesh = dynamic_cast<const MeshGeometry*>(&shape))
    return with_levels(
        make_from_surface(*mesh, mesh->mesh.triangles.size() > kScanFrom ? kScanCrease : kMeshCrease));
  if (const auto* csg = dynamic_cast<const world::CsgGeometry*>(&shape)) {
    const auto drawn = make_drawn_solid(*csg);
    if (!drawn) return tl::unexpected(drawn.error());
    const auto made = make_from_surface(*drawn->surface, kSolidCrease, drawn->solid);
    made->lacks_parts = drawn->lacks_parts;
    // Colours of operands end at edges: they must not be averaged.
    return made->colours.empty() ? with_levels(made) : made;
  }
  const Bounds box = shape.bounds();
  const double size = box.isEmpty() ? 0.0 : box.sizes().stableNorm();
  if (box.isEmpty()) return std::make_shared<const RenderShape>();
  const double tolerance = std::isfinite(size) && size > 0.0 ? size * fineness(shape) : 1.0;
  const auto* const moving = time == 0.0 ? nullptr : changing(shape);
  if (const auto* implicit = dynamic_cast<const world::ImplicitGeometry*>(&shape); implicit && !moving) {
    const auto solid = implicit->triangles_so_far(tolerance);
    if (!solid) return tl::unexpected(solid.error());
    const auto made = make_from_surface(*solid->mesh, kSolidCrease);
    made->lacks_parts = solid->lost.has_value();
    return with_levels(made);
  }
  const auto surface =
      moving ? moving->triangles_at(time, size * kMovingFineness) : shape.triangles(tolerance);
  if (!surface) return tl::unexpected(surface.error());
  if (const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape)) {
    MeshGeometry wrapped = **surface;
    wrapped.texture_coordinates = world::picture_places(*primitive, wrapped.mesh);
    const auto made = make_from_surface(wrapped, kSolidCrease);
    made->coarser = coarser_primitives(*primitive, *made, tolerance);
    return made;
  }
  const auto made = make_from_surface(**surface, kSolidCrease);
  return moving ? made : with_levels(made);
}

}  // namespace icome::render
