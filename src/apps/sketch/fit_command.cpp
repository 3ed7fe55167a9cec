#include "apps/sketch/fit_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/interrupt.h"
#include "apps/sketch/sketch_work.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "sketch/files/stroke_files.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_point(const base::Vector2& point) { return {in_mm(point.x()), in_mm(point.y())}; }

struct FitReport {
  std::vector<sketch::FittedStroke> strokes;
  std::vector<std::string> notes;
};

/// The fitted strokes; nothing where it was interrupted.
base::Result<std::optional<FitReport>> fit_all(const sketch::StrokesRead& read, const SketchOptions& options,
                                               StatusLine& status) {
  FitReport report;
  report.notes = read.notes;
  for (const sketch::PenStroke& stroke : read.strokes) {
    if (interrupted()) return std::nullopt;
    const auto good = sketch::check_fit(stroke, options.fit.settings().error);
    if (!good)
      return base::fail(fmt::format("{}: stroke {}: {}", options.in.string(), report.strokes.size() + 1,
                                    good.error().message));
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
    for (const drawing::CubicBezier& segment : stroke.curve.segments) {
      Json points = Json::array();
      for (const base::Vector2& point : segment.points) points.push_back(json_of_point(point));
      entry["segments"].push_back(std::move(points));
    }
    entry["widths"] = Json::array();
    for (const drawing::WidthSegment& piece : stroke.curve.widths)
      entry["widths"].push_back({piece.from, in_mm(piece.from_width), piece.to, in_mm(piece.to_width)});
    entry["max_error_mm"] = stroke.error * kMillimetresOfMetre;
    entry["corners"] = stroke.corners;
    json["strokes"].push_back(std::move(entry));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
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
                        stroke.error * kMillimetresOfMetre);
  }
  if (report.strokes.size() > kMostRows)
    text += fmt::format("  and {} more, which --json tells\n", report.strokes.size() - kMostRows);
  text += fmt::format("{:>8}{:>10}{:>10}{:>9}{:>9}{:>12.4f}\n", "all", samples, segments, corners, widths,
                      error * kMillimetresOfMetre);
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  if (!options.out.empty()) text += options.out.string() + ": the drawing\n";
  return text;
}

}  // namespace

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
  const auto fitted = fit_all(*read, options, status);
  if (!fitted) {
    status.clear();
    return sketch_failed(fitted.error());
  }
  const std::optional<FitReport>& report = *fitted;
  if (!report) return kSketchInterrupted;
  if (!options.out.empty()) {
    const auto written = sketch::write_drawing(sketch::drawing_of(report->strokes), options.out,
                                               picture_options(options), svg_lines(options));
    if (!written) return sketch_failed(written.error());
  }
  return print_answer(options.json ? fit_json(options, *report) : fit_text(options, *report));
}

}  // namespace icome::apps
