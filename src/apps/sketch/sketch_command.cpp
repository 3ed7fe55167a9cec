#include "apps/sketch/sketch_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/design/edit_script.h"
#include "apps/design/operation_list.h"
#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "sketch/files/drawing_files.h"
#include "sketch/files/stroke_files.h"
#include "sketch/script/sketch_tool.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;
using sketch::CubicBezier;
using sketch::Drawing;

constexpr double kMmOfMetre = 1000.0;
constexpr int kSketchInterrupted = 130;  // what shells report for Ctrl-C

int sketch_failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

/// A length in mm, without the digits that turning m into mm makes.
double in_mm(double metres) { return std::round(metres * kMmOfMetre * 1e9) / 1e9; }

Json json_of_point(const base::Vector2& point) { return {in_mm(point.x()), in_mm(point.y())}; }

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Numbers in lists stand on one line: a segment a line, not a number.
std::string dumped_densely(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

sketch::SvgLines svg_lines(const SketchOptions& options) {
  return options.centre_lines ? sketch::SvgLines::CentreLines : sketch::SvgLines::Outlines;
}

sketch::PictureOptions picture_options(const SketchOptions& options) {
  sketch::PictureOptions picture;
  picture.longer_side = options.size;
  if (options.background == "none") picture.background.reset();
  if (options.page == "paper") picture.area = sketch::PictureArea::Paper;
  if (options.page == "drawing") picture.area = sketch::PictureArea::Drawing;
  return picture;
}

std::size_t count_segments(const Drawing& drawing) {
  std::size_t segments = 0;
  for (const sketch::Layer& layer : drawing.layers)
    for (const sketch::StrokePointer& stroke : layer.strokes) segments += stroke->curve.segments.size();
  return segments;
}

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// icome sketch fit

struct FitReport {
  std::vector<sketch::FittedStroke> strokes;
  std::vector<std::string> notes;
};

/// The fitted strokes; nothing where it was interrupted.
std::optional<FitReport> fit_all(const sketch::StrokesRead& read, const SketchOptions& options,
                                 StatusLine& status) {
  FitReport report;
  report.notes = read.notes;
  for (const sketch::PenStroke& stroke : read.strokes) {
    if (interrupted()) return std::nullopt;
    status.progress("Fitting", double(report.strokes.size()), double(read.strokes.size()), "strokes");
    report.strokes.push_back(sketch::fit_stroke(stroke, options.fit.settings()));
  }
  status.clear();
  return report;
}

std::string fit_json(const SketchOptions& options, const FitReport& report) {
  Json json;
  json["file"] = options.in.string();
  json["method"] = options.fit.method;
  json["error_mm"] = options.fit.error_mm;
  json["notes"] = report.notes;
  json["strokes"] = Json::array();
  for (const sketch::FittedStroke& stroke : report.strokes) {
    Json entry;
    entry["samples"] = stroke.samples;
    entry["segments"] = Json::array();
    for (const CubicBezier& segment : stroke.curve.segments) {
      Json points = Json::array();
      for (const base::Vector2& point : segment.points) points.push_back(json_of_point(point));
      entry["segments"].push_back(std::move(points));
    }
    entry["widths"] = Json::array();
    for (const sketch::WidthSegment& piece : stroke.curve.widths)
      entry["widths"].push_back({piece.from, in_mm(piece.from_width), piece.to, in_mm(piece.to_width)});
    entry["max_error_mm"] = stroke.error * kMmOfMetre;
    entry["corners"] = stroke.corners;
    json["strokes"].push_back(std::move(entry));
  }
  return dumped_densely(json);
}

std::string fit_text(const SketchOptions& options, const FitReport& report) {
  constexpr std::size_t kMostRows = 30;
  std::string text = fmt::format("{:>8}{:>10}{:>10}{:>9}{:>9}{:>12}\n", "stroke", "samples", "segments",
                                 "corners", "widths", "error, mm");
  std::size_t samples = 0;
  std::size_t segments = 0;
  std::size_t corners = 0;
  std::size_t widths = 0;
  double error = 0.0;
  for (std::size_t i = 0; i < report.strokes.size(); ++i) {
    const sketch::FittedStroke& stroke = report.strokes[i];
    samples += stroke.samples;
    segments += stroke.curve.segments.size();
    corners += stroke.corners;
    widths += stroke.curve.widths.size();
    error = std::max(error, stroke.error);
    if (i >= kMostRows) continue;
    text += fmt::format("{:>8}{:>10}{:>10}{:>9}{:>9}{:>12.4f}\n", i + 1, stroke.samples,
                        stroke.curve.segments.size(), stroke.corners, stroke.curve.widths.size(),
                        stroke.error * kMmOfMetre);
  }
  if (report.strokes.size() > kMostRows)
    text += fmt::format("  and {} more, which --json tells\n", report.strokes.size() - kMostRows);
  text += fmt::format("{:>8}{:>10}{:>10}{:>9}{:>9}{:>12.4f}\n", "all", samples, segments, corners, widths,
                      error * kMmOfMetre);
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  if (!options.out.empty()) text += options.out.string() + ": the drawing\n";
  return text;
}

int run_sketch_fit(const SketchOptions& options) {
  if (!options.out.empty()) {
    if (const auto able = sketch::check_can_write_drawing(options.out); !able)
      return sketch_failed(able.error());
  }
  StatusLine status;
  status.say("Reading " + options.in.string());
  const auto read = sketch::read_strokes(options.in);
  status.clear();
  if (!read) return sketch_failed(read.error());
  const auto report = fit_all(*read, options, status);
  if (!report) return kSketchInterrupted;
  if (!options.out.empty()) {
    const auto written = sketch::write_drawing(sketch::drawing_of(report->strokes), options.out,
                                               picture_options(options), svg_lines(options));
    if (!written) return sketch_failed(written.error());
  }
  return print_answer(options.json ? fit_json(options, *report) : fit_text(options, *report));
}

// icome sketch render

base::Result<sketch::DrawingRead> read_for_sketch(const SketchOptions& options) {
  if (options.in == "new") {
    sketch::DrawingRead empty;
    empty.drawing.layers.push_back({.id = empty.drawing.next_layer_id(), .name = "Layer 1", .strokes = {}});
    return empty;
  }
  StatusLine status;
  status.say("Reading " + options.in.string());
  return sketch::read_drawing(options.in, options.fit.settings());
}

int run_sketch_render(const SketchOptions& options) {
  if (const auto able = sketch::check_can_write_drawing(options.out); !able)
    return sketch_failed(able.error());
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  if (interrupted()) return kSketchInterrupted;
  const Drawing& drawing = read->drawing;
  if (const auto written =
          sketch::write_drawing(drawing, options.out, picture_options(options), svg_lines(options));
      !written)
    return sketch_failed(written.error());
  if (options.json) {
    return print_answer(dumped({{"in", options.in.string()},
                                {"out", options.out.string()},
                                {"layers", drawing.layers.size()},
                                {"strokes", drawing.stroke_count()},
                                {"segments", count_segments(drawing)},
                                {"width_mm", in_mm(drawing.size.x())},
                                {"height_mm", in_mm(drawing.size.y())},
                                {"notes", read->notes}}));
  }
  std::string text =
      fmt::format("{}: {}, {}\n", options.out.string(), counted(drawing.stroke_count(), "stroke"),
                  counted(count_segments(drawing), "segment"));
  for (const std::string& note : read->notes) text += "  " + note + "\n";
  return print_answer(text);
}

// icome sketch edit

int list_sketch_tools(const SketchOptions& options) {
  std::vector<const interaction::Operation*> all;
  for (const sketch::SketchTool& tool : sketch::sketch_tools()) all.push_back(&tool.about);
  const auto list = operation_list(all, "tool", options.tool, options.json);
  return list ? print_answer(*list) : sketch_failed(list.error());
}

std::string edit_report_json(const SketchOptions& options, const EditOutcome& outcome, const Drawing& drawing,
                             bool written) {
  Json json;
  json["in"] = options.in.string();
  json["out"] = written ? Json(options.out.string()) : Json(nullptr);
  json["operations"] = outcome.operations;
  json["errors"] = Json::array();
  for (const EditError& error : outcome.errors)
    json["errors"].push_back({{"line", error.line}, {"op", error.operation}, {"message", error.message}});
  json["notes"] = Json::array();
  for (const EditNote& note : outcome.notes)
    json["notes"].push_back({{"line", note.line}, {"op", note.operation}, {"text", note.text}});
  json["layers"] = drawing.layers.size();
  json["strokes"] = drawing.stroke_count();
  json["segments"] = count_segments(drawing);
  json["hash"] = fmt::format("{:016x}", sketch::hash_of(drawing));
  return dumped(json);
}

std::string edit_report_text(const SketchOptions& options, const EditOutcome& outcome,
                             const Drawing& drawing) {
  constexpr std::size_t kMostNotes = 20;
  std::string text =
      fmt::format("{}: {}, {} in {}\n", options.out.string(), counted(outcome.operations, "operation"),
                  counted(drawing.stroke_count(), "stroke"), counted(drawing.layers.size(), "layer"));
  for (std::size_t i = 0; i < std::min(outcome.notes.size(), kMostNotes); ++i) {
    const EditNote& note = outcome.notes[i];
    text += fmt::format("  {}:{}: {}: {}\n", options.apply.string(), note.line, note.operation, note.text);
  }
  if (outcome.notes.size() > kMostNotes)
    text += fmt::format("  and {} more notes, which --json tells\n", outcome.notes.size() - kMostNotes);
  return text;
}

int run_sketch_edit(const SketchOptions& options) {
  if (options.help_tools) return list_sketch_tools(options);
  if (const auto able = sketch::check_can_write_drawing(options.out); !able)
    return sketch_failed(able.error());
  const auto script = script_text(options.apply);
  if (!script) return sketch_failed(script.error());
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  for (const std::string& note : read->notes) tell(note);
  StatusLine status;
  sketch::SketchRunner runner(read->drawing);
  const auto perform = [&](const interaction::Value& command,
                           std::size_t) -> base::Result<interaction::Performed> {
    auto note = runner.perform(command);
    if (!note) return tl::unexpected(note.error());
    return interaction::Performed{nullptr, {}, std::move(*note)};
  };
  const EditOutcome outcome = perform_script(perform, *script, options.keep_going, [&](double part) {
    status.progress("Editing", 100.0 * part, 100.0, "%");
    return !interrupted();
  });
  status.clear();
  if (outcome.stopped) return kSketchInterrupted;
  const bool good = outcome.errors.empty() || options.keep_going;
  for (const EditError& error : outcome.errors)
    tell(fmt::format("{}:{}: {}", options.apply.string(), error.line, error.message));
  if (good) {
    const auto written =
        sketch::write_drawing(runner.drawing(), options.out, picture_options(options), svg_lines(options));
    if (!written) return sketch_failed(written.error());
  } else {
    tell(options.out.string() + " was not written.");
  }
  if (options.json) {
    const int printed = print_answer(edit_report_json(options, outcome, runner.drawing(), good));
    return outcome.errors.empty() ? printed : kFailed;
  }
  if (good) print(edit_report_text(options, outcome, runner.drawing()));
  return outcome.errors.empty() ? 0 : kFailed;
}

// icome sketch list

std::string colour_text(const sketch::Colour& colour) {
  const auto part = [&](std::size_t i) {
    return int(std::lround(255.0F * std::clamp(colour[i], 0.0F, 1.0F)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

double length_of(const sketch::Curve& curve) {
  double length = 0.0;
  for (const CubicBezier& segment : curve.segments) length += segment.length();
  return length;
}

Json json_of_stroke(const sketch::Stroke& stroke) {
  const sketch::Bounds2 box = stroke.curve.bounds();
  return {
      {"number", stroke.id.value},
      {"segments", stroke.curve.segments.size()},
      {"length_mm", in_mm(length_of(stroke.curve))},
      {"widest_mm", in_mm(stroke.curve.widest())},
      {"colour", colour_text(stroke.colour)},
      {"opacity", stroke.opacity},
      {"fill", stroke.fill ? Json(colour_text(*stroke.fill)) : Json(nullptr)},
      {"closed", stroke.curve.closed},
      {"bounds", {in_mm(box.min().x()), in_mm(box.min().y()), in_mm(box.max().x()), in_mm(box.max().y())}}};
}

std::string list_json(const SketchOptions& options, const sketch::DrawingRead& read) {
  Json json;
  json["in"] = options.in.string();
  json["width_mm"] = in_mm(read.drawing.size.x());
  json["height_mm"] = in_mm(read.drawing.size.y());
  json["notes"] = read.notes;
  json["layers"] = Json::array();
  for (const sketch::Layer& layer : read.drawing.layers) {
    Json entry = {{"number", layer.id.value},
                  {"name", layer.name},
                  {"visible", layer.visible},
                  {"locked", layer.locked}};
    entry["strokes"] = Json::array();
    for (const sketch::StrokePointer& stroke : layer.strokes)
      entry["strokes"].push_back(json_of_stroke(*stroke));
    json["layers"].push_back(std::move(entry));
  }
  return dumped(json);
}

std::string list_text(const SketchOptions& options, const sketch::DrawingRead& read) {
  const Drawing& drawing = read.drawing;
  std::string text =
      fmt::format("{}: paper of {:g} x {:g} mm, {}, {}\n", options.in.string(), in_mm(drawing.size.x()),
                  in_mm(drawing.size.y()), counted(drawing.layers.size(), "layer"),
                  counted(drawing.stroke_count(), "stroke"));
  for (const sketch::Layer& layer : drawing.layers) {
    text += fmt::format("  {}{}{}\n", layer.name, layer.visible ? "" : ", hidden",
                        layer.locked ? ", locked" : "");
    for (const sketch::StrokePointer& stroke : layer.strokes) {
      const sketch::Bounds2 box = stroke->curve.bounds();
      text += fmt::format(
          "  {:>6}  {:>4} segments {:>9.2f} mm long {:>7.2f} mm wide  {}  {}from {:.1f},{:.1f} to "
          "{:.1f},{:.1f}\n",
          stroke->id.value, stroke->curve.segments.size(), in_mm(length_of(stroke->curve)),
          in_mm(stroke->curve.widest()), colour_text(stroke->colour), stroke->curve.closed ? "closed, " : "",
          in_mm(box.min().x()), in_mm(box.min().y()), in_mm(box.max().x()), in_mm(box.max().y()));
    }
  }
  for (const std::string& note : read.notes) text += "  " + note + "\n";
  return text;
}

int run_sketch_list(const SketchOptions& options) {
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  return print_answer(options.json ? list_json(options, *read) : list_text(options, *read));
}

}  // namespace

int run_sketch(const SketchOptions& options) {
  catch_interrupts();
  if (options.task == "fit") return run_sketch_fit(options);
  if (options.task == "render") return run_sketch_render(options);
  if (options.task == "edit") return run_sketch_edit(options);
  return run_sketch_list(options);
}

}  // namespace icome::apps
