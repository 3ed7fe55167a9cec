#pragma once
#include <optional>
#include <string>

#include "render/camera.h"
#include "render/csg_geometry.h"
#include "render/offscreen.h"

namespace icome::render {

/// About how long a processor takes to find what is visible of the solid in one view of that many pixels,
/// s. The work grows with the product of how many operands there are and how many of them lie one over the
/// other in the picture.
double software_seconds(const CsgGeometry& geometry, const Matrix4& clip_from_tree, double pixels);

/// Is the solid drawn sooner from images than as that many triangles?
bool prefer_images(const CsgGeometry& geometry, std::size_t triangles, const Matrix4& clip_from_buffer,
                   double pixels, bool software);

/// Why the solid had better be drawn as a triangle mesh, as a part of a sentence: the driver cannot make
/// images of CSG, or a picture would take too long. Nothing when images will do.
std::optional<std::string> reason_against_images(const Offscreen& context, const CsgGeometry& geometry,
                                                 const Matrix4& clip_from_tree, double pixels);

}  // namespace icome::render
