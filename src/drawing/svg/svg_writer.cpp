#include "drawing/svg/svg_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "base/utf8.h"
#include "drawing/outline/outline.h"
#include "drawing/svg/svg_names.h"
#include "drawing/svg/svg_path.h"
#include "io/number_text.h"

namespace icome::drawing {
namespace {

constexpr double kOutlineTolerance = 1e-6;  // m

/// The text as it may stand within quotation marks.
std::string in_quotes(std::string_view text) {
  std::string quoted;
  for (const char c : base::as_utf8(text)) {
    switch (c) {
      case '&':
        quoted += "&amp;";
        break;
      case '<':
        quoted += "&lt;";
        break;
      case '>':
        quoted += "&gt;";
        break;
      case '"':
        quoted += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':
        quoted += fmt::format("&#{};", int(c));
        break;
      default:
        // XML has no other control characters, not even escaped.
        quoted += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return quoted;
}

/// A length in mm to 10 nm, for what is only seen.
void append_seen_mm(std::string& text, double metres) {
  const std::size_t begin = text.size();
  fmt::format_to(std::back_inserter(text), "{:.5f}", metres * 1000.0);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  if (std::string_view(text).substr(begin) == "-0") text.erase(begin, 1);
}

using AppendLength = void (*)(std::string&, double);

void append_point(std::string& text, const Vector2& point, AppendLength append) {
  append(text, point.x());
  text += ',';
  append(text, point.y());
}

/// Path data without lines: what is read back has cubics only.
std::string cubics_data(const std::vector<CubicBezier>& segments, AppendLength append) {
  std::string data;
  if (segments.empty()) return data;
  data += 'M';
  append_point(data, segments.front().points[0], append);
  for (const CubicBezier& segment : segments) {
    data += " C";
    for (std::size_t i = 1; i < 4; ++i) {
      if (i > 1) data += ' ';
      append_point(data, segment.points[i], append);
    }
  }
  return data;
}

bool is_even_line(const CubicBezier& c) { return c == CubicBezier::line(c.points[0], c.points[3]); }

void append_loop(std::string& data, const std::vector<CubicBezier>& rim) {
  data += data.empty() ? "M" : " M";
  append_point(data, rim.front().points[0], append_seen_mm);
  for (const CubicBezier& edge : rim) {
    const bool line = is_even_line(edge);
    data += line ? " L" : " C";
    for (std::size_t i = line ? 3 : 1; i < 4; ++i) {
      append_point(data, edge.points[i], append_seen_mm);
      if (i < 3) data += ' ';
    }
  }
  data += " Z";
}

std::string outline_data(const Stroke& stroke) {
  std::string data;
  for (const OutlinePiece& piece : outline_of(stroke.curve, stroke.ends, kOutlineTolerance))
    append_loop(data, piece.rim);
  return data;
}

std::string centre_line_data(const Stroke& stroke) {
  return cubics_data(stroke.curve.segments, append_seen_mm) + (stroke.curve.closed ? " Z" : "");
}

/// Do two paths draw the same within what programs round?
bool draws_the_same(std::string_view one, std::string_view other) {
  constexpr double kRounded = 0.005;  // mm
  const SvgShape a = parse_svg_path(one), b = parse_svg_path(other);
  if (!a.fault.empty() || !b.fault.empty()) return false;
  const auto same_segment = [](const CubicBezier& left, const CubicBezier& right) {
    return std::ranges::equal(left.points, right.points, [](const Vector2& p, const Vector2& q) {
      return (p - q).cwiseAbs().maxCoeff() <= kRounded;
    });
  };
  return std::ranges::equal(a.subpaths, b.subpaths, [&](const SvgSubpath& left, const SvgSubpath& right) {
    return left.closed == right.closed && std::ranges::equal(left.segments, right.segments, same_segment);
  });
}

std::string css_text(const Colour& colour) {
  const auto byte = [](float channel) { return int(std::lround(255.0F * std::clamp(channel, 0.0F, 1.0F))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

std::string exact_text(const Colour& colour) {
  std::string text;
  for (const float channel : colour) {
    if (!text.empty()) text += ',';
    io::append_number(text, channel);
  }
  return text;
}

std::string widths_text(const std::vector<WidthSegment>& widths) {
  std::string text;
  for (const WidthSegment& piece : widths) {
    if (!text.empty()) text += ' ';
    io::append_number(text, piece.from);
    text += ',';
    append_mm(text, piece.from_width);
    text += ',';
    io::append_number(text, piece.to);
    text += ',';
    append_mm(text, piece.to_width);
  }
  return text;
}

/// Writes one file, element by element.
class SvgWriter {
 public:
  explicit SvgWriter(SvgLines lines) : lines_(lines) {}

  std::string written(const Drawing& drawing) && {
    text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg";
    attribute("xmlns", kSvgNamespace);
    attribute("xmlns:inkscape", kInkscapeNamespace);
    attribute("xmlns:sodipodi", kSodipodiNamespace);
    attribute("xmlns:icome", kSketchNamespace);
    std::string width, height;
    append_mm(width, drawing.size.x());
    append_mm(height, drawing.size.y());
    attribute("width", width + "mm");
    attribute("height", height + "mm");
    attribute("viewBox", fmt::format("0 0 {} {}", width, height));
    own(kSizeAttribute, width + "," + height);
    text_ += ">\n";
    for (const Layer& layer : drawing.layers) add(layer);
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  /// An attribute whose value needs no escaping.
  void attribute(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), " {}=\"{}\"", name, value);
  }
  void own(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), " icome:{}=\"{}\"", name, value);
  }
  void own_flag(std::string_view name, bool value) { own(name, std::string_view(value ? "true" : "false")); }

  void add(const Layer& layer) {
    const std::string name = in_quotes(layer.name);
    text_ += " <g";
    attribute("inkscape:groupmode", "layer");
    attribute("inkscape:label", name);
    own(kLayerAttribute, name);
    own_flag(kLockedAttribute, layer.locked);
    if (layer.locked) attribute("sodipodi:insensitive", "true");
    if (!layer.visible) attribute("display", "none");
    text_ += ">\n";
    for (const StrokePointer& stroke : layer.strokes) add(*stroke);
    text_ += " </g>\n";
  }

  void add(const Stroke& stroke) {
    if (lines_ == SvgLines::CentreLines) return add_centre_line(stroke);
    const std::string outline = outline_data(stroke);
    // Where both are seen, one group makes both translucent, so that the fill does not show below the line.
    if (!stroke.fill || outline.empty()) return add_filled(stroke, outline, true);
    text_ += "  <g";
    add_opacity(stroke);
    const std::string area = cubics_data(stroke.curve.segments, append_seen_mm);
    text_ += ">\n  <path";
    own(kShownAttribute, "only");
    attribute("d", area);
    attribute("fill", css_text(*stroke.fill));
    own(kDrawnAttribute, drawn_mark(area));
    text_ += "/>\n";
    add_filled(stroke, outline, false);
    text_ += "  </g>\n";
  }

  /// The outline or, where there is none, the fill of the curve.
  void add_filled(const Stroke& stroke, const std::string& outline, bool with_opacity) {
    const bool line = !outline.empty() || !stroke.fill;
    const std::string data = line ? outline : cubics_data(stroke.curve.segments, append_seen_mm);
    text_ += "  <path";
    attribute("d", data);
    attribute("fill", css_text(line ? stroke.colour : *stroke.fill));
    attribute("fill-rule", "nonzero");
    if (with_opacity) add_opacity(stroke);
    add_own(stroke, data);
    text_ += "/>\n";
  }

  void add_centre_line(const Stroke& stroke) {
    const std::string data = centre_line_data(stroke);
    std::string width;
    append_seen_mm(width, stroke.curve.mean_width());
    text_ += "  <path";
    attribute("d", data);
    attribute("fill", stroke.fill ? css_text(*stroke.fill) : "none");
    attribute("stroke", width == "0" ? "none" : css_text(stroke.colour));
    attribute("stroke-width", width);
    attribute("stroke-linecap", stroke.ends == CurveEnds::Round ? "round" : "butt");
    attribute("stroke-linejoin", "round");
    add_opacity(stroke);
    add_own(stroke, data);
    text_ += "/>\n";
  }

  void add_opacity(const Stroke& stroke) {
    if (stroke.opacity < 1.0) attribute("opacity", fmt::format("{:.4g}", stroke.opacity));
  }

  void add_own(const Stroke& stroke, std::string_view data) {
    own(kCurveAttribute, cubics_data(stroke.curve.segments, append_mm));
    own(kWidthsAttribute, widths_text(stroke.curve.widths));
    own_flag(kClosedAttribute, stroke.curve.closed);
    own(kColourAttribute, exact_text(stroke.colour));
    own(kFillAttribute, stroke.fill ? exact_text(*stroke.fill) : "none");
    own(kEndsAttribute, stroke.ends == CurveEnds::Round ? "round" : "flat");
    std::string opacity;
    io::append_number(opacity, stroke.opacity);
    own(kOpacityAttribute, opacity);
    own(kDrawnAttribute, drawn_mark(data));
  }

  SvgLines lines_;
  std::string text_;
};

}  // namespace

bool is_drawn_by(const Stroke& stroke, std::string_view path_data) {
  return draws_the_same(path_data, centre_line_data(stroke)) ||
         draws_the_same(path_data, cubics_data(stroke.curve.segments, append_seen_mm)) ||
         draws_the_same(path_data, outline_data(stroke));
}

std::string svg_text(const Drawing& drawing, SvgLines lines) { return SvgWriter(lines).written(drawing); }

}  // namespace icome::drawing
