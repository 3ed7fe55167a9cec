#include "apps/touch/touch_eye.h"

#include <utility>

namespace icome::apps {

TouchEye::TouchEye(const std::shared_ptr<const haptics::MeshShape>& felt)
    : mesh_(felt, &felt->mesh()), tree_(felt, &felt->tree()) {}

const TouchEye::Mesh& TouchEye::mesh() {
  if (!mesh_) mesh_ = std::make_shared<const geometry::TriangleMesh>(std::exchange(make_, nullptr)());
  return mesh_;
}

const geometry::TriangleTree& TouchEye::tree() {
  if (!tree_) tree_ = std::make_shared<const geometry::TriangleTree>(*mesh());
  return *tree_;
}

std::shared_ptr<TouchEye> eye_of(const geometry::Primitive& primitive) {
  constexpr double kOff = 0.0005;  // of the size
  return std::make_shared<TouchEye>([primitive] {
    const base::Bounds box = geometry::bounds(primitive);
    const double size = box.sizes().allFinite() ? box.sizes().maxCoeff() : 1.0;
    return geometry::tessellate(primitive, kOff * size);
  });
}

}  // namespace icome::apps
