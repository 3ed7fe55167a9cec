#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::cutout {

/// An isosceles triangle of the table (thesis 3.4.3), which two numbers tell from the others.
struct KnownTriangle {
  std::string id;
  double base_angle = 0;  ///< rad, of the two equal corners, in (0, pi/2)
  double height = 0;      ///< mm, from the middle of the base to the apex
  std::string cell;       ///< name of the animation's cell that it moves; may be empty
};

/// The known-object list (thesis 3.4.7).
struct KnownTriangles {
  std::vector<KnownTriangle> triangles;
};

/// Reads a list in TOML: `[[triangle]]` with `id`, `base_angle_deg`, `height_mm` and, if wished, `cell`.
/// Fails with the file, the line and what is wrong.
base::Result<KnownTriangles> read_known_triangles(const std::filesystem::path& path);
base::Result<KnownTriangles> read_known_triangles(std::string_view text, const std::string& name);
/// The list as the text of such a file.
std::string known_triangles_text(const KnownTriangles& known);

/// Sentences about triangles of the list that the tracker may mistake: base angles near 60 degrees, which
/// turn into themselves by a third; two of nearly one shape; three whose edges can together make a fourth.
std::vector<std::string> warnings_of(const KnownTriangles& known);

}  // namespace icome::cutout
