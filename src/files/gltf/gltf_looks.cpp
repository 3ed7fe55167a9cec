#include "files/gltf/gltf_looks.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/srgb.h"
#include "files/gltf/gltf_accessor.h"
#include "files/gltf/gltf_model.h"
#include "files/gltf/gltf_value.h"
#include "files/pictures/picture_bytes.h"
#include "world/metal.h"
#include "world/shape/picture_kind.h"

namespace icome::files {
namespace {

using base::srgb_from_linear;

/// Linear, as all colours of glTF.
GltfColour colour_of(const std::vector<double>& numbers) {
  if (numbers.size() < 3) return {};
  return {numbers[0], numbers[1], numbers[2]};
}

/// The transform of KHR_texture_transform: scales, turns, moves.
world::PictureFrame texture_frame(const tinygltf::Value& transform) {
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

/// The opacity of the picture from which on it is seen, where the picture's opacity is multiplied with
/// `opacity`; above 1 it is seen nowhere (glTF 2.0, 3.9.4).
float cutoff_of_picture(double cutoff, double opacity) {
  constexpr double kNowhere = 1e6;
  if (!(cutoff > 0.0)) return 0.0F;
  return float(std::min(cutoff / opacity, kNowhere));
}

}  // namespace

float shininess_of(double roughness) {
  const double alpha = std::clamp(roughness, 0.0, 1.0) * std::clamp(roughness, 0.0, 1.0);
  if (alpha * alpha <= 2.0 / 130.0) return 1.0F;
  return part_of_one((2.0 / (alpha * alpha) - 2.0) / 128.0);
}

double roughness_of(float shininess) { return std::pow(2.0 / (128.0 * double(shininess) + 2.0), 0.25); }

world::PictureFrame upside_down(const world::PictureFrame& frame) {
  const auto& [a, b, c, d, e, f] = frame;
  world::PictureFrame turned{a, -b, b + c, -d, e, 1.0 - e - f};
  for (double& number : turned) number += 0.0;  // no negative zeros
  return turned;
}

GltfLooks::GltfLooks(const tinygltf::Model& model, DesignBuilder& builder, io::MemoryBudget& memory,
                     GoOn go_on)
    : model_(model),
      builder_(builder),
      memory_(memory),
      go_on_(std::move(go_on)),
      textures_(model.textures.size()) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) read(int(i));
  for (std::size_t i = 0; i < model.textures.size(); ++i) texture(int(i));
  tell_what_is_left_out();
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
  GltfSurface surface;
  surface.colour = colour_of(pbr.baseColorFactor);
  material.diffuse = srgb_from_linear(surface.colour);
  // An emission map tells where the surface glows; without the map, all of it would.
  if (it.emissiveTexture.index < 0) material.emission = srgb_from_linear(colour_of(it.emissiveFactor));
  const auto [metal, rough] = metal_and_roughness(it);
  material.metallic = part_of_one(metal);
  material.roughness = part_of_one(rough);
  material.specular = srgb_from_linear(world::metal_specular(surface.colour, metal));
  material.shininess = shininess_of(rough);
  material.unlit = it.extensions.count("KHR_materials_unlit") > 0;
  material.double_sided = it.doubleSided;
  read_picture(it, surface, material);
  read_alpha(it, material);
  count_maps(it);
  complete(material, extras);
  // A variant, written for meshes with their own colours, which glTF multiplies with the material's.
  const auto same = index_in(extras, "variantOf", std::size_t(index));
  if (same && surfaces_[std::size_t(*same)].own_places) {
    surface.own_places = true;
    surface.texture_set = surfaces_[std::size_t(*same)].texture_set;
  }
  surfaces_.push_back(surface);
  materials_.push_back(same ? materials_[std::size_t(*same)] : builder_.add(std::move(material)));
}

std::pair<double, double> GltfLooks::metal_and_roughness(const tinygltf::Material& from) {
  const auto& pbr = from.pbrMetallicRoughness;
  const int map = pbr.metallicRoughnessTexture.index;
  const bool is_there = map >= 0 && std::size_t(map) < textures_.size();
  const auto mean = is_there ? mean_of(map) : std::nullopt;
  if (!mean) return {pbr.metallicFactor, pbr.roughnessFactor};
  ++averaged_maps_;
  return {pbr.metallicFactor * (*mean)[2], pbr.roughnessFactor * (*mean)[1]};
}

GltfLooks::Mean GltfLooks::mean_of(int index) {
  const world::Texture* const picture = builder_.world().find(texture(index));
  if (!picture) return {};
  const auto [found, is_new] = means_.try_emplace(*picture->bytes);
  if (is_new) found->second = new_mean(*picture->bytes);
  return found->second;
}

GltfLooks::Mean GltfLooks::new_mean(std::string_view bytes) {
  go_on_();
  constexpr std::uint64_t kMostPixels = 256'000'000;  // of all maps: some seconds
  const std::uint64_t pixels = pixel_count(bytes);
  const bool is_too_large = pixels > kMostPixels - unpacked_pixels_ || 4 * pixels > memory_.left();
  heavy_maps_ += is_too_large ? 1 : 0;
  if (is_too_large) return {};
  unpacked_pixels_ += pixels;
  memory_.take(4 * pixels);
  const Mean mean = picture_mean(bytes);
  memory_.give_back(4 * pixels);
  return mean;
}

void GltfLooks::read_picture(const tinygltf::Material& from, GltfSurface& surface,
                             world::Material& material) {
  const tinygltf::TextureInfo& info = from.pbrMetallicRoughness.baseColorTexture;
  if (info.index < 0) return;
  material.texture = texture(info.index);
  material.tints = bool(material.texture);
  surface.own_places = says_own_places(icome_extras(from.extras));
  surface.texture_set = surface.own_places ? 1 : info.texCoord;
  const auto transform = info.extensions.find("KHR_texture_transform");
  if (transform == info.extensions.end()) return;
  surface.texture_set = index_in(transform->second, "texCoord", 64).value_or(surface.texture_set);
  if (material.texture) material.picture_frame = upside_down(texture_frame(transform->second));
}

void GltfLooks::read_alpha(const tinygltf::Material& from, world::Material& material) const {
  using world::AlphaMode;
  const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
  const double opacity = factor.size() == 4 ? std::clamp(factor[3], 0.0, 1.0) : 1.0;
  const world::Texture* const texture = builder_.world().find(material.texture);
  const bool may_be_clear = texture && world::may_be_clear(*texture->bytes);
  if (from.alphaMode == "BLEND") {
    material.transparency = part_of_one(1.0 - opacity);
    if (may_be_clear || material.transparency == 0.0F) material.alpha_mode = AlphaMode::Blend;
  } else if (from.alphaMode == "MASK") {
    material.alpha_mode = AlphaMode::Mask;
    if (!may_be_clear) material.transparency = opacity < from.alphaCutoff ? 1.0F : 0.0F;
    material.alpha_cutoff = cutoff_of_picture(from.alphaCutoff, opacity);
  } else if (may_be_clear) {
    material.alpha_mode = AlphaMode::Opaque;
  }
}

void GltfLooks::count_maps(const tinygltf::Material& from) {
  left_out_.normals += from.normalTexture.index >= 0 ? 1 : 0;
  left_out_.roughness += from.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0 ? 1 : 0;
  left_out_.occlusion += from.occlusionTexture.index >= 0 ? 1 : 0;
  left_out_.emission += from.emissiveTexture.index >= 0 ? 1 : 0;
}

void GltfLooks::tell_what_is_left_out() {
  std::string maps;
  const auto add = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    maps +=
        fmt::format("{}of {} ({} material{})", maps.empty() ? "" : ", ", what, count, count == 1 ? "" : "s");
  };
  add(left_out_.normals, "normals");
  add(left_out_.roughness, "metal and roughness");
  add(left_out_.occlusion, "occlusion");
  add(left_out_.emission, "emission");
  if (!maps.empty()) builder_.remark(fmt::format("Only maps of colours are kept. Left out: those {}.", maps));
  if (averaged_maps_ > 0) builder_.remark("Of maps of metal and roughness the means count, all over.");
  if (heavy_maps_ > 0)
    builder_.remark(fmt::format("{} too large to be unpacked with the rest, so that not even {} counted.",
                                heavy_maps_ == 1
                                    ? "1 map of metal and roughness is"
                                    : fmt::format("{} maps of metal and roughness are", heavy_maps_),
                                heavy_maps_ == 1 ? "its mean is" : "their means are"));
  const auto tell = [&](std::size_t count, const char* one, const char* several, const char* what) {
    if (count > 0) builder_.remark(fmt::format("{} {} {}", count, count == 1 ? one : several, what));
  };
  tell(left_out_.mirrored, "texture is", "textures are", "repeated beyond the picture, not mirrored there.");
  tell(left_out_.unsmoothed, "texture is", "textures are", "smoothed between the picture's pixels.");
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
  // A picture in the file's own buffer cannot be foreign: its stated type counts.
  if (texture.media_type.empty() && image.bufferView >= 0 && !bytes.empty())
    texture.media_type = image.mimeType.substr(0, 64);
  texture.name = !image.name.empty() ? image.name : image.uri.substr(0, 256);
  if (texture.media_type.empty()) {
    builder_.remark(fmt::format("Picture {}{} is left out: {}.", it.source,
                                texture.name.empty() ? "" : fmt::format(" (\"{}\")", texture.name),
                                bytes.empty() ? "nothing of it was read" : "it is no picture"));
    return {};
  }
  texture.bytes = std::make_shared<const std::string>(bytes);
  if (it.sampler >= 0 && std::size_t(it.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& sampler = model_.samplers[std::size_t(it.sampler)];
    texture.repeats = {sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE,
                       sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE};
    const bool mirrored = sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ||
                          sampler.wrapT == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    left_out_.mirrored += mirrored ? 1 : 0;
    left_out_.unsmoothed += sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? 1 : 0;
  }
  known.id = builder_.add(std::move(texture));
  return known.id;
}

}  // namespace icome::files
