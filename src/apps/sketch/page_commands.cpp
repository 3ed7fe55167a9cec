#include "apps/sketch/page_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/interrupt.h"
#include "apps/sketch/sketch_work.h"
#include "apps/terminal.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string page_document(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string colour_code(const drawing::Colour& colour) {
  const auto part = [&](std::size_t i) {
    return int(std::lround(255.0F * std::clamp(colour[i], 0.0F, 1.0F)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

double curve_length(const drawing::Curve& curve) {
  double length = 0.0;
  for (const drawing::CubicBezier& segment : curve.segments) length += segment.length();
  return length;
}

Json json_of_stroke(const drawing::Stroke& stroke) {
  const drawing::Bounds2 box = stroke.curve.bounds();
  return {
      {"number", stroke.id.value},
      {"segments", stroke.curve.segments.size()},
      {"length_mm", in_mm(curve_length(stroke.curve))},
      {"widest_mm", in_mm(stroke.curve.widest())},
      {"colour", colour_code(stroke.colour)},
      {"opacity", stroke.opacity},
      {"fill", stroke.fill ? Json(colour_code(*stroke.fill)) : Json(nullptr)},
      {"closed", stroke.curve.closed},
      {"bounds", {in_mm(box.min().x()), in_mm(box.min().y()), in_mm(box.max().x()), in_mm(box.max().y())}}};
}

std::string strokes_json(const SketchOptions& options, const drawing::DrawingRead& read) {
  Json json;
  json["in"] = options.in.string();
  json["width_mm"] = in_mm(read.drawing.size.x());
  json["height_mm"] = in_mm(read.drawing.size.y());
  json["notes"] = read.notes;
  json["layers"] = Json::array();
  for (const drawing::Layer& layer : read.drawing.layers) {
    Json entry = {{"number", layer.id.value},
                  {"name", layer.name},
                  {"visible", layer.visible},
                  {"locked", layer.locked}};
    entry["strokes"] = Json::array();
    for (const drawing::StrokePointer& stroke : layer.strokes)
      entry["strokes"].push_back(json_of_stroke(*stroke));
    json["layers"].push_back(std::move(entry));
  }
  return page_document(json);
}

std::string strokes_text(const SketchOptions& options, const drawing::DrawingRead& read) {
  const drawing::Drawing& drawing = read.drawing;
  std::string text =
      fmt::format("{}: paper of {:g} x {:g} mm, {}, {}\n", options.in.string(), in_mm(drawing.size.x()),
                  in_mm(drawing.size.y()), how_many(drawing.layers.size(), "layer"),
                  how_many(drawing.stroke_count(), "stroke"));
  for (const drawing::Layer& layer : drawing.layers) {
    text += fmt::format("  {}{}{}\n", layer.name, layer.visible ? "" : ", hidden",
                        layer.locked ? ", locked" : "");
    for (const drawing::StrokePointer& stroke : layer.strokes) {
      const drawing::Bounds2 box = stroke->curve.bounds();
      text += fmt::format(
          "  {:>6}  {:>4} segments {:>9.2f} mm long {:>7.2f} mm wide  {}  {}from {:.1f},{:.1f} to "
          "{:.1f},{:.1f}\n",
          stroke->id.value, stroke->curve.segments.size(), in_mm(curve_length(stroke->curve)),
          in_mm(stroke->curve.widest()), colour_code(stroke->colour), stroke->curve.closed ? "closed, " : "",
          in_mm(box.min().x()), in_mm(box.min().y()), in_mm(box.max().x()), in_mm(box.max().y()));
    }
  }
  for (const std::string& note : read.notes) text += "  " + note + "\n";
  return text;
}

}  // namespace

int run_sketch_render(const SketchOptions& options) {
  if (const auto able = sketch::check_can_write_drawing(options.out); !able)
    return sketch_failed(able.error());
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  if (interrupted()) return kSketchInterrupted;
  const drawing::Drawing& drawing = read->drawing;
  if (const auto written =
          sketch::write_drawing(drawing, options.out, picture_options(options), svg_lines(options));
      !written)
    return sketch_failed(written.error());
  if (options.json) {
    return print_answer(page_document({{"in", options.in.string()},
                                       {"out", options.out.string()},
                                       {"layers", drawing.layers.size()},
                                       {"strokes", drawing.stroke_count()},
                                       {"segments", count_segments(drawing)},
                                       {"width_mm", in_mm(drawing.size.x())},
                                       {"height_mm", in_mm(drawing.size.y())},
                                       {"notes", read->notes}}));
  }
  std::string text =
      fmt::format("{}: {}, {}\n", options.out.string(), how_many(drawing.stroke_count(), "stroke"),
                  how_many(count_segments(drawing), "segment"));
  for (const std::string& note : read->notes) text += "  " + note + "\n";
  return print_answer(text);
}

int run_sketch_list(const SketchOptions& options) {
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  return print_answer(options.json ? strokes_json(options, *read) : strokes_text(options, *read));
}

}  // namespace icome::apps
