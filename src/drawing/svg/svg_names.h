#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace icome::drawing {

// Names of the data that the project writes into its SVG files beside what every program draws, so that a
// drawing comes back as it was. Attributes are read by their namespace, whatever prefix stands for it; it is
// written as `icome`.
//
// On the root:
//   icome:size     "w,h", mm of the paper
// On the <g> of a layer, directly below the root:
//   icome:layer    its name, also where it is empty
//   icome:locked   "true" or "false" (so where it is missing)
// and what Inkscape has for the same: inkscape:label, sodipodi:insensitive and display, which count where
// they differ, as another program has changed them.
//
// On the <path> of a stroke. With icome:curve, what the path itself draws (d) is ignored:
//   icome:curve    path data of the centre line: "M x,y C x,y x,y x,y C ...", absolute, in mm of the paper,
//                  the three points of each further segment behind a C of their own or not
//   icome:widths   "t0,w0,t1,w1 t0,w0,t1,w1 ...": places along the curve (0 to the number of segments) and
//                  widths in mm; empty or missing for a line without width
//   icome:closed   "true" or "false"
//   icome:colour   "r,g,b", each 0 to 1, as floats that read back to the same bits; or "#rrggbb"
//   icome:fill     as icome:colour; "none" or missing for a curve that is not filled
//   icome:ends     "round" or "flat"
//   icome:opacity  0 to 1
//   icome:drawn    drawn_mark() of the path's d as it is written. Where d has another one when the file is
//                  read, and draws something else, another program has changed the path, and what it
//                  draws counts after all.
//
// Transforms that another program has put on such a path or around it, and a viewBox that it has changed,
// move its icome:curve, too: a writer writes none, and a viewBox in mm. Where icome:drawn is there, colours,
// opacity, and width and ends of centre lines that differ from icome:... by more than the file's rounding
// were changed by another program, and count as well.
//
// Other elements in the <g>, or a <path> marked icome:curve and other paths after it, are independent: a
// reader makes a stroke of each <path>, <rect> and so on. What a writer adds only for show, the fill of the
// stroke that follows, has the attribute
//   icome:shown    "only": not read, unless it has an icome:drawn, too, and was changed in more than its
//                  colour, or its stroke was taken away

inline constexpr std::string_view kSvgNamespace = "http://www.w3.org/2000/svg";
inline constexpr std::string_view kXlinkNamespace = "http://www.w3.org/1999/xlink";
inline constexpr std::string_view kInkscapeNamespace = "http://www.inkscape.org/namespaces/inkscape";
inline constexpr std::string_view kSodipodiNamespace = "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd";
inline constexpr std::string_view kSketchNamespace = "https://icome.org/sketch";

inline constexpr std::string_view kSizeAttribute = "size";
inline constexpr std::string_view kLayerAttribute = "layer";
inline constexpr std::string_view kLockedAttribute = "locked";
inline constexpr std::string_view kCurveAttribute = "curve";
inline constexpr std::string_view kWidthsAttribute = "widths";
inline constexpr std::string_view kClosedAttribute = "closed";
inline constexpr std::string_view kColourAttribute = "colour";
inline constexpr std::string_view kFillAttribute = "fill";
inline constexpr std::string_view kEndsAttribute = "ends";
inline constexpr std::string_view kOpacityAttribute = "opacity";
inline constexpr std::string_view kDrawnAttribute = "drawn";
inline constexpr std::string_view kShownAttribute = "shown";

/// Sixteen hexadecimal digits (FNV-1a) that tell whether path data was changed.
std::string drawn_mark(std::string_view path_data);

/// Appends a length in mm as the shortest text from which metres_from_mm() makes the same bits: the decimals
/// of the metres with the point three places on. Precondition: it is finite.
void append_mm(std::string& text, double metres);

/// The metres that a number of mm stands for; nothing for text that is no finite number.
std::optional<double> metres_from_mm(std::string_view mm);

}  // namespace icome::drawing
