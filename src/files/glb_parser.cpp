#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <utility>
#include <vector>

#include "files/mesh_formats.h"

namespace icome::files {
namespace {

/// The nodes of a small file may show one mesh again and again: this bounds what they can ask for.
constexpr std::size_t kMaximumTriangles = 100'000'000;

/// A node of the scene still to be visited, and its parent's transform (row-major).
struct Visit {
  const aiNode* node;
  aiMatrix4x4 scene_from_parent;
};

geometry::Vector3 to_vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Adds one mesh of the scene; false when a face refers to a vertex that the mesh does not have.
bool add_mesh(const aiMesh& part, const aiMatrix4x4& scene_from_mesh, geometry::TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v)
    mesh.positions.push_back(to_vector(scene_from_mesh * part.mVertices[v]));
  const bool mirrored = scene_from_mesh.Determinant() < 0.0F;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    geometry::TriangleMesh::Triangle triangle{};
    for (int i = 0; i < 3; ++i) {
      if (face.mIndices[i] >= part.mNumVertices) return false;
      triangle[i] = first + face.mIndices[i];
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return true;
}

base::Result<geometry::TriangleMesh> gather(const aiScene& scene, const std::string& name) {
  geometry::TriangleMesh mesh;
  std::vector<Visit> open{{scene.mRootNode, aiMatrix4x4()}};
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    const aiMatrix4x4 scene_from_node = visit.scene_from_parent * visit.node->mTransformation;
    for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
      const aiMesh& part = *scene.mMeshes[visit.node->mMeshes[i]];
      if (mesh.triangles.size() + part.mNumFaces > kMaximumTriangles ||
          mesh.positions.size() + part.mNumVertices > 3 * kMaximumTriangles)
        return base::fail(fmt::format("{}: its nodes ask for more than {} million triangles", name,
                                      kMaximumTriangles / 1'000'000));
      if (!add_mesh(part, scene_from_node, mesh))
        return base::fail(name + ": a face refers to a vertex that is not there");
    }
    for (unsigned i = 0; i < visit.node->mNumChildren; ++i)
      open.push_back({visit.node->mChildren[i], scene_from_node});
  }
  return mesh;
}

}  // namespace

base::Result<ParsedMesh> parse_glb(std::string_view bytes, const std::string& name) try {
  if (!bytes.starts_with("glTF"))
    return base::fail(name + ": does not begin with 'glTF', so it is not a GLB file");
  Assimp::Importer importer;
  // Serves these bytes and nothing else, so that no other file is opened whatever the scene refers to.
  // The importer owns the handler and deletes it.
  importer.SetIOHandler(
      new Assimp::MemoryIOSystem(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), nullptr));
  const aiScene* scene = importer.ReadFile(AI_MEMORYIO_MAGIC_FILENAME ".glb", 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    return base::fail(fmt::format("{}: is not a readable GLB file: {}", name, importer.GetErrorString()));
  base::Result<geometry::TriangleMesh> mesh = gather(*scene, name);
  if (!mesh) return tl::unexpected(mesh.error());
  return ParsedMesh{std::move(*mesh), "GLB", {}};
} catch (const std::exception& problem) {
  return base::fail(fmt::format("{}: is not a readable GLB file: {}", name, problem.what()));
}

}  // namespace icome::files
