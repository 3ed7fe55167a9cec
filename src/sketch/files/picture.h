#pragma once
#include <filesystem>
#include <optional>

#include "base/result.h"
#include "charts/canvas.h"
#include "sketch/drawn.h"

namespace icome::sketch {

/// The part of the plane that a picture shows.
enum class PictureArea {
  PaperOrDrawing,  ///< the paper where everything lies on it, else the drawing
  Paper,
  Drawing,  ///< what is drawn, with a margin; the paper where nothing is
};

/// Size, area and background of a picture of a drawing. Layers that are not visible are left out.
struct PictureOptions {
  int longer_side = 1200;               ///< pixels, 1 to kLongestPictureSide; only for PNG
  std::optional<double> pixels_per_mm;  ///< instead of longer_side where it is set; 4 to 40
  std::optional<Colour> background = Colour{1.0F, 1.0F, 1.0F};  ///< none: the picture is clear there
  PictureArea area = PictureArea::PaperOrDrawing;
  double margin = 0.005;  ///< m, around a drawing that is not on the paper; 0 to 0.02
};

inline constexpr int kLongestPictureSide = 16384;  // pixels

/// The drawing in pixels. Fails where a side would have more than kLongestPictureSide of them or less than
/// one.
base::Result<charts::Image> draw(const Drawing& drawing, const PictureOptions& options);

/// Writes a picture by the path's ending: .png; .pdf, as large as it is on the paper; .svg, which is
/// svg_text() with outlines and always shows the paper. The file appears whole or not at all. Fails on
/// other endings, sizes that draw() refuses, and a path that cannot be written.
base::Result<void> write_picture(const Drawing& drawing, const PictureOptions& options,
                                 const std::filesystem::path& path);

/// Paints line and fill of one stroke, through `page_from_paper` (page units from m), which neither mirrors
/// nor stretches. Overlaps of a stroke with itself do not show through. The line is off by `tolerance` (m) at
/// most.
void paint(charts::Canvas& canvas, const Stroke& stroke, const Eigen::Affine2d& page_from_paper,
           double tolerance);
/// Paints all visible layers.
void paint(charts::Canvas& canvas, const Drawing& drawing, const Eigen::Affine2d& page_from_paper,
           double tolerance);

}  // namespace icome::sketch
