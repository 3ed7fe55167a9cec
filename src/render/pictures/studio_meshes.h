#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "render/model/camera.h"
#include "render/model/shading_mesh.h"
#include "render/pictures/studio.h"

namespace icome::render {

/// A mesh as a studio draws it. Owns its arrays.
struct StudioMesh {
  ShadingMesh seen;
  std::optional<ShadingMesh> caster;  ///< a coarser one that throws the shadows, for large meshes
};

/// A mesh at its place in the world. Items may share a mesh.
struct StudioItem {
  std::size_t mesh;  ///< of StudioMeshes
  base::Pose world_from_mesh;
  charts::Colour colour;
};

/// The bodies of a picture as they are drawn: bodies that are seen small have few triangles, and bodies of
/// few triangles and one colour are one mesh, so that a picture of ten thousand bodies costs little more
/// than one of ten.
struct StudioMeshes {
  std::vector<StudioMesh> meshes;
  std::vector<StudioItem> items;
  std::size_t triangles = 0;  ///< of all items
};

/// `height`: of the picture, pixels. `crease_angle`: see StudioSettings.
StudioMeshes make_studio_meshes(const std::vector<StudioBody>& bodies, const Camera& camera, double height,
                                double crease_angle);

}  // namespace icome::render
