#pragma once
#include <optional>
#include <span>
#include <vector>

#include "files/findings.h"
#include "files/patience.h"
#include "files/vrml_face_set.h"
#include "world/flat_bytes.h"
#include "world/geometry.h"

namespace icome::files {

namespace flat {
struct Piece;
}

/// The shape of a piece, one for each of the textures that it is seen with: they differ where the texture
/// coordinates of a mesh do. Null for those that cannot be made, which `findings` tells. Takes what it
/// reads out of `reader`. Pieces of ICOME's own kinds that cannot be made become their triangles.
std::vector<world::GeometryPointer> shapes_of(const flat::Piece& piece, world::FlatReader& reader,
                                              std::span<const std::optional<TextureMatrix>> textures,
                                              Findings& findings, Patience& patience);

}  // namespace icome::files
