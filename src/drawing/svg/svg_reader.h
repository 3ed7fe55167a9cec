#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "drawing/drawing.h"

namespace icome::drawing {

/// The most bytes of a file that is read.
inline constexpr std::uint64_t kLargestSvg = 64U << 20U;

/// The content of an SVG file.
struct DrawingRead {
  Drawing drawing;
  std::vector<std::string>
      notes;  ///< what is skipped or taken otherwise: "drawing.svg:12: <text> is skipped"
};

/// Reads the lines and fills of an SVG file: all commands of paths and all shapes, with transforms, units,
/// style sheets and inherited looks. Groups directly below the root are layers; what lies outside of them
/// goes to layers of its own ("Layer 1"), so that nothing changes its order. A subpath is a stroke each; a
/// fill of several that lie in or on each other is one more, whose lines are joined so that it has their
/// holes. What the project wrote into the file itself (svg_names.h) comes back as it was. What is faulty in
/// one element is left out and noted, a path from the fault on. Fails with file and line only on what is no
/// XML or no SVG, and on files that draw more than can be kept.
base::Result<DrawingRead> read_svg_drawing(const std::filesystem::path& file);

/// Reads SVG out of memory; `name` is for errors and notes.
base::Result<DrawingRead> read_svg_text(std::string_view text, const std::string& name);

}  // namespace icome::drawing
