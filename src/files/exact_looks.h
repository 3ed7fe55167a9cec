#pragma once
#include <memory>

#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// Is the shape a solid with parts that have colours of their own, which its triangles get?
bool has_part_colours(const world::Geometry& shape);

/// Are some of these colours translucent, which nothing here shows?
bool has_clear_parts(const world::Geometry& shape);

/// The triangles that stand for a shape, with normals and colours to look like it: the normals of a
/// primitive, elsewhere normals with edges where it bends by more than 0.6 rad; the colours of a solid's
/// parts, `own` for parts without. A mesh stays as it is.
std::shared_ptr<const world::MeshGeometry> with_exact_looks(
    const world::Geometry& shape, std::shared_ptr<const world::MeshGeometry> triangles,
    const world::Colour& own);

}  // namespace icome::files
