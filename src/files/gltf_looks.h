#pragma once
#include <string>
#include <vector>

#include "files/design_builder.h"
#include "files/gltf_mesh.h"

namespace icome::files {

/// The materials and pictures of a glTF file, put into the design that is being read.
class GltfLooks {
 public:
  /// Throws GltfError.
  GltfLooks(const tinygltf::Model& model, DesignBuilder& builder);

  /// Of a primitive; none where it names none.
  world::MaterialId material(int index) const;
  /// What it says about the primitive's mesh.
  GltfSurface surface(int material) const;

 private:
  std::size_t checked(int material) const;
  void read(int index);
  world::TextureId texture(int index);

  const tinygltf::Model& model_;
  DesignBuilder& builder_;
  std::vector<world::MaterialId> materials_;
  std::vector<GltfSurface> surfaces_;
  struct ReadTexture {
    bool read = false;
    world::TextureId id = {};  // none: it could not be read
  };
  std::vector<ReadTexture> textures_;
  bool maps_left_out_ = false;
};

}  // namespace icome::files
