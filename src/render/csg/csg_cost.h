#pragma once
#include <optional>
#include <string>

#include "render/csg/csg_geometry.h"
#include "render/gl/offscreen.h"
#include "render/model/camera.h"

namespace icome::render {

/// Estimated time, s, that a processor takes to find the visible surface of the solid in one view of that
/// many pixels. The work grows with the number of operands times the number of them that lie one over the
/// other in the picture.
double software_seconds(const CsgGeometry& geometry, const Matrix4& clip_from_tree, double pixels);

/// software_seconds() from the frame of the geometry's buffers.
double seconds_from_buffer(const CsgGeometry& geometry, const Matrix4& clip_from_buffer, double pixels);

// Longest times of images, s: of a solid in a view that moves, and in a picture of some fifty passes.
constexpr double kLongestLiveView = 0.1;
constexpr double kLongestStillView = 0.4;
/// A graphics card's time as a share of a processor's, at most.
constexpr double kHardwareFactor = 1.0 / 30.0;

/// The reason to draw the solid as a triangle mesh, as a part of a sentence: the driver cannot make
/// images of CSG, or a picture would take too long. Nothing when images will do.
std::optional<std::string> reason_against_images(const Offscreen& context, const CsgGeometry& geometry,
                                                 const Matrix4& clip_from_tree, double pixels);

}  // namespace icome::render
