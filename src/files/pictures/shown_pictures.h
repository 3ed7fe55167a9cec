#pragma once
#include <memory>
#include <string>

#include "world/shape/mesh_geometry.h"
#include "world/world.h"

namespace icome::files {

/// What a material shows in formats that multiply its colour with its picture's, and its opacity likewise.
struct ShownMaterial {
  world::Colour colour = {};                         // as displays show it
  float opacity = 1.0F;                              // in [0, 1]
  world::AlphaMode mode = world::AlphaMode::Opaque;  // never ByPicture
  float cutoff = 0.5F;                               // of AlphaMode::Mask
};
ShownMaterial shown_material(const world::World& world, const world::Material& material);

/// Do the colours of its picture replace those of the material and of meshes, wherever it lies on them? By
/// the picture's header alone.
bool hides_colours(const world::World& world, const world::Material& material);

/// The specular colour for formats that know no metal: of metal beneath a picture, what shines on average.
world::Colour shown_specular(const world::World& world, const world::Material& material);

/// The triangles of a shape with where a picture lies on them, which primitives have by what they are: `mesh`
/// itself for shapes of other kinds.
std::shared_ptr<const world::MeshGeometry> with_picture_places(
    const world::Geometry& shape, std::shared_ptr<const world::MeshGeometry> mesh);

/// (u, v) as the frame lays it.
world::Vector2 laid(const world::PictureFrame& frame, const world::Vector2& place);

}  // namespace icome::files
