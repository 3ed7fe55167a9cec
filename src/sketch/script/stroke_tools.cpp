#include <fmt/format.h>

#include <algorithm>

#include "sketch/script/tool_arguments.h"

namespace icome::sketch {
namespace {

/// An edit that changes something of each stroke that is meant.
template <typename Change>
base::Result<DrawingEdit> change_strokes(Drafting& drafting, const Arguments& arguments,
                                         const Change& change) {
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  DrawingEdit edit;
  for (const StrokePointer& stroke : *strokes) {
    auto changed = std::make_shared<Stroke>(*stroke);
    change(*changed);
    edit.emplace_back(ReplaceStroke{std::move(changed)});
  }
  return edit;
}

base::Result<DrawingEdit> plan_colour(Drafting& drafting, const Arguments& arguments) {
  return change_strokes(drafting, arguments,
                        [&](Stroke& stroke) { stroke.colour = arguments.colour("colour"); });
}

base::Result<DrawingEdit> plan_opacity(Drafting& drafting, const Arguments& arguments) {
  return change_strokes(drafting, arguments,
                        [&](Stroke& stroke) { stroke.opacity = arguments.number("opacity"); });
}

base::Result<DrawingEdit> plan_fill(Drafting& drafting, const Arguments& arguments) {
  return change_strokes(drafting, arguments, [&](Stroke& stroke) {
    stroke.fill = arguments.has("colour") ? std::optional(arguments.colour("colour")) : std::nullopt;
  });
}

base::Result<DrawingEdit> plan_ends(Drafting& drafting, const Arguments& arguments) {
  return change_strokes(drafting, arguments, [&](Stroke& stroke) {
    stroke.ends = arguments.text("ends") == "flat" ? CurveEnds::Flat : CurveEnds::Round;
  });
}

base::Result<DrawingEdit> plan_delete(Drafting& drafting, const Arguments& arguments) {
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  DrawingEdit edit;
  for (const StrokePointer& stroke : *strokes) {
    edit.emplace_back(TakeStroke{stroke->id});
    drafting.selection.erase(stroke->id);
  }
  return edit;
}

base::Result<DrawingEdit> plan_copy(Drafting& drafting, const Arguments& arguments) {
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  const auto by = place_of(arguments, "by");
  if (!by) return tl::unexpected(by.error());
  const Eigen::Affine2d there{Eigen::Translation2d(*by)};
  DrawingEdit edit;
  Selection copies;
  for (const Layer& layer : drafting.drawing.layers) {
    std::size_t place = layer.strokes.size();  // copies lie on the layer of what they are of
    for (const StrokePointer& stroke : layer.strokes) {
      if (std::find(strokes->begin(), strokes->end(), stroke) == strokes->end()) continue;
      auto copy = std::make_shared<Stroke>(*stroke);
      copy->id = StrokeId{drafting.next_id++};
      copy->curve = transformed(stroke->curve, there);
      copies.emplace(copy->id, std::vector<bool>(3 * copy->curve.segments.size() + 1, true));
      drafting.note += fmt::format("{}stroke {}", drafting.note.empty() ? "" : ", ", copy->id.value);
      edit.emplace_back(PutStroke{layer.id, place++, std::move(copy)});
    }
  }
  drafting.selection = std::move(copies);
  return edit;
}

SketchTool on_strokes(const char* name, const char* title, const char* summary, std::vector<Parameter> own,
                      base::Result<DrawingEdit> (*plan)(Drafting&, const Arguments&)) {
  for (Parameter& parameter : stroke_parameters()) own.push_back(std::move(parameter));
  return {{.name = name,
           .title = title,
           .group = "Strokes",
           .summary = std::string(summary) + " Without a stroke all that are selected.",
           .parameters = std::move(own)},
          plan};
}

}  // namespace

std::vector<SketchTool> stroke_tools() {
  return {
      on_strokes(
          "colour", "Colour", "Gives the line another colour.",
          {{.name = "colour", .kind = ParameterKind::Colour, .meaning = "of the line", .required = true}},
          plan_colour),
      on_strokes(
          "opacity", "Opacity", "Lets what lies below shine through.",
          {{.name = "opacity", .meaning = "of line and fill", .required = true, .least = 0.0, .most = 1.0}},
          plan_opacity),
      on_strokes("fill", "Fill", "Fills what a curve encloses, or no longer, without a colour.",
                 {{.name = "colour", .kind = ParameterKind::Colour, .meaning = "of the fill"}}, plan_fill),
      on_strokes("ends", "Ends", "Makes the ends of the line round or flat.",
                 {{.name = "ends",
                   .kind = ParameterKind::Choice,
                   .meaning = "their shape",
                   .required = true,
                   .choices = {"round", "flat"}}},
                 plan_ends),
      on_strokes("delete", "Delete", "Takes strokes away.", {}, plan_delete),
      on_strokes("copy", "Copy", "Makes equal strokes elsewhere, and selects them.",
                 {place_parameter("by", "how far away", true)}, plan_copy)};
}

}  // namespace icome::sketch
