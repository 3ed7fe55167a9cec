#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sketch/fit/stroke_fit.h"
#include "sketch/script/tool_arguments.h"
#include "sketch/tools/connect.h"
#include "sketch/tools/eraser.h"

namespace icome::sketch {
namespace {

/// The layer that a new stroke goes to: the chosen one, else the topmost that may be changed; with none of
/// these a new one. Fails where the chosen one is hidden or locked.
base::Result<LayerId> layer_for_strokes(Drafting& drafting, DrawingEdit& edit) {
  const std::vector<Layer>& layers = drafting.drawing.layers;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const bool chosen = layer->id == drafting.layer;
    if (can_change(*layer) && (chosen || !drafting.layer)) return layer->id;
    if (chosen)
      return base::fail(fmt::format("layer \"{}\" is {}; choose another one", layer->name,
                                    layer->locked ? "locked" : "hidden"));
  }
  // The one that was chosen may have been deleted since.
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    if (can_change(*layer)) return layer->id;
  const LayerId made{drafting.next_id++};
  edit.emplace_back(PutLayer{made, layers.size(), {.name = fmt::format("Layer {}", layers.size() + 1)}});
  return made;
}

std::size_t strokes_in(const Drawing& drawing, LayerId id) {
  for (const Layer& layer : drawing.layers)
    if (layer.id == id) return layer.strokes.size();
  return 0;
}

/// The samples of a way: x and y, and pressures where there are as many.
base::Result<PenStroke> samples_of(const Arguments& arguments) {
  const std::vector<Vector2> way = way_of(arguments, "way");
  if (way.empty()) return base::fail("'way' has no place");
  std::vector<double> pressures;
  if (arguments.has("pressures")) pressures = arguments.numbers("pressures");
  if (!pressures.empty() && pressures.size() != way.size())
    return base::fail(fmt::format("'pressures' are {}, the places {}", pressures.size(), way.size()));
  PenStroke samples;
  for (std::size_t i = 0; i < way.size(); ++i)
    samples.push_back({double(i), way[i], pressures.empty() ? 1.0 : pressures[i]});
  return samples;
}

/// Brings the ends of a new curve to ends of strokes that are near, and its own to each other.
void snap_ends(const Drawing& drawing, double within, Curve& curve) {
  for (const bool last : {false, true}) {
    const Vector2 end = last ? curve.segments.back().points[3] : curve.segments.front().points[0];
    const Vector2 other = last ? curve.segments.front().points[0] : curve.segments.back().points[3];
    if (last && curve.end() > 1.0 && (end - other).norm() < within) {
      curve = closed(curve, within);
      return;
    }
    if (const auto near = nearest_end(drawing, end, within)) curve = end_moved(curve, last, near->place);
  }
}

base::Result<DrawingEdit> plan_draw(Drafting& drafting, const Arguments& arguments) {
  const auto samples = samples_of(arguments);
  if (!samples) return tl::unexpected(samples.error());
  FitSettings settings;
  settings.error = length_of(arguments, "error");
  settings.tip = {length_of(arguments, "thinnest"), length_of(arguments, "widest")};
  if (const auto good = check_fit(*samples, settings.error); !good) return tl::unexpected(good.error());
  auto stroke = std::make_shared<Stroke>();
  stroke->curve = fit_stroke(*samples, settings).curve;
  stroke->colour = arguments.colour("colour");
  stroke->opacity = arguments.number("opacity");
  if (arguments.has("fill")) stroke->fill = arguments.colour("fill");
  stroke->ends = arguments.text("ends") == "flat" ? CurveEnds::Flat : CurveEnds::Round;
  if (arguments.flag("closed")) stroke->curve = closed(stroke->curve, settings.tip.widest);
  if (const double within = length_of(arguments, "snap"); within > 0.0 && !stroke->curve.closed)
    snap_ends(drafting.drawing, within, stroke->curve);
  DrawingEdit edit;
  const auto layer = layer_for_strokes(drafting, edit);
  if (!layer) return tl::unexpected(layer.error());
  stroke->id = StrokeId{drafting.next_id++};
  drafting.note = fmt::format("stroke {}", stroke->id.value);
  edit.emplace_back(PutStroke{*layer, strokes_in(drafting.drawing, *layer), std::move(stroke)});
  return edit;
}

base::Result<DrawingEdit> plan_erase(Drafting& drafting, const Arguments& arguments) {
  const std::vector<Vector2> way = way_of(arguments, "way");
  if (way.empty()) return base::fail("'way' has no place");
  return erased(drafting.drawing, way, length_of(arguments, "radius"), arguments.flag("whole"),
                drafting.next_id);
}

base::Result<DrawingEdit> plan_paper(Drafting& /*drafting*/, const Arguments& arguments) {
  return edit_of(ResizePaper{{length_of(arguments, "width"), length_of(arguments, "height")}});
}

}  // namespace

std::vector<SketchTool> drawing_tools() {
  std::vector<SketchTool> tools;
  tools.push_back(
      {{.name = "draw",
        .title = "Draw",
        .group = "Drawing",
        .summary = "Draws a stroke along a way, as a pen that takes samples there (thesis 4.5.2).",
        .parameters =
            {way_parameter("way", "the places of the pen, mm"),
             {.name = "pressures",
              .kind = ParameterKind::Numbers,
              .meaning = "its pressure at each, 0 to 1 (all 1 where none is given)",
              .least = 0.0,
              .most = 1.0},
             length_parameter("error", "how far the curve may be from the way", 0.1, 0.001, 100.0),
             length_parameter("thinnest", "width without pressure", 0.2, 0.0, 100.0),
             length_parameter("widest", "width at full pressure", 1.0, 0.0, 1000.0),
             {.name = "colour", .kind = ParameterKind::Colour, .meaning = "of the line", .fallback = "black"},
             {.name = "opacity", .meaning = "of line and fill", .fallback = 1.0, .least = 0.0, .most = 1.0},
             {.name = "fill", .kind = ParameterKind::Colour, .meaning = "of what it encloses"},
             {.name = "ends",
              .kind = ParameterKind::Choice,
              .meaning = "of the line",
              .fallback = "round",
              .choices = {"round", "flat"}},
             {.name = "closed",
              .kind = ParameterKind::Flag,
              .meaning = "its end goes on to its start",
              .fallback = false},
             length_parameter("snap", "within which its ends go to ends that are there, or to each other",
                              0.0, 0.0, 1000.0)}},
       plan_draw});
  tools.push_back(
      {{.name = "erase",
        .title = "Erase",
        .group = "Drawing",
        .summary = "Takes away what an eraser passes over (thesis 4.5.5); the rest stays as it is.",
        .parameters = {way_parameter("way", "the places of the eraser, mm"),
                       length_parameter("radius", "of the eraser", 2.0, 0.01, 10000.0),
                       {.name = "whole",
                        .kind = ParameterKind::Flag,
                        .meaning = "take away whole strokes",
                        .fallback = false}}},
       plan_erase});
  tools.push_back(
      {{.name = "paper",
        .title = "Paper",
        .group = "Drawing",
        .summary = "Changes the size of the paper; its upper left corner stays.",
        .parameters = {{.name = "width", .meaning = "mm", .required = true, .least = 1.0, .most = 1e5},
                       {.name = "height", .meaning = "mm", .required = true, .least = 1.0, .most = 1e5}}},
       plan_paper});
  return tools;
}

}  // namespace icome::sketch
