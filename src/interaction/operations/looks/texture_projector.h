#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "geometry/deform/texture_projection.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {

// The projector that threw a picture on a mesh. It is kept in the mesh's recipe, so that it can be moved
// afterwards; where vertices are moved or the mesh is remade, the recipe is lost, and the projector with
// it.

/// The projector of a shape; nothing where none is known.
std::optional<geometry::TextureProjector> projector_in(const world::Geometry& shape);

/// The mesh with the texture coordinates that a projector of the whole picture gives it, and with the
/// projector in its recipe. Normals and colours stay. Fails as geometry::project_texture does.
base::Result<std::shared_ptr<const world::MeshGeometry>> with_projector(
    const world::MeshGeometry& mesh, const geometry::TextureProjector& projector);

/// The projector after a motion of the world has carried it along, as it stands in an object. Where the
/// object is shrunk to nothing it is not finite, which with_projector() refuses.
geometry::TextureProjector moved_projector(geometry::TextureProjector projector,
                                           const base::Affine3& world_from_object,
                                           const base::Affine3& motion);

/// Is a recipe that of a projector, so that the shape itself was made by hand?
bool tells_projector_only(std::string_view recipe);

}  // namespace icome::interaction
