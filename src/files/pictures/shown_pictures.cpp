#include "files/pictures/shown_pictures.h"

#include "base/srgb.h"
#include "files/pictures/picture_bytes.h"
#include "world/metal.h"
#include "world/shape/picture_kind.h"
#include "world/shape/picture_places.h"

namespace icome::files {
namespace {

/// The colour that multiplies the picture's colour, if there is one.
world::Colour shown_colour(const world::World& world, const world::Material& material) {
  return hides_colours(world, material) ? world::Colour{1.0F, 1.0F, 1.0F} : material.diffuse;
}

}  // namespace

bool hides_colours(const world::World& world, const world::Material& material) {
  const world::Texture* const texture = world.find(material.texture);
  // VRML 2.0, 4.14: colours of pictures replace those of materials, greys are multiplied.
  return texture && !material.tints && !world::is_grey_picture(*texture->bytes);
}

ShownMaterial shown_material(const world::World& world, const world::Material& material) {
  using world::AlphaMode;
  using world::PictureOpacity;
  ShownMaterial it{.colour = shown_colour(world, material), .opacity = 1.0F - material.transparency};
  it.cutoff = material.alpha_cutoff;
  const world::Texture* const texture = world.find(material.texture);
  const PictureOpacity picture = texture ? picture_opacity(*texture->bytes) : PictureOpacity::Opaque;
  // VRML 2.0, 4.14: opacities of pictures replace those of materials.
  if (texture && !material.tints && picture != PictureOpacity::Opaque) it.opacity = 1.0F;
  if (material.alpha_mode != AlphaMode::ByPicture) {
    it.mode = material.alpha_mode;
  } else if (picture != PictureOpacity::Opaque) {
    it.mode = picture == PictureOpacity::CutOut ? AlphaMode::Mask : AlphaMode::Blend;
    it.cutoff = 0.5F;
  }
  if (it.opacity < 1.0F && it.mode == AlphaMode::Opaque) it.mode = AlphaMode::Blend;
  return it;
}

world::Colour shown_specular(const world::World& world, const world::Material& material) {
  const float metal = world::metal_of(material);
  const world::Texture* const texture = metal > 0.0F ? world.find(material.texture) : nullptr;
  const auto mean = texture ? picture_mean(*texture->bytes) : std::nullopt;
  if (!mean) return material.specular;
  const world::Colour factor = shown_colour(world, material);
  std::array<double, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i)
    colour[i] = base::linear_from_srgb((*mean)[i]) * base::linear_from_srgb(double(factor[i]));
  return base::srgb_from_linear(world::metal_specular(colour, double(metal)));
}

std::shared_ptr<const world::MeshGeometry> with_picture_places(
    const world::Geometry& shape, std::shared_ptr<const world::MeshGeometry> mesh) {
  const auto* const primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape);
  if (primitive == nullptr || !mesh || !mesh->texture_coordinates.empty()) return mesh;
  auto textured = std::make_shared<world::MeshGeometry>(*mesh);
  textured->texture_coordinates = world::picture_places(*primitive, mesh->mesh);
  return textured;
}

world::Vector2 laid(const world::PictureFrame& frame, const world::Vector2& place) {
  const auto& [a, b, c, d, e, f] = frame;
  return {a * place.x() + b * place.y() + c, d * place.x() + e * place.y() + f};
}

}  // namespace icome::files
