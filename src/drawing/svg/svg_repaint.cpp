#include "drawing/svg/svg_repaint.h"

#include <algorithm>
#include <cmath>

namespace icome::drawing {
namespace {

constexpr double kSameOpacity = 0.003;       // programs store it in 8 bits
constexpr double kSameWidth = 1e-3;          // of the width
constexpr double kSeenRounding = 1e-8;       // m, of lengths that are only seen
constexpr double kMetresOfDrawnUnit = 1e-3;  // the project's files are in mm

bool is_same_colour(const Colour& one, const Colour& other) {
  const auto byte = [](float channel) { return std::lround(255.0F * std::clamp(channel, 0.0F, 1.0F)); };
  return std::ranges::equal(one, other, {}, byte, byte);
}

/// Compares what is seen with what a stroke is, and keeps the names of what differs.
class Repaint {
 public:
  Repaint(const SvgStyle& seen, Stroke& stroke) : seen_(seen), stroke_(stroke) {}

  void take_colour(const std::optional<CssColour>& paint) {
    if (!paint || is_same_colour(paint->colour, stroke_.colour)) return;
    stroke_.colour = paint->colour;
    changes_.emplace_back("the colour");
  }

  void take_fill(const std::optional<CssColour>& paint) {
    if (paint.has_value() == stroke_.fill.has_value() &&
        (!paint || is_same_colour(paint->colour, *stroke_.fill)))
      return;
    stroke_.fill.reset();
    if (paint) stroke_.fill = paint->colour;
    changes_.emplace_back("the fill");
  }

  /// Takes the only path of a stroke with a fill: it draws the fill, or the line where the fill was taken
  /// out.
  void take_fill_alone(const std::optional<CssColour>& paint) {
    if (!paint || is_same_colour(paint->colour, *stroke_.fill)) return;
    const bool is_line =
        stroke_.curve.widest() > kSeenRounding && is_same_colour(paint->colour, stroke_.colour);
    take_fill(is_line ? std::nullopt : paint);
  }

  void take_opacity(const std::optional<CssColour>& paint, double share) {
    const double opacity = seen_.opacity * share * (paint ? paint->alpha : 1.0);
    if (std::abs(opacity - stroke_.opacity) <= kSameOpacity) return;
    stroke_.opacity = std::clamp(opacity, 0.0, 1.0);
    changes_.emplace_back("the opacity");
  }

  /// Compares the mean width, with which a centre line is drawn.
  void take_width() {
    const double width = seen_.line_width * kMetresOfDrawnUnit, mean = stroke_.curve.mean_width();
    if (std::abs(width - mean) <= std::max(kSameWidth * mean, kSeenRounding)) return;
    if (mean <= kSeenRounding) stroke_.curve.widths = {{0.0, width, stroke_.curve.end(), width}};
    if (mean > kSeenRounding) {
      for (WidthSegment& piece : stroke_.curve.widths) {
        piece.from_width *= width / mean;
        piece.to_width *= width / mean;
      }
    }
    changes_.emplace_back("the width");
  }

  void take_ends() {
    if (stroke_.curve.closed || seen_.ends == stroke_.ends) return;
    stroke_.ends = seen_.ends;
    changes_.emplace_back("the ends");
  }

  std::vector<std::string> changes() && { return std::move(changes_); }

 private:
  const SvgStyle& seen_;
  Stroke& stroke_;
  std::vector<std::string> changes_;
};

}  // namespace

std::vector<std::string> take_repaint(const SvgStyle& seen, const SvgStyle* below, Stroke& stroke) {
  Repaint repaint(seen, stroke);
  const bool is_centre_line = seen.line.has_value();
  if (is_centre_line) {
    repaint.take_colour(seen.line);
    repaint.take_fill(seen.fill);
    repaint.take_width();
    repaint.take_ends();
    repaint.take_opacity(seen.line, seen.line_opacity);
    return std::move(repaint).changes();
  }
  // An outline has the line's colour as its fill; what it encloses lies below, or is drawn alone.
  if (below != nullptr) repaint.take_fill(below->fill);
  if (below == nullptr && stroke.fill)
    repaint.take_fill_alone(seen.fill);
  else
    repaint.take_colour(seen.fill);
  if (seen.fill) repaint.take_opacity(seen.fill, seen.fill_opacity);
  return std::move(repaint).changes();
}

}  // namespace icome::drawing
