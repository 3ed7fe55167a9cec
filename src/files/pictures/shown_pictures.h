#pragma once
#include <memory>
#include <string>

#include "world/shape/mesh_geometry.h"
#include "world/world.h"

namespace icome::files {

/// The look of a material in formats that multiply its colour and opacity with its picture's.
struct ShownMaterial {
  world::Colour colour = {};                         // as displays show it
  float opacity = 1.0F;                              // in [0, 1]
  world::AlphaMode mode = world::AlphaMode::Opaque;  // never ByPicture
  float cutoff = 0.5F;                               // of AlphaMode::Mask
};
ShownMaterial shown_material(const world::World& world, const world::Material& material);

/// Do the colours of its picture replace those of the material and of meshes, wherever the picture is
/// seen? Judged by the picture's header alone.
bool hides_colours(const world::World& world, const world::Material& material);

/// The specular colour for formats without metal: the mean highlight of metal under a picture.
world::Colour shown_specular(const world::World& world, const world::Material& material);

/// The triangles of a shape with texture coordinates, which follow from the kind of a primitive: `mesh`
/// itself for shapes of other kinds.
std::shared_ptr<const world::MeshGeometry> with_picture_places(
    const world::Geometry& shape, std::shared_ptr<const world::MeshGeometry> mesh);

/// (u, v) transformed by the frame.
world::Vector2 laid(const world::PictureFrame& frame, const world::Vector2& place);

}  // namespace icome::files
