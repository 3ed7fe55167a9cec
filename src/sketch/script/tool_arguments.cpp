#include "sketch/script/tool_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace icome::sketch {

Parameter place_parameter(const char* name, const char* meaning, bool required) {
  return {.name = name,
          .kind = ParameterKind::Numbers,
          .meaning = std::string(meaning) + ": x and y, mm",
          .required = required,
          .least = -kFarthestOnPaper,
          .most = kFarthestOnPaper};
}

Parameter way_parameter(const char* name, const char* meaning, std::size_t components) {
  return {.name = name,
          .kind = ParameterKind::Points,
          .meaning = meaning,
          .required = true,
          .least = -kFarthestOnPaper,
          .most = kFarthestOnPaper,
          .components = components};
}

Parameter length_parameter(const char* name, const char* meaning, double fallback, double least,
                           double most) {
  return {.name = name,
          .meaning = std::string(meaning) + ", mm",
          .fallback = fallback,
          .least = least,
          .most = most};
}

std::vector<Parameter> stroke_parameters() {
  return {{.name = "stroke",
           .kind = ParameterKind::Count,
           .meaning = "the number of the stroke, as icome sketch list tells it",
           .least = 1},
          place_parameter("at", "a place on it, or near the one that is meant", false)};
}

base::Result<Vector2> place_of(const Arguments& arguments, std::string_view name) {
  const std::vector<double> numbers = arguments.numbers(name);
  if (numbers.size() != 2)
    return base::fail(fmt::format("'{}' must be a place of two numbers, not of {}", name, numbers.size()));
  return Vector2(numbers[0] * kMillimetre, numbers[1] * kMillimetre);
}

std::vector<Vector2> way_of(const Arguments& arguments, std::string_view name) {
  std::vector<Vector2> way = arguments.points2(name);
  for (Vector2& place : way) place *= kMillimetre;
  return way;
}

double length_of(const Arguments& arguments, std::string_view name) {
  return arguments.number(name) * kMillimetre;
}

base::Result<StrokePointer> stroke_numbered(const Drafting& drafting, std::uint64_t number) {
  for (const Layer& layer : drafting.drawing.layers) {
    for (const StrokePointer& stroke : layer.strokes) {
      if (stroke->id.value != number) continue;
      if (!can_change(layer))
        return base::fail(fmt::format("stroke {} is on layer \"{}\", which is {}", number, layer.name,
                                      layer.locked ? "locked" : "hidden"));
      return stroke;
    }
  }
  return base::fail(fmt::format("there is no stroke {}", number));
}

base::Result<PickedStroke> picked_stroke(const Drafting& drafting, const Arguments& arguments) {
  if (!arguments.has("at")) {
    if (!arguments.has("stroke")) return base::fail("give 'stroke', 'at' or both");
    auto stroke = stroke_numbered(drafting, std::uint64_t(arguments.count("stroke")));
    if (!stroke) return tl::unexpected(stroke.error());
    return PickedStroke{*stroke, 0.0, (*stroke)->curve.at(0.0)};
  }
  const auto at = place_of(arguments, "at");
  if (!at) return tl::unexpected(at.error());
  std::uint64_t number = 0;
  if (arguments.has("stroke")) {
    number = std::uint64_t(arguments.count("stroke"));
  } else {
    const auto pick = StrokeIndex(drafting.drawing).nearest(*at, kNearby);
    if (!pick)
      return base::fail(
          fmt::format("no stroke that may be changed is within {:g} mm of 'at'", kNearby / kMillimetre));
    number = pick->stroke.value;
  }
  auto stroke = stroke_numbered(drafting, number);
  if (!stroke) return tl::unexpected(stroke.error());
  const geometry::CurveIndex index((*stroke)->curve.segments);
  geometry::CurveIndex::Nearest found;
  index.nearest(*at, std::numeric_limits<double>::infinity(), found);
  return PickedStroke{*stroke, double(found.curve) + found.on_curve.t, *at};
}

DrawingEdit with_curve(const Stroke& stroke, Curve curve) {
  auto changed = std::make_shared<Stroke>(stroke);
  changed->curve = std::move(curve);
  return edit_of(ReplaceStroke{std::move(changed)});
}

base::Result<std::vector<StrokePointer>> meant_strokes(const Drafting& drafting, const Arguments& arguments) {
  std::vector<StrokePointer> strokes;
  if (arguments.has("stroke") || arguments.has("at")) {
    auto picked = picked_stroke(drafting, arguments);
    if (!picked) return tl::unexpected(picked.error());
    strokes.push_back(picked->stroke);
    return strokes;
  }
  for (const auto& [id, points] : drafting.selection) {
    // Strokes that were hidden, locked or deleted since they were chosen are left alone.
    if (auto stroke = stroke_numbered(drafting, id.value)) strokes.push_back(*stroke);
  }
  if (strokes.empty()) return base::fail("nothing is selected; give 'stroke' or 'at', or select first");
  return strokes;
}

base::Result<const Layer*> layer_named(const Drawing& drawing, const std::string& name) {
  std::string names;
  for (const Layer& layer : drawing.layers) {
    if (layer.name == name || fmt::format("#{}", layer.id.value) == name) return &layer;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", layer.name);
  }
  return base::fail(fmt::format("there is no layer \"{}\"; there {} {}", name,
                                drawing.layers.size() == 1 ? "is" : "are", names.empty() ? "none" : names));
}

}  // namespace icome::sketch
