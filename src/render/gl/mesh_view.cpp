#include "render/gl/mesh_view.h"

#include <epoxy/gl.h>

namespace icome::render {
namespace {

template <typename Range>
void upload(GLenum target, const GlObject& buffer, const Range& data) {
  using T = typename Range::value_type;
  glBindBuffer(target, buffer.name());
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
}

void vertex_input(GLuint index, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(ShadingMesh::Vertex),
                        reinterpret_cast<const void*>(offset));
}

/// A further input of its own, if there is any data for it.
template <typename T>
GlObject added_input(GLuint index, std::span<const T> data) {
  if (data.empty()) return {};
  GlObject buffer(GlObject::Kind::Buffer);
  upload(GL_ARRAY_BUFFER, buffer, data);
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, T::RowsAtCompileTime, GL_FLOAT, GL_FALSE, sizeof(T), nullptr);
  return buffer;
}

}  // namespace

MeshView::MeshView(const ShadingMesh& mesh) : MeshView(mesh, {}, {}) {}

MeshView::MeshView(const ShadingMesh& mesh, std::span<const Eigen::Vector2f> picture_places,
                   std::span<const Eigen::Vector3f> colours)
    : arrays_(GlObject::Kind::VertexArray),
      vertices_(GlObject::Kind::Buffer),
      indices_(GlObject::Kind::Buffer),
      index_count_(mesh.indices.size()),
      mesh_from_buffer_(Matrix4::Identity()) {
  mesh_from_buffer_.topLeftCorner<3, 3>() *= mesh.radius;
  mesh_from_buffer_.topRightCorner<3, 1>() = mesh.centre;
  glBindVertexArray(arrays_.name());
  upload(GL_ARRAY_BUFFER, vertices_, mesh.vertices);
  upload(GL_ELEMENT_ARRAY_BUFFER, indices_, mesh.indices);
  vertex_input(0, offsetof(ShadingMesh::Vertex, position));
  vertex_input(1, offsetof(ShadingMesh::Vertex, normal));
  places_ = added_input(2, picture_places);
  colours_ = added_input(3, colours);
  glBindVertexArray(0);
}

void MeshView::draw() const {
  glBindVertexArray(arrays_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(index_count_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace icome::render
