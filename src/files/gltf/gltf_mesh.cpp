#include "files/gltf/gltf_mesh.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "base/srgb.h"
#include "files/gltf/gltf_accessor.h"
#include "files/gltf/gltf_model.h"
#include "files/mesh/mesh_cleaning.h"
#include "files/mesh/unit_normal.h"
#include "geometry/mesh/weld.h"
#include "io/single.h"

namespace icome::files {
namespace {

using base::Vector2;
using base::Vector3;
using Triangle = geometry::TriangleMesh::Triangle;

/// The accessor of an attribute, which has a value for every vertex.
std::optional<GltfAccessor> attribute(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      const std::string& name, std::size_t least, std::size_t most) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return {};
  return GltfAccessor(model, found->second, least, most);
}

/// The vertices of the primitive's elements, one after the other.
std::vector<std::uint32_t> corners_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      std::size_t vertices) {
  std::vector<std::uint32_t> corners;
  if (primitive.indices < 0) {
    corners.resize(vertices);
    for (std::uint32_t v = 0; v < vertices; ++v) corners[v] = v;
    return corners;
  }
  const GltfAccessor indices(model, primitive.indices, 1, 1);
  if (indices.is_float()) throw GltfError("its indices are not whole numbers");
  corners.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t vertex = indices.whole(i);
    if (vertex >= vertices)
      throw GltfError(
          fmt::format("face refers to vertex {}; the {} vertices are numbered from 0", vertex, vertices));
    corners.push_back(vertex);
  }
  return corners;
}

std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& corners, int mode) {
  std::vector<Triangle> triangles;
  const bool list = mode == TINYGLTF_MODE_TRIANGLES;
  triangles.reserve(list ? corners.size() / 3 : corners.size());
  for (std::size_t i = 0; i + 2 < corners.size(); i += list ? 3 : 1) {
    Triangle triangle{corners[mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i], corners[i + 1], corners[i + 2]};
    // In a strip every second triangle runs the other way round; repeated vertices join parts.
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1) std::swap(triangle[1], triangle[2]);
    const bool joint = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (list || !joint) triangles.push_back(triangle);
  }
  return triangles;
}

/// Makes a shape of those vertices of a primitive that its triangles use: many primitives may share one
/// large table of vertices.
class PrimitiveReading {
 public:
  PrimitiveReading(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                   const GltfSurface& surface)
      : surface_(surface),
        positions_(model, position_accessor(primitive), 3, 3),
        normals_(surface.smooth ? std::nullopt : attribute(model, primitive, "NORMAL", 3, 3)),
        colours_(attribute(model, primitive, colours_name(primitive), 3, 4)),
        coordinates_(attribute(model, primitive, fmt::format("TEXCOORD_{}", surface.texture_set), 2, 2)),
        indexed_(primitive.indices >= 0) {
    for (const auto* it : {&normals_, &colours_, &coordinates_}) {
      if (*it && (*it)->size() < positions_.size())
        throw GltfError("a mesh has fewer normals, colours or texture coordinates than vertices");
    }
    if (positions_.size() > std::numeric_limits<std::uint32_t>::max())
      throw GltfError("a mesh has more vertices than can be numbered");
    triangles_ = triangles_of(corners_of(model, primitive, positions_.size()), primitive.mode);
  }

  /// Approximate memory that making the shape takes, bytes.
  std::uint64_t bytes() const {
    const bool has_normals = normals_ || !surface_.smooth;
    const std::uint64_t of_corner = (has_normals ? sizeof(Vector3) : 0) +
                                    (coordinates_ ? sizeof(Vector2) : 0) +
                                    (colours_ ? sizeof(world::Colour) : 0);
    const std::uint64_t vertices = std::min<std::uint64_t>(positions_.size(), 3 * triangles_.size());
    return vertices * sizeof(Vector3) + triangles_.size() * (sizeof(Triangle) + 3 * of_corner);
  }

  world::MeshGeometry run() {
    world::MeshGeometry shape(mesh());
    const std::size_t count = triangles_.size();
    if (coordinates_) shape.texture_coordinates.resize(count);
    if (normals_) shape.normals.resize(count);
    if (colours_) shape.colours.resize(count);
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = triangles_[t][i];
        if (coordinates_) shape.texture_coordinates[t][i] = coordinate(vertex);
        if (normals_) shape.normals[t][i] = normal(vertex);
        if (colours_) shape.colours[t][i] = colour(vertex);
      }
    }
    if (!normals_ && !surface_.smooth) add_flat_normals(shape);
    if (coordinates_ || normals_ || colours_ || !indexed_) {
      geometry::weld_equal(shape.mesh);
      drop_unused(shape.mesh);
    }
    return shape;
  }

 private:
  static int position_accessor(const tinygltf::Primitive& primitive) {
    return primitive.attributes.at("POSITION");
  }

  /// The mesh of the used vertices, in the order of the file.
  geometry::TriangleMesh mesh() const {
    geometry::TriangleMesh mesh;
    mesh.triangles = triangles_;
    const std::vector<std::uint32_t> used = used_vertices();
    mesh.positions.reserve(used.size());
    for (const std::uint32_t vertex : used) mesh.positions.push_back(position(vertex));
    if (used.size() == positions_.size()) return mesh;
    for (Triangle& triangle : mesh.triangles) {
      for (std::uint32_t& corner : triangle)
        corner = std::uint32_t(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    }
    return mesh;
  }

  std::vector<std::uint32_t> used_vertices() const {
    std::vector<std::uint32_t> used;
    if (positions_.size() / 8 < triangles_.size()) {
      std::vector<bool> is_used(positions_.size(), false);
      for (const Triangle& triangle : triangles_) {
        for (const std::uint32_t corner : triangle) is_used[corner] = true;
      }
      for (std::uint32_t v = 0; v < is_used.size(); ++v) {
        if (is_used[v]) used.push_back(v);
      }
      return used;
    }
    for (const Triangle& triangle : triangles_) used.insert(used.end(), triangle.begin(), triangle.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  /// The decimal number as written: 0.1 where the file holds the float nearest to it.
  double exact(const GltfAccessor& accessor, std::uint32_t vertex, std::size_t component) const {
    const double number = accessor.number(vertex, component);
    return accessor.is_float() ? io::from_short_single(float(number)) : number;
  }
  Vector3 position(std::uint32_t v) const {
    return {exact(positions_, v, 0), exact(positions_, v, 1), exact(positions_, v, 2)};
  }
  /// Texture coordinates of a world; glTF counts down from a picture's top.
  Vector2 coordinate(std::uint32_t v) const {
    return {exact(*coordinates_, v, 0), 1.0 - exact(*coordinates_, v, 1)};
  }
  Vector3 normal(std::uint32_t v) const {
    const Vector3 given(normals_->number(v, 0), normals_->number(v, 1), normals_->number(v, 2));
    return unit_as_given(given);
  }
  world::Colour colour(std::uint32_t v) const {
    GltfColour colour;
    for (std::size_t i = 0; i < 3; ++i) colour[i] = colours_->number(v, i) * surface_.colour[i];
    return base::srgb_from_linear(colour);
  }

  static void add_flat_normals(world::MeshGeometry& shape) {
    shape.normals.reserve(shape.mesh.triangles.size());
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
      const Vector3& a = shape.mesh.corner(t, 0);
      const Vector3 across = (shape.mesh.corner(t, 1) - a).cross(shape.mesh.corner(t, 2) - a);
      const Vector3 normal = across.stableNormalized();
      shape.normals.push_back({normal, normal, normal});
    }
  }

  const GltfSurface& surface_;
  GltfAccessor positions_;
  std::optional<GltfAccessor> normals_, colours_, coordinates_;
  bool indexed_;
  std::vector<Triangle> triangles_;
};

}  // namespace

const char* colours_name(const tinygltf::Primitive& primitive) {
  return primitive.attributes.contains(kGltfHiddenColours) ? kGltfHiddenColours : "COLOR_0";
}

bool has_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN &&
         primitive.attributes.count("POSITION") > 0;
}

std::shared_ptr<world::MeshGeometry> gltf_mesh(const tinygltf::Model& model,
                                               const tinygltf::Primitive& primitive,
                                               const GltfSurface& surface, io::MemoryBudget& memory,
                                               std::string& lost) {
  PrimitiveReading reading(model, primitive, surface);
  if (!memory.has_room(reading.bytes())) throw GltfError(memory.problem().message);
  world::MeshGeometry shape = reading.run();
  lost = drop_not_finite(shape);
  return std::make_shared<world::MeshGeometry>(std::move(shape));
}

}  // namespace icome::files
