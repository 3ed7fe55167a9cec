#pragma once
#include "files/findings.h"
#include "files/vrml/read/vrml_face_set.h"
#include "io/time_budget.h"
#include "world/edit/flat_bytes.h"
#include "world/shape/geometry.h"

namespace icome::files {

namespace flat {
struct Geometry;
}

/// The shape of a geometry; null where it cannot be made, which is added to `findings`. `shows_picture`: is
/// it seen with one? Takes the data out of `reader`. Geometries of ICOME's own kinds that cannot be made
/// become their triangles.
world::GeometryPointer shape_of(const flat::Geometry& geometry, world::FlatReader& reader, bool shows_picture,
                                Findings& findings, io::TimeBudget& time_budget);

}  // namespace icome::files
