#pragma once
#include <cstddef>
#include <span>

#include "render/gl/gl_objects.h"
#include "render/model/camera.h"
#include "render/model/shading_mesh.h"

namespace icome::render {

/// A mesh on the graphics card. Owns its buffers there; the context that made it must outlive it.
class MeshView {
 public:
  explicit MeshView(const ShadingMesh& mesh);
  /// With more inputs for each vertex, if any: its place in a picture (input 2) and its colour (input 3).
  MeshView(const ShadingMesh& mesh, std::span<const Eigen::Vector2f> picture_places,
           std::span<const Eigen::Vector3f> colours);

  /// Transform from the buffers' frame to the mesh's own (metres): a scale and a shift.
  const Matrix4& mesh_from_buffer() const { return mesh_from_buffer_; }

  /// Issues the triangles with the program in use; inputs 0 and 1 are position and normal.
  void draw() const;

 private:
  GlObject arrays_, vertices_, indices_;
  GlObject places_, colours_;  // none where vertices have none
  std::size_t index_count_;
  Matrix4 mesh_from_buffer_;
};

}  // namespace icome::render
