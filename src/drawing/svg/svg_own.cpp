#include "drawing/svg/svg_own.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/parse_number.h"
#include "drawing/svg/svg_colour.h"
#include "drawing/svg/svg_names.h"

namespace icome::drawing {
namespace {

/// Between the end of a closed curve and its start, at most: m, and of the coordinates where those are
/// larger. Edits leave that, and the numbers of a file that other programs have rounded.
constexpr double kClosedGap = 1e-9;

/// The words of own data, between blanks, commas and the letters M and C.
class OwnWords {
 public:
  explicit OwnWords(std::string_view text) : rest_(text) {}

  bool more() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBetween), rest_.size()));
    return !rest_.empty();
  }
  std::string_view next() {
    if (!more()) return {};
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBetween));
    rest_.remove_prefix(word.size());
    return word;
  }
  bool take_mm(double& metres) { return take(metres, metres_from_mm); }
  bool take_number(double& number) { return take(number, base::parse_finite); }
  bool take_point(Vector2& point) { return take_mm(point.x()) && take_mm(point.y()); }
  const std::string& faulty() const { return faulty_; }

 private:
  static constexpr std::string_view kBetween = " ,\t\r\nMC";

  template <typename Parse>
  bool take(double& number, const Parse& parse) {
    const std::string_view word = next();
    const auto parsed = parse(word);
    if (!parsed) faulty_ = word.empty() ? "a number is missing" : quoted_value(word) + " is no number";
    number = parsed.value_or(0.0);
    return parsed.has_value();
  }

  std::string_view rest_;
  std::string faulty_;
};

base::Result<std::vector<CubicBezier>> own_segments(std::string_view text) {
  OwnWords words(text);
  std::vector<CubicBezier> segments;
  Vector2 from;
  const auto faulty = [&] { return base::fail("icome:curve: " + words.faulty()); };
  if (!words.take_point(from)) return faulty();
  while (words.more()) {
    CubicBezier segment{{from, from, from, from}};
    for (std::size_t i = 1; i < 4; ++i)
      if (!words.take_point(segment.points[i])) return faulty();
    from = segment.points[3];
    segments.push_back(segment);
  }
  if (segments.empty()) return base::fail("icome:curve has no segment");
  return segments;
}

base::Result<std::vector<WidthSegment>> own_widths(std::string_view text, double end) {
  OwnWords words(text);
  std::vector<WidthSegment> widths;
  double reached = 0.0;
  while (words.more()) {
    WidthSegment width{};
    if (!words.take_number(width.from) || !words.take_mm(width.from_width) || !words.take_number(width.to) ||
        !words.take_mm(width.to_width))
      return base::fail("icome:widths: " + words.faulty());
    if (width.from != reached || width.to < width.from)
      return base::fail(
          fmt::format("icome:widths: places go from {:g} to {:g} where they should go on from {:g}",
                      width.from, width.to, reached));
    if (width.from_width < 0.0 || width.to_width < 0.0)
      return base::fail("icome:widths: a width is negative");
    reached = width.to;
    widths.push_back(width);
  }
  if (!widths.empty() && reached != end)
    return base::fail(fmt::format("icome:widths end at {:g}, but the curve at {:g}", reached, end));
  return widths;
}

std::string_view own_text(const XmlText& xml, const XmlNode& node, std::string_view name) {
  return xml.attribute_of(node, kSketchNamespace, name).value();
}

base::Result<Colour> own_colour(std::string_view text) {
  if (const auto css = parse_css_colour(text)) return css->colour;
  OwnWords words(text);
  Colour colour{};
  for (float& channel : colour) {
    const auto number = base::parse_number<float>(words.next());
    if (!number || !(*number >= 0.0F && *number <= 1.0F))
      return base::fail(quoted_value(text) + " is no colour such as \"0.5,0,1\" or \"#8000ff\"");
    channel = *number;
  }
  return colour;
}

base::Result<void> read_own_look(const XmlText& xml, const XmlNode& path, Stroke& stroke) {
  if (const std::string_view text = own_text(xml, path, kColourAttribute); !text.empty()) {
    const auto colour = own_colour(text);
    if (!colour) return base::fail("icome:colour: " + colour.error().message);
    stroke.colour = *colour;
  }
  if (const std::string_view text = own_text(xml, path, kFillAttribute); !text.empty() && text != "none") {
    const auto colour = own_colour(text);
    if (!colour) return base::fail("icome:fill: " + colour.error().message);
    stroke.fill = *colour;
  }
  if (const std::string_view text = own_text(xml, path, kOpacityAttribute); !text.empty()) {
    const auto opacity = base::parse_finite(text);
    if (!opacity || *opacity < 0.0 || *opacity > 1.0)
      return base::fail(fmt::format("icome:opacity {} is not between 0 and 1", quoted_value(text)));
    stroke.opacity = *opacity;
  }
  stroke.ends = own_text(xml, path, kEndsAttribute) == "flat" ? CurveEnds::Flat : CurveEnds::Round;
  return {};
}

bool ends_meet(const Curve& curve) {
  const Vector2& start = curve.segments.front().points[0];
  const double gap = (curve.segments.back().points[3] - start).norm();
  return gap <= kClosedGap * std::max(1.0, start.cwiseAbs().maxCoeff());
}

base::Result<void> close_own(Curve& curve) {
  if (!ends_meet(curve))
    return base::fail("icome:closed is true, but the end of icome:curve is not its start");
  curve.segments.back().points[3] = curve.segments.front().points[0];
  curve.closed = true;
  return {};
}

}  // namespace

base::Result<std::optional<Stroke>> own_stroke_of(const XmlText& xml, const XmlNode& path) {
  const XmlAttribute attribute = xml.attribute_of(path, kSketchNamespace, kCurveAttribute);
  if (!attribute) return std::nullopt;
  auto segments = own_segments(attribute.value());
  if (!segments) return tl::unexpected(segments.error());
  Stroke stroke;
  stroke.curve.segments = std::move(*segments);
  auto widths = own_widths(own_text(xml, path, kWidthsAttribute), stroke.curve.end());
  if (!widths) return tl::unexpected(widths.error());
  stroke.curve.widths = std::move(*widths);
  const std::string_view said = own_text(xml, path, kClosedAttribute);
  const bool is_lost = said != "true" && said != "false" && has_drawn_mark(xml, path);
  if (said == "true" || (is_lost && ends_meet(stroke.curve)))
    if (const auto closed = close_own(stroke.curve); !closed) return tl::unexpected(closed.error());
  if (const auto read = read_own_look(xml, path, stroke); !read) return tl::unexpected(read.error());
  return stroke;
}

bool has_drawn_mark(const XmlText& xml, const XmlNode& path) {
  return !own_text(xml, path, kDrawnAttribute).empty();
}

bool was_redrawn(const XmlText& xml, const XmlNode& path) {
  const std::string_view mark = own_text(xml, path, kDrawnAttribute);
  return !mark.empty() && mark != drawn_mark(path.attribute("d").value());
}

std::optional<Vector2> own_size_of(const XmlText& xml) {
  OwnWords words(own_text(xml, xml.root(), kSizeAttribute));
  Vector2 size;
  if (!words.take_point(size) || words.more() || !(size.minCoeff() > 0.0)) return std::nullopt;
  return size;
}

bool own_flag_of(const XmlText& xml, const XmlNode& node, std::string_view name) {
  return own_text(xml, node, name) == "true";
}

}  // namespace icome::drawing
