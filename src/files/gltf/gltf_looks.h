#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/design_builder.h"
#include "files/gltf/gltf_mesh.h"

namespace tinygltf {
struct Material;
}  // namespace tinygltf

namespace icome::files {

/// The exponent of VRML 2.0's highlights that looks most like a microfacet surface of this roughness, and
/// back.
float shininess_of(double roughness);
double roughness_of(float shininess);

/// Converts a frame for texture coordinates that count down from a picture's top, as in glTF, to one for
/// those that count up, as in a world, and back.
world::PictureFrame upside_down(const world::PictureFrame& frame);

/// The materials and pictures of a glTF file, put into the design that is being read.
class GltfLooks {
 public:
  using GoOn = std::function<void()>;

  /// Throws GltfError, and whatever `go_on` throws, which is called before each picture that is unpacked.
  /// `memory` is the one of the builder.
  GltfLooks(const tinygltf::Model& model, DesignBuilder& builder, io::MemoryBudget& memory, GoOn go_on);

  /// The material of a primitive; none where it names none.
  world::MaterialId material(int index) const;
  /// The properties of the primitive's mesh that the material decides.
  GltfSurface surface(int material) const;

 private:
  std::size_t checked(int material) const;
  void read(int index);
  void read_picture(const tinygltf::Material& from, GltfSurface& surface, world::Material& material);
  void read_alpha(const tinygltf::Material& from, world::Material& material) const;
  using Mean = std::optional<std::array<double, 3>>;
  /// Metal and roughness; of a map its means.
  std::pair<double, double> metal_and_roughness(const tinygltf::Material& from);
  /// picture_mean of a texture.
  Mean mean_of(int index);
  /// picture_mean of a new picture; none also where unpacking it would exceed a limit.
  Mean new_mean(std::string_view bytes);
  void count_maps(const tinygltf::Material& from);
  void tell_what_is_left_out();
  world::TextureId texture(int index);

  const tinygltf::Model& model_;
  DesignBuilder& builder_;
  io::MemoryBudget& memory_;
  GoOn go_on_;
  std::vector<world::MaterialId> materials_;
  std::vector<GltfSurface> surfaces_;
  struct ReadTexture {
    bool read = false;
    world::TextureId id = {};  // none: it could not be read
  };
  std::vector<ReadTexture> textures_;
  struct LeftOut {
    std::size_t normals = 0, roughness = 0, occlusion = 0, emission = 0;  // materials with such maps
    std::size_t mirrored = 0, unsmoothed = 0;                             // textures
  } left_out_;
  std::size_t averaged_maps_ = 0;
  std::size_t heavy_maps_ = 0;         // too large to be unpacked with the others
  std::uint64_t unpacked_pixels_ = 0;  // of all maps
  /// By the bytes of pictures, which the world holds: many images may share one, which unpacks to much.
  std::map<std::string_view, Mean> means_;
};

}  // namespace icome::files
