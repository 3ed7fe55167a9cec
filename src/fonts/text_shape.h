#pragma once
#include <string>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::fonts {

/// The family that text is set in when none is asked for.
inline constexpr const char* kUsualFont = "DejaVu Sans";

/// The most letters of a text that becomes a shape.
inline constexpr std::size_t kMostLetters = 2000;

/// Text as a solid: z from -depth / 2 to depth / 2, closed and facing out; a sheet in the plane z = 0 that
/// faces +z where depth is 0 (m). `height` (m) is that of the capital H. Lines end with '\n'; each is centred
/// on x = 0 by its visible extent, and all of them on y = 0 by their capitals. Letters that overlap become
/// one piece. Round edges keep to within a thousandth of the height.
///
/// `family` is a family of fonts that fontconfig finds here, perhaps with a style ("DejaVu Serif:bold");
/// empty: kUsualFont. Letters stand one behind the other, kerned by the font's own pairs: scripts whose
/// letters join or change order are not set as they should be.
///
/// Fails with a sentence for text without anything to see, for letters that the font lacks, for a family that
/// is not here, and for sizes that geometry::Profile cannot have.
base::Result<geometry::TriangleMesh> text_shape(const std::string& utf8, double height, double depth,
                                                const std::string& family = {});

}  // namespace icome::fonts
