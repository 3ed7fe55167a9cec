#pragma once
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::animation {

/// The most that drawing an SVG file may take, by what its elements are in and refer to.
struct SvgCost {
  int depth = 0;  ///< elements that are drawn within one another, as many as calls of the renderer
  int layers =
      1;  ///< pictures of the whole size that are there at a time, for opacity, masks, filters and such
};

/// Judges a file before librsvg draws it, which ends the program with small files made for that: it calls
/// itself for each <use> in a <use>, and keeps a picture for each group of some opacity in another. Fails,
/// beginning with `name`, where more than kDeepestSvg elements lie in one another, where elements refer to
/// themselves, and where it cannot be known (entities of the file's own, rare encodings).
base::Result<SvgCost> svg_cost(std::string_view text, const std::string& name);

inline constexpr int kDeepestSvg = 256;

}  // namespace icome::animation
