#include "files/gltf/gltf_vertices.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "base/srgb.h"

namespace icome::files {
namespace {

using base::Vector3;

template <std::size_t Size, typename Vector>
std::array<float, Size> floats_of(const Vector& vector) {
  std::array<float, Size> floats;
  // Adding zero drops the sign of negative zeros, so that equal vertices are found to be equal.
  for (std::size_t i = 0; i < Size; ++i) floats[i] = float(vector[Eigen::Index(i)]) + 0.0F;
  return floats;
}

Vector3 facing_of(const geometry::TriangleMesh& mesh, std::size_t t) {
  const Vector3& a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).stableNormalized();
}

/// Are the normals those that glTF's readers make for a mesh that has none?
bool all_flat(const world::MeshGeometry& shape) {
  constexpr double kRounding = 1e-6;  // of unit vectors
  for (std::size_t t = 0; t < shape.normals.size(); ++t) {
    const Vector3 normal = facing_of(shape.mesh, t);
    if (normal.isZero(0.0)) continue;
    for (const Vector3& given : shape.normals[t]) {
      if ((given - normal).squaredNorm() > kRounding * kRounding) return false;
    }
  }
  return true;
}

/// All that distinguishes a vertex of glTF.
struct Corner {
  std::uint32_t position = 0;
  std::array<float, 8> rest = {};  // normal, texture coordinates, colour

  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t state = corner.position;
    for (const float number : corner.rest)
      state = (state ^ std::bit_cast<std::uint32_t>(number)) * 0x9e3779b97f4a7c15ULL;
    return state ^ (state >> 32);
  }
};

/// Gives each different corner a vertex.
class Splitting {
 public:
  explicit Splitting(const world::MeshGeometry& shape, bool with_normals)
      : shape_(shape), with_normals_(with_normals) {
    const std::size_t vertices = shape.mesh.positions.size();
    result_.positions.reserve(vertices);
    known_.reserve(vertices);
    result_.corners.reserve(3 * shape.mesh.triangles.size());
  }

  GltfVertices run() {
    for (std::size_t t = 0; t < shape_.mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) result_.corners.push_back(vertex_of(t, i));
    }
    return std::move(result_);
  }

 private:
  std::uint32_t vertex_of(std::size_t t, std::size_t i) {
    Normal normal{};
    Coordinates coordinates{};
    Colour colour{};
    if (with_normals_) normal = floats_of<3>(shape_.normals[t][i]);
    if (!shape_.texture_coordinates.empty()) {
      // glTF counts down from a picture's top.
      const base::Vector2& given = shape_.texture_coordinates[t][i];
      coordinates = floats_of<2>(base::Vector2(given.x(), 1.0 - given.y()));
    }
    if (!shape_.colours.empty()) colour = base::linear_from_srgb(shape_.colours[t][i]);
    const Corner corner{
        shape_.mesh.triangles[t][i],
        {normal[0], normal[1], normal[2], coordinates[0], coordinates[1], colour[0], colour[1], colour[2]}};
    const auto [found, is_new] = known_.try_emplace(corner, std::uint32_t(result_.positions.size()));
    if (is_new) {
      result_.positions.push_back(floats_of<3>(shape_.mesh.positions[corner.position]));
      if (with_normals_) result_.normals.push_back(normal);
      if (!shape_.texture_coordinates.empty()) result_.coordinates.push_back(coordinates);
      if (!shape_.colours.empty()) result_.colours.push_back(colour);
    }
    return found->second;
  }

  using Normal = std::array<float, 3>;
  using Coordinates = std::array<float, 2>;
  using Colour = std::array<float, 3>;

  const world::MeshGeometry& shape_;
  bool with_normals_;
  GltfVertices result_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> known_;
};

/// The vertices unchanged; no corner has data of its own.
GltfVertices as_they_are(const geometry::TriangleMesh& mesh) {
  GltfVertices result;
  result.positions.reserve(mesh.positions.size());
  for (const Vector3& position : mesh.positions) result.positions.push_back(floats_of<3>(position));
  result.corners.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    result.corners.insert(result.corners.end(), triangle.begin(), triangle.end());
  return result;
}

/// Normals of the mesh as written, in single precision: after reading it back they are the same.
std::vector<Vector3> smooth_normals(const geometry::TriangleMesh& mesh) {
  geometry::TriangleMesh written = mesh;
  for (Vector3& position : written.positions) position = position.cast<float>().cast<double>();
  return geometry::vertex_normals(written);
}

/// Adds the normals of a mesh whose normals follow from its triangles.
void add_smooth_normals(const geometry::TriangleMesh& mesh, GltfVertices& result) {
  result.smooth = true;
  for (const Vector3& normal : smooth_normals(mesh)) {
    // A vertex without triangles has no normal, but glTF requires one.
    result.normals.push_back(normal.isZero(0.0) ? std::array<float, 3>{0.0F, 0.0F, 1.0F}
                                                : floats_of<3>(normal));
  }
}

}  // namespace

GltfVertices gltf_vertices(const world::MeshGeometry& shape) {
  const bool plain = shape.texture_coordinates.empty() && shape.colours.empty();
  if (shape.normals.empty()) {
    if (plain) {
      GltfVertices result = as_they_are(shape.mesh);
      add_smooth_normals(shape.mesh, result);
      return result;
    }
    // Normals of vertices that will be split: each part keeps that of the whole.
    world::MeshGeometry with_normals = shape;
    const std::vector<Vector3> normals = smooth_normals(shape.mesh);
    for (const auto& [a, b, c] : shape.mesh.triangles)
      with_normals.normals.push_back({normals[a], normals[b], normals[c]});
    GltfVertices result = Splitting(with_normals, true).run();
    result.smooth = true;
    return result;
  }
  const bool flat = all_flat(shape);
  if (flat && plain) return as_they_are(shape.mesh);
  return Splitting(shape, !flat).run();
}

}  // namespace icome::files
