#pragma once
#include <cstddef>

#include "render/camera.h"
#include "render/gl_objects.h"
#include "render/shading_mesh.h"

namespace icome::render {

/// A mesh on the graphics card. Owns its buffers there; the context that made it must outlive it.
class MeshView {
 public:
  explicit MeshView(const ShadingMesh& mesh);

  /// From the buffers' frame to the mesh's own (metres): a scale and a shift.
  const Matrix4& mesh_from_buffer() const { return mesh_from_buffer_; }

  /// Issues the triangles with the program in use; inputs 0 and 1 are position and normal.
  void draw() const;

 private:
  GlObject arrays_, vertices_, indices_;
  std::size_t index_count_;
  Matrix4 mesh_from_buffer_;
};

}  // namespace icome::render
