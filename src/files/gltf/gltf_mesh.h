#pragma once
#include <array>
#include <memory>
#include <string>

#include "io/memory_budget.h"
#include "world/shape/mesh_geometry.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace icome::files {

using GltfColour = std::array<double, 3>;  // linear, in [0, 1]

/// Custom attributes of ICOME: colours of vertices that the material's picture replaces, and texture
/// coordinates without the frame of the material, where glTF cannot express the frame.
inline constexpr const char* kGltfHiddenColours = "_ICOME_COLOR_0";
inline constexpr const char* kGltfOwnPlaces = "TEXCOORD_1";

/// The properties of a mesh that its material decides.
struct GltfSurface {
  int texture_set = 0;                  // index of the texture coordinates
  bool own_places = false;              // the index is that of kGltfOwnPlaces
  GltfColour colour = {1.0, 1.0, 1.0};  // factor of the corner colours
  bool smooth = false;                  // its normals are those of a mesh without any

  bool operator==(const GltfSurface&) const = default;
};

/// The triangles of a primitive, whose mode is triangles, a strip or a fan. Vertices that differ only in
/// attributes of corners become one. Throws GltfError, also where that would take more memory than there is
/// left. `lost`: a sentence, if anything was left out.
std::shared_ptr<world::MeshGeometry> gltf_mesh(const tinygltf::Model& model,
                                               const tinygltf::Primitive& primitive,
                                               const GltfSurface& surface, io::MemoryBudget& memory,
                                               std::string& lost);

/// The name of the attribute that holds the primitive's colours, whether it exists or not.
const char* colours_name(const tinygltf::Primitive& primitive);

/// Are its elements triangles?
bool has_triangles(const tinygltf::Primitive& primitive);

}  // namespace icome::files
