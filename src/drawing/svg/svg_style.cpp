#include "drawing/svg/svg_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "drawing/svg/svg_frame.h"
#include "drawing/svg/svg_scanner.h"
#include "drawing/svg/xml_text.h"
#include "io/text_scanner.h"

namespace icome::drawing {
namespace {

/// Properties that change what is seen and that a drawing does not have.
constexpr std::array<std::string_view, 9> kSkippedProperties = {
    "clip-path",  "mask",       "filter",           "marker",        "marker-start",
    "marker-mid", "marker-end", "stroke-dasharray", "mix-blend-mode"};

std::string_view trimmed_css(std::string_view text) {
  constexpr std::string_view kSvgBlanks = " \t\r\n\f";
  const std::size_t first = text.find_first_not_of(kSvgBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSvgBlanks) - first + 1);
}

/// Sets the properties of one element.
class StyleSetter {
 public:
  StyleSetter(SvgStyle& style, const SvgStyle& around, double whole, const XmlNode& node, SvgNotes& notes)
      : style_(style), around_(around), whole_(whole), node_(node), notes_(notes) {}

  void set(std::string_view name, std::string_view value);
  double own_opacity() const { return own_opacity_; }

 private:
  bool set_paint(std::string_view name, std::string_view value);
  bool set_number(std::string_view name, std::string_view value);
  void set_rest(std::string_view name, std::string_view value);
  std::optional<CssColour> paint(std::string_view value, const std::optional<CssColour>& inherited);
  std::optional<CssColour> colour_or_black(std::string_view value);
  void set_share(double& share, std::string_view value, double inherited);

  SvgStyle& style_;
  const SvgStyle& around_;
  double whole_;
  const XmlNode& node_;
  SvgNotes& notes_;
  double own_opacity_ = 1.0;
};

std::optional<CssColour> StyleSetter::colour_or_black(std::string_view value) {
  if (const auto colour = parse_css_colour(value)) return colour;
  notes_.tell(node_, fmt::format("the colour {} is unknown and taken as black", quoted_value(value)));
  return CssColour{};
}

std::optional<CssColour> StyleSetter::paint(std::string_view value,
                                            const std::optional<CssColour>& inherited) {
  if (value == "none") return std::nullopt;
  if (value == "inherit") return inherited;
  if (io::same_word(value, "currentColor")) return style_.current;
  if (!value.starts_with("url(")) return colour_or_black(value);
  // A colour may stand behind the reference, for programs that cannot follow it.
  const std::size_t close = value.find(')');
  const std::string_view instead =
      close < value.size() ? trimmed_css(value.substr(close + 1)) : std::string_view();
  if (!instead.empty()) return paint(instead.starts_with("url(") ? "black" : instead, inherited);
  notes_.tell(node_, "a gradient or pattern (url) is taken as black");
  return CssColour{};
}

void StyleSetter::set_share(double& share, std::string_view value, double inherited) {
  SvgScanner scanner(value);
  const auto number = scanner.number();
  if (value == "inherit")
    share = inherited;
  else if (number)
    share = std::clamp(*number / (scanner.take('%') ? 100.0 : 1.0), 0.0, 1.0);
  else
    notes_.tell(node_, fmt::format("the opacity {} is no number and is skipped", quoted_value(value)));
}

bool StyleSetter::set_paint(std::string_view name, std::string_view value) {
  if (name == "fill")
    style_.fill = paint(value, around_.fill);
  else if (name == "stroke")
    style_.line = paint(value, around_.line);
  else
    return false;
  return true;
}

bool StyleSetter::set_number(std::string_view name, std::string_view value) {
  if (name == "fill-opacity") {
    set_share(style_.fill_opacity, value, around_.fill_opacity);
  } else if (name == "stroke-opacity") {
    set_share(style_.line_opacity, value, around_.line_opacity);
  } else if (name == "opacity") {
    set_share(own_opacity_, value, 1.0);
  } else if (name == "stroke-width") {
    const auto width = value == "inherit" ? around_.line_width : parse_svg_length(value, whole_);
    if (width && *width >= 0.0)
      style_.line_width = *width;
    else
      notes_.tell(node_, fmt::format("the stroke-width {} is no length and is skipped", quoted_value(value)));
  } else {
    return false;
  }
  return true;
}

void StyleSetter::set_rest(std::string_view name, std::string_view value) {
  if (name == "stroke-linecap" && value != "inherit") {
    style_.ends = value == "round" ? CurveEnds::Round : CurveEnds::Flat;
    if (value == "square") notes_.tell(node_, "square ends of lines are taken as flat");
  } else if (name == "visibility" && value != "inherit") {
    style_.visible = value == "visible";
  } else if (name == "vector-effect") {
    style_.is_width_fixed = value == "non-scaling-stroke";
  } else if (name == "display") {
    style_.displayed = value != "none";
  } else if (name == "fill-rule" && value != "inherit") {
    style_.rule = value == "evenodd" ? FillRule::EvenOdd : FillRule::NonZero;
  } else if (std::ranges::count(kSkippedProperties, name) > 0 && value != "none" && value != "normal") {
    notes_.tell(node_, fmt::format("{} is skipped", name));
  }
}

void StyleSetter::set(std::string_view name, std::string_view value) {
  value = trimmed_css(value);
  if (!set_paint(name, value) && !set_number(name, value)) set_rest(name, value);
}

/// The place of the semicolon that ends a declaration, which may hold others between quotes and brackets.
std::size_t end_of_declaration(std::string_view text) {
  char quote = '\0';
  bool in_brackets = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == ')') {
      in_brackets = c == '(';
    } else if (c == ';' && !in_brackets) {
      return i;
    }
  }
  return text.size();
}

/// Calls `use` with the names and values of declarations: with those that are important, or with the others.
template <typename Use>
void for_each_declaration(std::string_view text, bool is_important, const Use& use) {
  while (!text.empty()) {
    const std::string_view declaration = text.substr(0, end_of_declaration(text));
    text.remove_prefix(std::min(declaration.size() + 1, text.size()));
    const std::size_t colon = declaration.find(':');
    if (colon >= declaration.size()) continue;
    std::string_view value = trimmed_css(declaration.substr(colon + 1));
    const std::size_t mark = value.rfind('!');
    const bool is_marked =
        mark < value.size() && io::same_word(trimmed_css(value.substr(mark + 1)), "important");
    if (is_marked) value = trimmed_css(value.substr(0, mark));
    if (is_marked == is_important) use(trimmed_css(declaration.substr(0, colon)), value);
  }
}

}  // namespace

SvgStyle svg_style_of(const XmlNode& node, const SvgStyle& around,
                      std::span<const std::string_view> declarations, double whole, SvgNotes& notes) {
  SvgStyle style = around;
  style.displayed = true;
  style.is_width_fixed = false;
  StyleSetter setter(style, around, whole, node, notes);
  const std::string_view own = node.attribute("style").value();
  const auto for_each_property = [&](const auto& use) {
    for (const XmlAttribute attribute : node.attributes()) use(attribute.name(), attribute.value());
    for (const bool is_important : {false, true}) {
      for (const std::string_view some : declarations) for_each_declaration(some, is_important, use);
      for_each_declaration(own, is_important, use);
    }
  };
  // Colours may refer to this one, wherever it stands.
  for_each_property([&](std::string_view name, std::string_view value) {
    if (name != "color") return;
    if (const auto colour = parse_css_colour(trimmed_css(value))) style.current = *colour;
  });
  for_each_property([&](std::string_view name, std::string_view value) { setter.set(name, value); });
  style.opacity = around.opacity * setter.own_opacity();
  return style;
}

}  // namespace icome::drawing
