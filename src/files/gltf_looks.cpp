#include "files/gltf_looks.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "files/gltf_accessor.h"
#include "files/gltf_model.h"
#include "files/gltf_value.h"
#include "files/picture_bytes.h"

namespace icome::files {
namespace {

using base::srgb_from_linear;

/// Linear, as all colours of glTF.
GltfColour colour_of(const std::vector<double>& numbers) {
  if (numbers.size() < 3) return {};
  return {numbers[0], numbers[1], numbers[2]};
}

/// The exponent of VRML 2.0's highlights that looks most like a microfacet surface of this roughness.
float shininess_of(double roughness) {
  const double alpha = std::clamp(roughness, 0.0, 1.0) * std::clamp(roughness, 0.0, 1.0);
  if (alpha * alpha <= 2.0 / 130.0) return 1.0F;
  return part_of_one((2.0 / (alpha * alpha) - 2.0) / 128.0);
}

/// What shines is the metal's own colour, else a twenty-fifth of the light.
GltfColour specular_of(const GltfColour& base, double metallic) {
  constexpr double kDielectric = 0.04;
  const double metal = std::clamp(metallic, 0.0, 1.0);
  GltfColour specular{};
  for (std::size_t i = 0; i < 3; ++i) specular[i] = kDielectric + (base[i] - kDielectric) * metal;
  return specular;
}

/// The transform of KHR_texture_transform: scaled, turned, moved.
std::array<double, 6> texture_frame(const tinygltf::Value& transform) {
  const auto pair = [&](const char* name, double otherwise) {
    const tinygltf::Value& array = member(transform, name);
    std::array<double, 2> result{otherwise, otherwise};
    for (std::size_t i = 0; i < 2 && array.ArrayLen() == 2; ++i) {
      if (array.Get(int(i)).IsNumber()) result[i] = array.Get(int(i)).GetNumberAsDouble();
    }
    return result;
  };
  const auto [x, y] = pair("offset", 0.0);
  const auto [sx, sy] = pair("scale", 1.0);
  const double turn = number_in(transform, "rotation").value_or(0.0);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return {c * sx, s * sy, x, -s * sx, c * sy, y};
}

}  // namespace

GltfLooks::GltfLooks(const tinygltf::Model& model, DesignBuilder& builder)
    : model_(model), builder_(builder), textures_(model.textures.size()) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) read(int(i));
  for (std::size_t i = 0; i < model.textures.size(); ++i) texture(int(i));
  if (maps_left_out_)
    builder_.remark(
        "Maps of normals, roughness, occlusion and emission are left out: only colours are kept.");
}

world::MaterialId GltfLooks::material(int index) const {
  if (index < 0) return {};
  if (std::size_t(index) >= materials_.size())
    throw GltfError("a mesh refers to a material that is not there");
  return materials_[std::size_t(index)];
}

GltfSurface GltfLooks::surface(int material) const {
  return material < 0 ? GltfSurface{} : surfaces_[checked(material)];
}

std::size_t GltfLooks::checked(int material) const {
  if (std::size_t(material) >= materials_.size())
    throw GltfError("a mesh refers to a material that is not there");
  return std::size_t(material);
}

void GltfLooks::read(int index) {
  const tinygltf::Material& it = model_.materials[std::size_t(index)];
  const auto& pbr = it.pbrMetallicRoughness;
  const tinygltf::Value& extras = icome_extras(it.extras);
  world::Material material;
  material.name = it.name;
  const GltfColour base = colour_of(pbr.baseColorFactor);
  material.diffuse = srgb_from_linear(base);
  material.transparency = it.alphaMode == "BLEND" && pbr.baseColorFactor.size() == 4
                              ? part_of_one(1.0 - pbr.baseColorFactor[3])
                              : 0;
  material.emission = srgb_from_linear(colour_of(it.emissiveFactor));
  material.specular = srgb_from_linear(specular_of(base, pbr.metallicFactor));
  material.shininess = shininess_of(pbr.roughnessFactor);
  if (it.extensions.count("KHR_materials_unlit") > 0) material.emission = material.diffuse;
  GltfSurface surface;
  surface.colour = base;
  if (pbr.baseColorTexture.index >= 0) {
    material.texture = texture(pbr.baseColorTexture.index);
    surface.texture_set = pbr.baseColorTexture.texCoord;
    const auto transform = pbr.baseColorTexture.extensions.find("KHR_texture_transform");
    const bool moved = transform != pbr.baseColorTexture.extensions.end();
    surface.texture_frame = texture_frame(moved ? transform->second : tinygltf::Value());
    if (moved) {
      const auto set = index_in(transform->second, "texCoord", 64);
      surface.texture_set = set.value_or(surface.texture_set);
    }
  }
  maps_left_out_ = maps_left_out_ || it.normalTexture.index >= 0 || it.occlusionTexture.index >= 0 ||
                   it.emissiveTexture.index >= 0 || pbr.metallicRoughnessTexture.index >= 0;
  complete(material, extras);
  surfaces_.push_back(surface);
  // Written for meshes with colours of their own, which glTF multiplies with those of the material.
  const auto same = index_in(extras, "variantOf", std::size_t(index));
  materials_.push_back(same ? materials_[std::size_t(*same)] : builder_.add(std::move(material)));
}

world::TextureId GltfLooks::texture(int index) {
  if (index < 0 || std::size_t(index) >= textures_.size())
    throw GltfError("a material refers to a texture that is not there");
  ReadTexture& known = textures_[std::size_t(index)];
  if (known.read || builder_.has_failed()) return known.id;
  known.read = true;
  const tinygltf::Texture& it = model_.textures[std::size_t(index)];
  if (it.source < 0 || std::size_t(it.source) >= model_.images.size()) {
    builder_.remark(
        fmt::format("Texture {} is left out: its picture is of a kind that is not known.", index));
    return {};
  }
  const tinygltf::Image& image = model_.images[std::size_t(it.source)];
  const std::string bytes = image.bufferView >= 0 ? std::string(view_bytes(model_, image.bufferView))
                                                  : std::string(image.image.begin(), image.image.end());
  world::Texture texture;
  texture.media_type = std::string(picture_type(bytes));
  // What the file itself holds cannot be somebody else's.
  if (texture.media_type.empty() && image.bufferView >= 0 && !bytes.empty())
    texture.media_type = image.mimeType.substr(0, 64);
  texture.name = !image.name.empty() ? image.name : image.uri.substr(0, 256);
  if (texture.media_type.empty()) {
    builder_.remark(fmt::format("Picture {}{} is left out: {}.", it.source,
                                texture.name.empty() ? "" : fmt::format(" (\"{}\")", texture.name),
                                bytes.empty() ? "it is not there" : "it is no picture"));
    return {};
  }
  texture.bytes = std::make_shared<const std::string>(bytes);
  if (it.sampler >= 0 && std::size_t(it.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& sampler = model_.samplers[std::size_t(it.sampler)];
    texture.repeats = {sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE,
                       sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE};
  }
  known.id = builder_.add(std::move(texture));
  return known.id;
}

}  // namespace icome::files
