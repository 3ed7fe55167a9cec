#pragma once
#include <memory>

#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// Have parts of the shape colours of their own, and is it a solid whose triangles get them?
bool has_part_colours(const world::Geometry& shape);

/// Are some of these colours to be seen through, which nothing here shows?
bool has_clear_parts(const world::Geometry& shape);

/// Triangles of a shape that are to stand for it, with what programs need to show it as it is: the normals of
/// a primitive, elsewhere such as make bends of more than 0.6 rad edges; the colours of a solid's parts,
/// `own` for parts without. A mesh stays what it is.
std::shared_ptr<const world::MeshGeometry> with_exact_looks(
    const world::Geometry& shape, std::shared_ptr<const world::MeshGeometry> triangles,
    const world::Colour& own);

}  // namespace icome::files
