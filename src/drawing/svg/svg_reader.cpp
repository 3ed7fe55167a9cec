#include "drawing/svg/svg_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>

#include "base/shown_text.h"
#include "drawing/drawing_edit.h"
#include "drawing/outline/filled_loops.h"
#include "drawing/svg/svg_frame.h"
#include "drawing/svg/svg_names.h"
#include "drawing/svg/svg_notes.h"
#include "drawing/svg/svg_own.h"
#include "drawing/svg/svg_repaint.h"
#include "drawing/svg/svg_shapes.h"
#include "drawing/svg/svg_sheet.h"
#include "drawing/svg/svg_style.h"
#include "drawing/svg/svg_writer.h"
#include "drawing/svg/xml_text.h"
#include "io/file_bytes.h"
#include "io/text_scanner.h"

namespace icome::drawing {
namespace {

constexpr int kDeepestSvg = 200;                     // elements within one another, through <use> too
constexpr int kMostUsesWithin = 32;                  // <use> that shows <use> and so on
constexpr std::size_t kMostSvgElements = 2'000'000;  // drawn, through <use> too
constexpr std::size_t kMostSvgBytes = 128U << 20U;   // of attributes, likewise
constexpr std::size_t kBytesForALook = 32;           // at a rule of a style sheet: the time that it costs
constexpr std::size_t kMostSvgSegments = 10'000'000;
constexpr double kSameSize = 1e-6;  // relative: programs round it
constexpr double kMmOfMetre = 1e3;
constexpr double kEvenScale = 1e-3;  // relative difference of the scales that widths do not show

/// Elements that say nothing about lines, or are looked at where something refers to them.
constexpr std::array<std::string_view, 15> kSilentElements = {
    "defs",           "title",   "desc", "metadata", "symbol", "marker", "clipPath", "linearGradient",
    "radialGradient", "pattern", "mask", "filter",   "view",   "script", "style"};
constexpr double kStraightFill = 1e-5;  // m, by which fills of crossing lines may be off

/// The state that holds for the elements in one place of the file.
struct SvgContext {
  Eigen::Affine2d root_from_user = Eigen::Affine2d::Identity();  ///< root: the units within the outer <svg>
  SvgStyle style;
  Vector2 whole = Vector2::Zero();  ///< what percent are of, user units
  int depth = 0;
};

class SvgReader {
 public:
  explicit SvgReader(const XmlText& xml) : xml_(xml), notes_(xml) {}

  base::Result<DrawingRead> read();

 private:
  using Done = base::Result<void>;

  void index();
  bool is_svg_name(const XmlNode& node) const;
  std::string_view reference_of(const XmlNode& use) const;
  std::string layer_name_of(const XmlNode& group) const;
  bool is_locked(const XmlNode& group) const;
  bool is_marked_layer(const XmlNode& group) const;
  void read_root_frame(SvgContext& context);
  Done read_top(const XmlNode& node, const SvgContext& root);
  Done read_layer(const XmlNode& group, const SvgContext& root);
  Done read_element(const XmlNode& node, const SvgContext& around, bool is_layer = false);
  Done read_inside(const XmlNode& node, const SvgContext& context);
  Done read_switch(const XmlNode& node, const SvgContext& context);
  Done read_use(const XmlNode& node, SvgContext context);
  Done read_shown(const XmlNode& use, const XmlNode& shown, SvgContext context);
  Done read_nested(const XmlNode& node, SvgContext context, const Vector2& size);
  SvgViewport viewport_of(const XmlNode& node, const Vector2& size);
  Done read_shape(const XmlNode& node, const SvgContext& context);
  bool is_only_shown(const XmlNode& node) const;
  XmlNode fill_below(const XmlNode& path) const;
  bool counts_by_itself(const XmlNode& shown);
  std::optional<Stroke> own_stroke_in(const XmlNode& path, const SvgStyle& seen);
  void repaint_own(const XmlNode& path, const SvgContext& context, Stroke& stroke);
  Done read_own(const XmlNode& node, Stroke stroke, const SvgContext& context);
  Done charge(const XmlNode& node);
  bool enter(const XmlNode& node, const SvgContext& around, SvgContext& context);
  SvgStyle style_of(const XmlNode& node, const SvgContext& around, SvgNotes& notes);
  Done add_stroke(const XmlNode& node, Stroke stroke, bool has_fill, const SvgContext& context);
  Done add_filled(const XmlNode& node, const std::vector<Curve>& lines, const SvgContext& context);
  Done add(const XmlNode& node, Stroke stroke);
  void begin_layer(std::string name, bool is_loose);
  bool is_skipped(const XmlNode& node);
  double line_width(const SvgContext& context) const;
  void tell_group_opacity(const XmlNode& group);
  void tell_uneven_scale(const XmlNode& node, const SvgContext& context);

  const XmlText& xml_;
  SvgNotes notes_;
  SvgSheet sheet_;
  Drawing drawing_;
  std::unordered_map<std::string_view, XmlNode> ids_;
  Eigen::Affine2d metres_from_root_ = Eigen::Affine2d::Identity();
  Eigen::Affine2d root_from_own_ =
      Eigen::Affine2d::Identity();  // own: m on the paper as the project wrote it
  std::vector<XmlNode> shown_;      // by <use>, the outermost first
  bool is_loose_layer_ = false;     // the last layer takes what lies outside of groups
  std::size_t loose_layers_ = 0;
  std::size_t elements_ = 0, bytes_ = 0, segments_ = 0;
};

/// Does the element hold the other one, or is it that?
bool is_around(const XmlNode& outer, XmlNode node) {
  while (node && node != outer) node = node.parent();
  return bool(node);
}

/// A straight line has nothing within it to be filled.
bool encloses_nothing(const Curve& curve) {
  constexpr double kStraight = 1e-12;  // of its length: rounding of transforms
  if (curve.segments.size() > 1) return false;
  const CubicBezier& only = curve.segments.front();
  const Vector2 way = only.points[3] - only.points[0];
  const auto beside = [&](const Vector2& point) {
    const Vector2 away = point - only.points[0];
    return std::abs(away.x() * way.y() - away.y() * way.x());
  };
  return std::max(beside(only.points[1]), beside(only.points[2])) <= kStraight * way.squaredNorm() &&
         way.squaredNorm() > 0.0;
}

/// Finds the elements that others refer to, and the style sheets.
void SvgReader::index() {
  for_each_element(xml_.root(), [&](const XmlNode& node) {
    if (const XmlAttribute id = node.attribute("id")) ids_.emplace(id.value(), node);
    if (local_name(node.name()) == "style" && is_svg_name(node)) sheet_.add(node, notes_);
  });
}

/// Does the name belong to SVG, which is the namespace of the outermost element, whatever that says?
bool SvgReader::is_svg_name(const XmlNode& node) const {
  return xml_.namespace_of(node.name()) == xml_.namespace_of(xml_.root().name());
}

std::string_view SvgReader::reference_of(const XmlNode& use) const {
  for (const char* const name : {"href", "xlink:href"})
    if (const XmlAttribute reference = use.attribute(name)) return reference.value();
  return xml_.attribute_of(use, kXlinkNamespace, "href").value();
}

/// The name of a layer: Inkscape's, which ours has as well unless it was changed there; ours, the id; empty
/// where there is none.
std::string SvgReader::layer_name_of(const XmlNode& group) const {
  if (const auto label = xml_.attribute_of(group, kInkscapeNamespace, "label")) return label.value();
  if (const auto own = xml_.attribute_of(group, kSketchNamespace, kLayerAttribute)) return own.value();
  return group.attribute("id").value();
}

/// Inkscape takes the attribute away from what is no longer locked, so that it counts wherever it is written.
bool SvgReader::is_locked(const XmlNode& group) const {
  if (!xml_.declares(kSodipodiNamespace)) return own_flag_of(xml_, group, kLockedAttribute);
  const XmlAttribute insensitive = xml_.attribute_of(group, kSodipodiNamespace, "insensitive");
  return insensitive.value() == std::string_view("true");
}

/// Is the group a layer also where it is empty?
bool SvgReader::is_marked_layer(const XmlNode& group) const {
  if (xml_.attribute_of(group, kSketchNamespace, kLayerAttribute)) return true;
  return xml_.attribute_of(group, kInkscapeNamespace, "groupmode").value() == std::string_view("layer");
}

void SvgReader::begin_layer(std::string name, bool is_loose) {
  Layer layer;
  layer.id = drawing_.next_layer_id();
  layer.name = std::move(name);
  drawing_.layers.push_back(std::move(layer));
  is_loose_layer_ = is_loose;
}

/// Counts what is looked at, so that <use> of <use> of much ends.
SvgReader::Done SvgReader::charge(const XmlNode& node) {
  for (const XmlAttribute attribute : node.attributes())
    bytes_ += 1 + std::string_view(attribute.value()).size();
  if (++elements_ <= kMostSvgElements && bytes_ <= kMostSvgBytes) return {};
  return xml_.fail_at(node,
                      fmt::format("more than {} elements or {} MiB are to be drawn; the <use> of the file "
                                  "may multiply one another",
                                  kMostSvgElements, kMostSvgBytes >> 20U));
}

SvgStyle SvgReader::style_of(const XmlNode& node, const SvgContext& around, SvgNotes& notes) {
  std::size_t looks = 0;
  const std::vector<std::string_view> declarations = sheet_.declarations_of(node, looks);
  bytes_ += kBytesForALook * looks;
  for (const std::string_view some : declarations) bytes_ += some.size();
  return svg_style_of(node, around.style, declarations, around.whole.norm() / std::sqrt(2.0), notes);
}

/// Takes the step from an element's surroundings into it; false where it cannot be drawn.
bool SvgReader::enter(const XmlNode& node, const SvgContext& around, SvgContext& context) {
  context = around;
  if (++context.depth > kDeepestSvg) {
    notes_.tell(node, fmt::format("what lies more than {} elements deep is skipped", kDeepestSvg));
    return false;
  }
  context.style = style_of(node, around, notes_);
  const XmlAttribute transform = node.attribute("transform");
  if (!transform) return true;
  const auto parsed = parse_svg_transform(transform.value());
  if (!parsed) notes_.tell(node, parsed.error().message + ": it is left out");
  if (parsed) context.root_from_user = around.root_from_user * *parsed;
  if (context.root_from_user.matrix().allFinite()) return true;
  notes_.tell(node, "an element whose transforms have numbers that are too large is skipped");
  return false;
}

SvgReader::Done SvgReader::add(const XmlNode& node, Stroke stroke) {
  for (const CubicBezier& segment : stroke.curve.segments)
    for (const Vector2& point : segment.points)
      if (!(point.cwiseAbs().maxCoeff() <= kLargestDrawing)) {
        notes_.tell(node,
                    fmt::format("a line that reaches farther than {:g} m from the paper's corner is skipped",
                                kLargestDrawing));
        return {};
      }
  segments_ += stroke.curve.segments.size();
  if (segments_ > kMostSvgSegments)
    return xml_.fail_at(node, fmt::format("the drawing has more than {} segments", kMostSvgSegments));
  stroke.id = drawing_.next_stroke_id();
  drawing_.layers.back().strokes.push_back(std::make_shared<const Stroke>(std::move(stroke)));
  return {};
}

/// The width of a line in m.
double SvgReader::line_width(const SvgContext& context) const {
  if (context.style.is_width_fixed) return context.style.line_width * kMetresOfSvgUnit;
  return context.style.line_width *
         std::sqrt(std::abs((metres_from_root_ * context.root_from_user).linear().determinant()));
}

void SvgReader::tell_uneven_scale(const XmlNode& node, const SvgContext& context) {
  if (context.style.is_width_fixed) return;
  const Eigen::Matrix2d linear = (metres_from_root_ * context.root_from_user).linear();
  const double one = linear.col(0).norm(), other = linear.col(1).norm();
  const double turned = std::abs(linear.col(0).dot(linear.col(1)));
  if (std::abs(one - other) > kEvenScale * one || turned > kEvenScale * one * other)
    notes_.tell(node, "the width of an unevenly scaled line is taken as its mean");
}

/// Adds a curve with the line of the context and perhaps its fill.
SvgReader::Done SvgReader::add_stroke(const XmlNode& node, Stroke stroke, bool has_fill,
                                      const SvgContext& context) {
  const SvgStyle& style = context.style;
  const bool has_line = style.line && style.line_width > 0.0;
  const double line_opacity = has_line ? style.opacity * style.line_opacity * style.line->alpha : 0.0;
  const double fill_opacity = has_fill ? style.opacity * style.fill_opacity * style.fill->alpha : 0.0;
  stroke.ends = style.ends;
  if (has_fill) {
    stroke.fill = style.fill->colour;
    stroke.colour = style.fill->colour;
    stroke.opacity = fill_opacity;
  }
  if (!has_line) return has_fill ? add(node, std::move(stroke)) : Done{};
  if (has_fill && fill_opacity != line_opacity) {
    // One stroke has one opacity: the fill lies below as a stroke of its own.
    if (const auto added = add(node, stroke); !added) return added;
    stroke.fill.reset();
  }
  tell_uneven_scale(node, context);
  const double width = line_width(context);
  if (!std::isfinite(width) || width > kLargestDrawing) {
    notes_.tell(node, fmt::format("a line that is wider than {:g} m is skipped", kLargestDrawing));
    return {};
  }
  stroke.curve.widths = {{0.0, width, stroke.curve.end(), width}};
  stroke.colour = style.line->colour;
  stroke.opacity = line_opacity;
  return add(node, std::move(stroke));
}

/// Adds all lines of an element and what they enclose together: lines that lie apart with a fill of their own
/// each, others above a stroke that is their fill.
SvgReader::Done SvgReader::add_filled(const XmlNode& node, const std::vector<Curve>& lines,
                                      const SvgContext& context) {
  const SvgStyle& style = context.style;
  const double beside = style.line && style.line_width > 0.0 ? 0.5 * line_width(context) : 0.0;
  for (FilledLoops& filled : filled_loops(lines, style.rule, beside, kStraightFill)) {
    if (filled.likeness == FillLikeness::StraightPieces)
      notes_.tell(node, "the area that crossing lines enclose by fill-rule evenodd has straight edges");
    if (filled.likeness == FillLikeness::NonZeroInstead)
      notes_.tell(node, "fill-rule evenodd of very many lines is taken as nonzero");
    const Curve& first = lines[filled.members.front()];
    const bool is_alone = filled.members.size() == 1 && filled.likeness != FillLikeness::StraightPieces;
    if (!is_alone && !filled.curve.segments.empty()) {
      Stroke area;
      area.curve = std::move(filled.curve);
      area.colour = style.fill->colour;
      area.fill = style.fill->colour;
      area.opacity = style.opacity * style.fill_opacity * style.fill->alpha;
      area.ends = style.ends;
      if (const auto added = add(node, std::move(area)); !added) return added;
    }
    for (const std::size_t i : filled.members) {
      Stroke stroke;
      stroke.curve = lines[i];
      const bool has_fill = is_alone && !encloses_nothing(first);
      if (const auto added = add_stroke(node, std::move(stroke), has_fill, context); !added) return added;
    }
  }
  return {};
}

/// Is the transform none but for the rounding of frames?
bool is_at_rest(const Eigen::Affine2d& transform, double size) {
  constexpr double kFrameRounding = 1e-9;
  return (transform.linear() - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() <= kFrameRounding &&
         transform.translation().cwiseAbs().maxCoeff() <= kFrameRounding * std::max(1.0, size);
}

/// The path with a stroke's fill that the project writes below its outline; none where there is none.
XmlNode SvgReader::fill_below(const XmlNode& path) const {
  const XmlNode before = path.element_before();
  return before && is_only_shown(before) ? before : XmlNode();
}

/// A fill that is only shown counts after all where another program has changed more of it than its colour,
/// or has taken away the stroke that it belongs to.
bool SvgReader::counts_by_itself(const XmlNode& shown) {
  if (!has_drawn_mark(xml_, shown)) return false;
  const XmlNode above = shown.element_after();
  const auto own = above ? own_stroke_of(xml_, above) : base::Result<std::optional<Stroke>>(std::nullopt);
  if (!own || !*own) return true;
  SvgNotes unheard(xml_);
  const SvgStyle style = style_of(shown, SvgContext{}, unheard);
  const double opacity = style.opacity * style.fill_opacity * (style.fill ? style.fill->alpha : 1.0);
  constexpr double kOpaque = 0.997;  // programs store it in 8 bits
  const bool is_redrawn = was_redrawn(xml_, shown) && !is_drawn_by(**own, shown.attribute("d").value());
  return is_redrawn || shown.attribute("transform") || style.line || !style.visible || !style.displayed ||
         opacity < kOpaque;
}

void SvgReader::repaint_own(const XmlNode& path, const SvgContext& context, Stroke& stroke) {
  if (!has_drawn_mark(xml_, path)) return;
  XmlNode below = fill_below(path);
  if (below && counts_by_itself(below)) {
    stroke.fill.reset();
    below = XmlNode();
  }
  SvgStyle fill;
  if (below) fill = style_of(below, context, notes_);
  for (const std::string& change : take_repaint(context.style, below ? &fill : nullptr, stroke))
    notes_.tell(path, "another program has changed " + change + " of a stroke of ICOME, which is taken");
}

SvgReader::Done SvgReader::read_own(const XmlNode& node, Stroke stroke, const SvgContext& context) {
  repaint_own(node, context, stroke);
  const Eigen::Affine2d moved = metres_from_root_ * context.root_from_user * root_from_own_;
  if (is_at_rest(moved, drawing_.size.maxCoeff())) return add(node, std::move(stroke));
  notes_.tell(node, "a stroke of ICOME was moved by another program");
  stroke.curve = transformed(stroke.curve, moved);
  return add(node, std::move(stroke));
}

/// A stroke without a line is written as a path that draws its fill or nothing.
bool has_lost_widths(const Stroke& own, const SvgStyle& seen, const XmlNode& path) {
  if (!own.curve.widths.empty()) return false;
  return seen.line || (seen.fill && !own.fill && path.attribute("d").value() != std::string_view());
}

/// Has another program made it invisible?
bool has_lost_paint(const Stroke& own, const SvgStyle& seen) {
  constexpr double kInvisible = 1e-8;  // m, what a width in the file may be rounded to nothing from
  return !seen.line && !seen.fill && (own.fill || own.curve.widest() > kInvisible);
}

bool is_dot(const SvgSubpath& subpath) {
  const Vector2& place = subpath.segments.front().points[0];
  return std::ranges::all_of(subpath.segments, [&](const CubicBezier& segment) {
    return std::ranges::all_of(segment.points, [&](const Vector2& point) { return point == place; });
  });
}

/// The stroke that the project wrote into a path, if that counts: tells why it does not, unless the path
/// shows nothing any more, which is told as that of any other shape.
std::optional<Stroke> SvgReader::own_stroke_in(const XmlNode& path, const SvgStyle& seen) {
  auto own = own_stroke_of(xml_, path);
  if (was_redrawn(xml_, path) && !(own && *own && is_drawn_by(**own, path.attribute("d").value()))) {
    notes_.tell(path, "a stroke of ICOME was drawn anew by another program: its outline is taken");
    return std::nullopt;
  }
  if (own && !*own && has_drawn_mark(xml_, path))
    own = base::fail("icome:curve of a stroke of ICOME is missing");
  if (own && *own && has_drawn_mark(xml_, path)) {
    if (!seen.visible || has_lost_paint(**own, seen)) return std::nullopt;
    if (has_lost_widths(**own, seen, path))
      own = base::fail("icome:widths is empty, but the path draws a line");
  }
  if (own) return std::move(*own);
  notes_.tell(path, own.error().message + ": what the path draws is taken");
  return std::nullopt;
}

SvgReader::Done SvgReader::read_shape(const XmlNode& node, const SvgContext& context) {
  if (is_only_shown(node))
    notes_.tell(node, "what another program has changed of a fill of ICOME is taken as an area of its own");
  else if (auto own = own_stroke_in(node, context.style))
    return read_own(node, std::move(*own), context);
  if (!context.style.visible) {
    notes_.tell(node, "a hidden element is skipped");
    return {};
  }
  if (!context.style.line && !context.style.fill) {
    notes_.tell(node, "a shape without line and fill is skipped");
    return {};
  }
  SvgShape shape = svg_shape_of(node, context.whole);
  if (!shape.fault.empty()) notes_.tell(node, shape.fault);
  std::vector<Curve> lines;
  const bool has_round_line = context.style.line && context.style.ends == CurveEnds::Round;
  for (SvgSubpath& subpath : shape.subpaths) {
    // Only round ends make a dot of a line without length (SVG 2, 11.4).
    if (!has_round_line && is_dot(subpath)) continue;
    Curve line;
    line.segments = std::move(subpath.segments);
    line.closed = subpath.closed;
    lines.push_back(transformed(line, metres_from_root_ * context.root_from_user));
  }
  if (context.style.fill) return add_filled(node, lines, context);
  for (Curve& line : lines) {
    Stroke stroke;
    stroke.curve = std::move(line);
    if (const auto added = add_stroke(node, std::move(stroke), false, context); !added) return added;
  }
  return {};
}

/// The frame by a node's viewBox; one that is none is left out.
SvgViewport SvgReader::viewport_of(const XmlNode& node, const Vector2& size) {
  auto viewport = svg_viewport(node, size);
  if (viewport) return *viewport;
  notes_.tell(node, viewport.error().message + ": it is left out");
  return {size};
}

/// An <svg> or <symbol> within the file, which has that size in the units around it.
SvgReader::Done SvgReader::read_nested(const XmlNode& node, SvgContext context, const Vector2& size) {
  if (!(size.minCoeff() > 0.0)) return {};
  const SvgViewport viewport = viewport_of(node, size);
  context.root_from_user = context.root_from_user * viewport.outer_from_inner;
  context.whole = viewport.size;
  return read_inside(node, context);
}

SvgReader::Done SvgReader::read_use(const XmlNode& node, SvgContext context) {
  const std::string_view reference = reference_of(node);
  const auto found = reference.starts_with('#') ? ids_.find(reference.substr(1)) : ids_.end();
  if (found == ids_.end()) {
    notes_.tell(node, "<use> of what is not in the file is skipped");
    return {};
  }
  const XmlNode shown = found->second;
  if (is_around(shown, node) || std::ranges::count(shown_, shown) > 0 || shown_.size() == kMostUsesWithin) {
    notes_.tell(node, fmt::format("<use> that shows itself, or lies more than {} deep in others, is skipped",
                                  kMostUsesWithin));
    return {};
  }
  shown_.push_back(shown);
  const auto read = read_shown(node, shown, std::move(context));
  shown_.pop_back();
  return read;
}

SvgReader::Done SvgReader::read_shown(const XmlNode& use, const XmlNode& shown, SvgContext context) {
  const auto length = [&](const char* name, double whole, double otherwise) {
    const XmlAttribute attribute = use.attribute(name);
    return attribute ? parse_svg_length(attribute.value(), whole).value_or(otherwise) : otherwise;
  };
  const Vector2 corner(length("x", context.whole.x(), 0.0), length("y", context.whole.y(), 0.0));
  context.root_from_user = context.root_from_user * Eigen::Translation2d(corner);
  if (local_name(shown.name()) != "symbol") return read_element(shown, context);
  SvgContext within;
  if (!enter(shown, context, within)) return {};
  const Vector2 size(length("width", context.whole.x(), context.whole.x()),
                     length("height", context.whole.y(), context.whole.y()));
  return read_nested(shown, within, size);
}

/// Only the first child of a <switch> is shown.
SvgReader::Done SvgReader::read_switch(const XmlNode& node, const SvgContext& context) {
  for (const XmlNode child : node.children())
    if (child.is_element() && is_svg_name(child)) return read_element(child, context);
  return {};
}

SvgReader::Done SvgReader::read_inside(const XmlNode& node, const SvgContext& context) {
  for (const XmlNode child : node.children())
    if (const auto read = read_element(child, context); !read) return read;
  return {};
}

bool SvgReader::is_only_shown(const XmlNode& node) const {
  return xml_.attribute_of(node, kSketchNamespace, kShownAttribute).value() == std::string_view("only");
}

/// Is it nothing that is drawn? Tells what people would miss.
bool SvgReader::is_skipped(const XmlNode& node) {
  if (!node.is_element() || !is_svg_name(node)) return true;
  if (is_only_shown(node) && !counts_by_itself(node)) return true;
  const std::string_view name = local_name(node.name());
  if (std::ranges::count(kSilentElements, name) > 0) return true;
  constexpr std::array<std::string_view, 5> kContainers = {"g", "a", "svg", "use", "switch"};
  if (is_svg_shape(name) || std::ranges::count(kContainers, name) > 0) return false;
  notes_.tell(node, fmt::format("<{}> is skipped", base::shown_text(name)));
  return true;
}

/// A translucent group is seen as one, which lines of a drawing are not.
void SvgReader::tell_group_opacity(const XmlNode& group) {
  std::size_t shown = 0;
  for (const XmlNode child : group.children()) {
    if (is_only_shown(child)) return;
    shown += child.is_element() ? 1 : 0;
  }
  if (shown > 1)
    notes_.tell(group, "the opacity of a group is that of each of its lines, which show through one another");
}

SvgReader::Done SvgReader::read_element(const XmlNode& node, const SvgContext& around, bool is_layer) {
  if (const auto charged = charge(node); !charged) return charged;
  if (is_skipped(node)) return {};
  SvgContext context;
  if (!enter(node, around, context)) return {};
  if (!context.style.displayed && !is_layer) {
    notes_.tell(node, "a hidden element is skipped");
    return {};
  }
  const std::string_view name = local_name(node.name());
  if (is_svg_shape(name)) return read_shape(node, context);
  if (name == "use") return read_use(node, std::move(context));
  if (name == "switch") return read_switch(node, context);
  if (name == "g" && context.style.opacity < around.style.opacity) tell_group_opacity(node);
  if (name != "svg") return read_inside(node, context);
  const auto length = [&](const char* side, double whole, double otherwise) {
    return parse_svg_length(node.attribute(side).value(), whole).value_or(otherwise);
  };
  const Vector2 whole = context.whole;
  const Vector2 corner(length("x", whole.x(), 0.0), length("y", whole.y(), 0.0));
  context.root_from_user = context.root_from_user * Eigen::Translation2d(corner);
  return read_nested(node, context,
                     {length("width", whole.x(), whole.x()), length("height", whole.y(), whole.y())});
}

SvgReader::Done SvgReader::read_layer(const XmlNode& group, const SvgContext& root) {
  std::string name = layer_name_of(group);
  const bool is_own = bool(xml_.attribute_of(group, kSketchNamespace, kLayerAttribute));
  if (name.empty() && !is_own) name = fmt::format("Layer {}", drawing_.layers.size() + 1);
  const bool was_loose = is_loose_layer_;
  begin_layer(std::move(name), false);
  SvgNotes unheard(xml_);
  const std::size_t index = drawing_.layers.size() - 1;
  drawing_.layers[index].visible = style_of(group, root, unheard).displayed;
  drawing_.layers[index].locked = is_locked(group);
  if (const auto read = read_element(group, root, true); !read) return read;
  if (!drawing_.layers[index].strokes.empty() || is_marked_layer(group)) return {};
  drawing_.layers.pop_back();
  is_loose_layer_ = was_loose;
  return {};
}

SvgReader::Done SvgReader::read_top(const XmlNode& node, const SvgContext& root) {
  if (is_skipped(node)) return {};
  if (local_name(node.name()) == "g") return read_layer(node, root);
  const bool has_room = is_loose_layer_ && !drawing_.layers.empty();
  if (!has_room) begin_layer(fmt::format("Layer {}", ++loose_layers_), true);
  if (const auto read = read_element(node, root); !read) return read;
  if (has_room || !drawing_.layers.back().strokes.empty()) return {};
  drawing_.layers.pop_back();
  --loose_layers_;
  is_loose_layer_ = false;
  return {};
}

bool is_absolute_length(std::string_view text) {
  return parse_svg_length(text, 0.0).has_value() && text.find('%') == std::string_view::npos;
}

/// Paper and units: width, height and viewBox of the outermost element.
void SvgReader::read_root_frame(SvgContext& context) {
  const XmlNode root = xml_.root();
  const Vector2 paper = drawing_.size / kMetresOfSvgUnit;  // where the file tells none
  const Vector2 whole = svg_view_box_size(root).value_or(paper);
  const auto is_length = [](double units) {
    return units > 0.0 && units * kMetresOfSvgUnit <= kLargestDrawing;
  };
  Vector2 size = whole.unaryExpr(is_length).all() ? whole : paper;
  bool has_frame = !root.attribute("viewBox") || svg_view_box_size(root);
  for (int i = 0; i < 2; ++i) {
    const XmlAttribute side = root.attribute(i == 0 ? "width" : "height");
    has_frame = has_frame && is_absolute_length(side.value());
    if (!side || std::string_view(side.value()) == "auto") continue;
    const auto length = parse_svg_length(side.value(), whole[i]);
    if (length && is_length(*length))
      size[i] = *length;
    else
      notes_.tell(
          root,
          fmt::format("the {} {} is no length in a unit of SVG above 0 and up to {:g} m, and is left out",
                      side.name(), quoted_value(side.value()), kLargestDrawing));
  }
  const SvgViewport viewport = viewport_of(root, size);
  metres_from_root_ = Eigen::Scaling(kMetresOfSvgUnit) * viewport.outer_from_inner;
  context.whole = viewport.size;
  drawing_.size = size * kMetresOfSvgUnit;
  // Without a frame of its own the file does not say that anybody has changed ours.
  root_from_own_ = has_frame ? Eigen::Affine2d(Eigen::Scaling(kMmOfMetre)) : metres_from_root_.inverse();
  const auto own_size = own_size_of(xml_);
  if (!own_size) return;
  const double apart = (drawing_.size - *own_size).cwiseQuotient(*own_size).cwiseAbs().maxCoeff();
  if (has_frame && apart > kSameSize)
    notes_.tell(root, "another program has changed the paper's size, which is taken");
  else
    drawing_.size = *own_size;
}

base::Result<DrawingRead> SvgReader::read() {
  const XmlNode root = xml_.root();
  if (local_name(root.name()) != "svg")
    return xml_.fail_at(
        root, fmt::format("it is no SVG, which begins with <svg>, but <{}>", base::shown_text(root.name())));
  index();
  SvgContext outside, context;
  read_root_frame(outside);
  if (enter(root, outside, context))
    for (const XmlNode node : root.children())
      if (const auto read = read_top(node, context); !read) return tl::unexpected(read.error());
  return DrawingRead{std::move(drawing_), notes_.lines()};
}

}  // namespace

base::Result<DrawingRead> read_svg_text(std::string_view text, const std::string& name) {
  XmlText xml;
  if (const auto loaded = xml.load(text, name); !loaded) return tl::unexpected(loaded.error());
  return SvgReader(xml).read();
}

base::Result<DrawingRead> read_svg_drawing(const std::filesystem::path& file) {
  const auto bytes = io::read_bytes(file, kLargestSvg);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_svg_text(*bytes, file.string());
}

}  // namespace icome::drawing
