#include <fmt/format.h>

#include <cmath>

#include "sketch/script/tool_arguments.h"
#include "sketch/tools/connect.h"
#include "sketch/tools/eraser.h"
#include "sketch/tools/pull.h"
#include "sketch/tools/retouch.h"

namespace icome::sketch {
namespace {

std::vector<Parameter> with_stroke(std::vector<Parameter> own) {
  std::vector<Parameter> all = stroke_parameters();
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

base::Result<DrawingEdit> plan_pull(Drafting& drafting, const Arguments& arguments) {
  const auto picked = picked_stroke(drafting, arguments);
  if (!picked) return tl::unexpected(picked.error());
  const auto to = place_of(arguments, "to");
  if (!to) return tl::unexpected(to.error());
  const Curve& curve = picked->stroke->curve;
  const PullRule rule = arguments.text("rule") == "thesis" ? PullRule::Thesis : PullRule::Exact;
  return with_curve(*picked->stroke, pulled(curve, picked->place, *to - curve.at(picked->place), rule));
}

base::Result<DrawingEdit> plan_width(Drafting& drafting, const Arguments& arguments) {
  const auto picked = picked_stroke(drafting, arguments);
  if (!picked) return tl::unexpected(picked.error());
  const Stroke& stroke = *picked->stroke;
  if (stroke.curve.widths.empty()) return base::fail("this stroke has no line");
  return with_curve(stroke, width_changed(stroke.curve, picked->place, arguments.number("factor"),
                                          length_of(arguments, "reach")));
}

base::Result<DrawingEdit> plan_smooth(Drafting& drafting, const Arguments& arguments) {
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  DrawingEdit edit;
  std::size_t before = 0;
  std::size_t after = 0;
  const double error = length_of(arguments, "error");
  for (const StrokePointer& stroke : *strokes) {
    if (smoothing_samples(stroke->curve, error) > kMostSmoothingSamples)
      return base::fail(
          fmt::format("this stroke is too long to be smoothed within {:g} mm: allow a larger error",
                      error / kMillimetre));
    Curve smooth = smoothed(stroke->curve, error);
    before += stroke->curve.segments.size();
    after += smooth.segments.size();
    drafting.selection.erase(stroke->id);
    edit.push_back(with_curve(*stroke, std::move(smooth)).front());
  }
  drafting.note = fmt::format("{} segments of {}", after, before);
  return edit;
}

/// The place of a stroke among those of its layer.
struct StrokePlace {
  LayerId layer;
  std::size_t place;
};

StrokePlace place_in_layer(const Drawing& drawing, StrokeId id) {
  for (const Layer& layer : drawing.layers)
    for (std::size_t i = 0; i < layer.strokes.size(); ++i)
      if (layer.strokes[i]->id == id) return {layer.id, i};
  return {};
}

base::Result<DrawingEdit> plan_split(Drafting& drafting, const Arguments& arguments) {
  const auto picked = picked_stroke(drafting, arguments);
  if (!picked) return tl::unexpected(picked.error());
  const Stroke& stroke = *picked->stroke;
  const double place = picked->place;
  std::vector<Curve> parts;
  if (stroke.curve.closed) {
    parts.push_back(opened_at(stroke.curve, place));
  } else {
    if (!(place > 0.0 && place < stroke.curve.end())) return base::fail("there is nothing beyond this end");
    parts = {part_of(stroke.curve, 0.0, place), part_of(stroke.curve, place, stroke.curve.end())};
  }
  const StrokePlace old = place_in_layer(drafting.drawing, stroke.id);
  DrawingEdit edit = edit_of(TakeStroke{stroke.id});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto made = std::make_shared<Stroke>(stroke);
    made->id = StrokeId{drafting.next_id++};
    made->curve = std::move(parts[i]);
    drafting.note += fmt::format("{}stroke {}", i > 0 ? ", " : "", made->id.value);
    edit.emplace_back(PutStroke{old.layer, old.place + i, std::move(made)});
  }
  return edit;
}

/// The curves of two strokes turned so that their nearest ends meet.
Curve joined_at_nearest_ends(const Curve& a, const Curve& b) {
  const Curve forms[2][2] = {{a, reversed(a)}, {b, reversed(b)}};
  double least = std::numeric_limits<double>::infinity();
  Curve best;
  for (const Curve& first : forms[0]) {
    for (const Curve& second : forms[1]) {
      const double gap = (first.segments.back().points[3] - second.segments.front().points[0]).norm();
      if (gap >= least) continue;
      least = gap;
      best = chained(first, second);
    }
  }
  return best;
}

base::Result<DrawingEdit> plan_join(Drafting& drafting, const Arguments& arguments) {
  const auto numbers = arguments.counts("strokes");
  if (numbers.size() != 2 || numbers[0] == numbers[1])
    return base::fail("'strokes' must be the numbers of two strokes");
  const auto first = stroke_numbered(drafting, numbers[0]);
  if (!first) return tl::unexpected(first.error());
  const auto second = stroke_numbered(drafting, numbers[1]);
  if (!second) return tl::unexpected(second.error());
  if ((*first)->curve.closed || (*second)->curve.closed) return base::fail("a closed stroke has no ends");
  DrawingEdit edit = with_curve(**first, joined_at_nearest_ends((*first)->curve, (*second)->curve));
  edit.emplace_back(TakeStroke{(*second)->id});
  drafting.selection.erase((*first)->id);
  return edit;
}

base::Result<DrawingEdit> plan_close(Drafting& drafting, const Arguments& arguments) {
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  DrawingEdit edit;
  for (const StrokePointer& stroke : *strokes)
    if (!stroke->curve.closed)
      edit.push_back(with_curve(*stroke, closed(stroke->curve, length_of(arguments, "within"))).front());
  if (edit.empty()) return base::fail("it is closed already");
  return edit;
}

base::Result<DrawingEdit> plan_connect(Drafting& drafting, const Arguments& arguments) {
  const double within = length_of(arguments, "within");
  // Ends move one after the other, each as those before left the drawing.
  Drawing working = drafting.drawing;
  DrawingEdit edit;
  std::size_t met = 0;
  for (const Layer& layer : drafting.drawing.layers) {
    if (!can_change(layer)) continue;
    for (const StrokePointer& stroke : layer.strokes) {
      for (const bool last : {false, true}) {
        const Stroke& now = *working.find(stroke->id);
        if (now.curve.closed) continue;
        const Vector2 end = last ? now.curve.segments.back().points[3] : now.curve.segments.front().points[0];
        const auto near = nearest_end(working, end, within, StrokeEnd{stroke->id, last, end});
        if (!near || near->place == end) continue;
        const DrawingEdit step =
            with_curve(now, near->stroke == stroke->id ? closed(now.curve, within)
                                                       : end_moved(now.curve, last, near->place));
        if (auto done = apply_edit(working, step); !done) return tl::unexpected(done.error());
        edit.push_back(step.front());
        ++met;
      }
    }
  }
  if (edit.empty())
    return base::fail(fmt::format("no two ends are less than {:g} mm apart", within / kMillimetre));
  drafting.note = fmt::format("{} end{} moved", met, met == 1 ? "" : "s");
  return edit;
}

}  // namespace

std::vector<SketchTool> shaping_tools() {
  std::vector<SketchTool> tools;
  tools.push_back({{.name = "pull",
                    .title = "Pull",
                    .group = "Shape",
                    .summary = "Pulls a curve to a place (thesis 4.5.3); neighbouring segments stay smooth.",
                    .parameters = with_stroke({place_parameter("to", "where the curve is pulled to", true),
                                               {.name = "rule",
                                                .kind = ParameterKind::Choice,
                                                .meaning = "exact: the place picked goes there",
                                                .fallback = "exact",
                                                .choices = {"exact", "thesis"}}})},
                   plan_pull});
  tools.push_back(
      {{.name = "width",
        .title = "Width",
        .group = "Shape",
        .summary = "Makes a line wider or narrower about a place.",
        .parameters = with_stroke(
            {{.name = "factor",
              .meaning = "2 is twice as wide",
              .required = true,
              .least = 0.0,
              .most = 100.0},
             length_parameter("reach", "how far along the line on both sides", 10.0, 0.01, 1e5)})},
       plan_width});
  tools.push_back(
      {{.name = "smooth",
        .title = "Smooth",
        .group = "Shape",
        .summary = "Makes a curve simpler; without a stroke all that is selected.",
        .parameters = with_stroke({length_parameter("error", "how far it may move", 0.5, 0.001, 1000.0)})},
       plan_smooth});
  tools.push_back({{.name = "split",
                    .title = "Split",
                    .group = "Shape",
                    .summary = "Cuts a stroke in two at a place; a closed one is opened there.",
                    .parameters = {place_parameter("at", "a place on it", true)}},
                   plan_split});
  tools.push_back({{.name = "join",
                    .title = "Join",
                    .group = "Shape",
                    .summary = "Makes one stroke of two, at the ends that are nearest to each other.",
                    .parameters = {{.name = "strokes",
                                    .kind = ParameterKind::Counts,
                                    .meaning = "the numbers of two",
                                    .required = true,
                                    .least = 1}}},
                   plan_join});
  tools.push_back(
      {{.name = "close",
        .title = "Close",
        .group = "Shape",
        .summary = "Closes a stroke, or all that are selected: near ends are brought together, others are "
                   "joined by a straight line.",
        .parameters = with_stroke({length_parameter("within", "up to which ends are near", 2.0, 0.0, 1e5)})},
       plan_close});
  tools.push_back({{.name = "connect",
                    .title = "Connect",
                    .group = "Shape",
                    .summary = "Brings ends together that are near each other (thesis 4.16).",
                    .parameters = {length_parameter("within", "the M of the thesis", 2.0, 0.001, 1000.0)}},
                   plan_connect});
  return tools;
}

}  // namespace icome::sketch
