#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sketch/script/tool_arguments.h"

namespace icome::sketch {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

base::Result<DrawingEdit> taken_up(Drafting& drafting, const Arguments& arguments, Selection selection) {
  drafting.selection = arguments.flag("add") ? joined(drafting.selection, selection) : std::move(selection);
  std::size_t points = 0;
  for (const auto& [stroke, chosen] : drafting.selection)
    points += std::size_t(std::count(chosen.begin(), chosen.end(), true));
  drafting.note = fmt::format("{} control point{} of {} stroke{}", points, points == 1 ? "" : "s",
                              drafting.selection.size(), drafting.selection.size() == 1 ? "" : "s");
  return DrawingEdit();
}

base::Result<DrawingEdit> plan_lasso(Drafting& drafting, const Arguments& arguments) {
  const std::vector<Vector2> lasso = way_of(arguments, "way");
  if (lasso.size() < 3) return base::fail("'way' must have three places or more");
  const InsideRule rule = arguments.text("rule") == "even-odd" ? InsideRule::EvenOdd : InsideRule::NonZero;
  return taken_up(drafting, arguments, inside_lasso(drafting.drawing, lasso, rule));
}

base::Result<DrawingEdit> plan_rectangle(Drafting& drafting, const Arguments& arguments) {
  const auto from = place_of(arguments, "from");
  if (!from) return tl::unexpected(from.error());
  const auto to = place_of(arguments, "to");
  if (!to) return tl::unexpected(to.error());
  const Vector2 low = from->cwiseMin(*to);
  const Vector2 high = from->cwiseMax(*to);
  const Vector2 corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  return taken_up(drafting, arguments, inside_lasso(drafting.drawing, corners, InsideRule::NonZero));
}

base::Result<DrawingEdit> plan_touch(Drafting& drafting, const Arguments& arguments) {
  const std::vector<Vector2> way = way_of(arguments, "way");
  return taken_up(drafting, arguments, touched(drafting.drawing, way, length_of(arguments, "within")));
}

base::Result<DrawingEdit> plan_select_all(Drafting& drafting, const Arguments& arguments) {
  return taken_up(drafting, arguments, everything(drafting.drawing));
}

base::Result<DrawingEdit> plan_deselect(Drafting& drafting, const Arguments& /*arguments*/) {
  drafting.selection.clear();
  return DrawingEdit();
}

base::Result<DrawingEdit> transform_selected(Drafting& drafting, const Eigen::Affine2d& to_other) {
  DrawingEdit edit = transformed(drafting.drawing, drafting.selection, to_other);
  if (edit.empty()) return base::fail("nothing is selected");
  return edit;
}

base::Result<DrawingEdit> plan_move(Drafting& drafting, const Arguments& arguments) {
  const auto by = place_of(arguments, "by");
  if (!by) return tl::unexpected(by.error());
  return transform_selected(drafting, Eigen::Affine2d(Eigen::Translation2d(*by)));
}

/// The place about which something is done: as given, or the middle of what is selected.
base::Result<Vector2> centre_of(const Drafting& drafting, const Arguments& arguments) {
  if (arguments.has("about")) return place_of(arguments, "about");
  const Bounds2 box = bounds_of(drafting.drawing, drafting.selection);
  if (box.isEmpty()) return base::fail("nothing is selected");
  return Vector2(box.center());
}

Eigen::Affine2d about(const Vector2& centre, const Eigen::Matrix2d& linear) {
  return Eigen::Affine2d(Eigen::Translation2d(centre)) * Eigen::Affine2d(linear) *
         Eigen::Affine2d(Eigen::Translation2d(-centre));
}

base::Result<DrawingEdit> plan_rotate(Drafting& drafting, const Arguments& arguments) {
  const auto centre = centre_of(drafting, arguments);
  if (!centre) return tl::unexpected(centre.error());
  // Counter-clockwise as seen: y points down.
  const double angle = -arguments.number("degrees") * kDegree;
  return transform_selected(drafting, about(*centre, Eigen::Rotation2Dd(angle).toRotationMatrix()));
}

base::Result<DrawingEdit> plan_scale(Drafting& drafting, const Arguments& arguments) {
  const auto centre = centre_of(drafting, arguments);
  if (!centre) return tl::unexpected(centre.error());
  return transform_selected(drafting,
                            about(*centre, arguments.number("factor") * Eigen::Matrix2d::Identity()));
}

base::Result<DrawingEdit> plan_flip(Drafting& drafting, const Arguments& arguments) {
  const auto centre = centre_of(drafting, arguments);
  if (!centre) return tl::unexpected(centre.error());
  const bool sideways = arguments.text("way") == "left-right";
  const Eigen::Matrix2d mirror = Eigen::Vector2d(sideways ? -1.0 : 1.0, sideways ? 1.0 : -1.0).asDiagonal();
  return transform_selected(drafting, about(*centre, mirror));
}

base::Result<DrawingEdit> plan_align(Drafting& drafting, const Arguments& arguments) {
  const Bounds2 box = bounds_of(drafting.drawing, drafting.selection);
  if (box.isEmpty()) return base::fail("nothing is selected");
  const double grid = length_of(arguments, "grid");
  const double within = arguments.has("within") ? length_of(arguments, "within") : grid;
  Vector2 by;
  for (int axis = 0; axis < 2; ++axis) {
    const double at = box.min()[axis];
    by[axis] = grid * std::round(at / grid) - at;
    if (std::abs(by[axis]) > within) by[axis] = 0.0;
  }
  if (by.isZero()) {
    drafting.note = "nothing moved";
    return DrawingEdit();
  }
  return transform_selected(drafting, Eigen::Affine2d(Eigen::Translation2d(by)));
}

Parameter add_parameter() {
  return {.name = "add", .kind = ParameterKind::Flag, .meaning = "keep what is selected", .fallback = false};
}

SketchTool selecting(const char* name, const char* title, const char* summary,
                     std::vector<Parameter> parameters,
                     base::Result<DrawingEdit> (*plan)(Drafting&, const Arguments&)) {
  return {{.name = name,
           .title = title,
           .group = "Selection",
           .summary = summary,
           .parameters = std::move(parameters)},
          plan};
}

}  // namespace

std::vector<SketchTool> selection_tools() {
  const Parameter centre =
      place_parameter("about", "the place that stays (the middle of the selection)", false);
  return {
      selecting("lasso", "Lasso", "Selects the control points inside of a closed way (thesis 4.5.4).",
                {way_parameter("way", "places around them, mm"),
                 {.name = "rule",
                  .kind = ParameterKind::Choice,
                  .meaning = "what is inside where the way crosses itself",
                  .fallback = "even-odd",
                  .choices = {"even-odd", "non-zero"}},
                 add_parameter()},
                plan_lasso),
      selecting("rectangle", "Rectangle", "Selects the control points inside of a rectangle.",
                {place_parameter("from", "a corner", true), place_parameter("to", "the opposite one", true),
                 add_parameter()},
                plan_rectangle),
      selecting("touch", "Select by touching", "Selects whole strokes that a way touches.",
                {way_parameter("way", "places on them, mm"),
                 length_parameter("within", "beside the line", 1.0, 0.001, 1000.0), add_parameter()},
                plan_touch),
      selecting("select-all", "Select all", "Selects all that is not hidden or locked.", {add_parameter()},
                plan_select_all),
      selecting("deselect", "Deselect", "Selects nothing.", {}, plan_deselect),
      selecting("move", "Move", "Moves what is selected.", {place_parameter("by", "how far", true)},
                plan_move),
      selecting(
          "rotate", "Rotate", "Turns what is selected, counter-clockwise as it is seen.",
          {{.name = "degrees", .meaning = "how far", .required = true, .least = -3600.0, .most = 3600.0},
           centre},
          plan_rotate),
      selecting(
          "scale", "Scale", "Makes what is selected larger or smaller.",
          {{.name = "factor", .meaning = "2 is twice as large", .required = true, .least = 1e-6, .most = 1e6},
           centre},
          plan_scale),
      selecting("flip", "Flip", "Mirrors what is selected.",
                {{.name = "way",
                  .kind = ParameterKind::Choice,
                  .meaning = "which sides change places",
                  .fallback = "left-right",
                  .choices = {"left-right", "up-down"}},
                 centre},
                plan_flip),
      selecting("align", "Align", "Moves the upper left corner of what is selected to a grid.",
                {length_parameter("grid", "from line to line", 5.0, 0.001, 1e5),
                 {.name = "within",
                  .meaning = "only if it is no farther, mm (the grid)",
                  .least = 0.0,
                  .most = 1e5}},
                plan_align)};
}

}  // namespace icome::sketch
