#include "apps/sketch/feel_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/interrupt.h"
#include "apps/sketch/sketch_work.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "devices/device_profiles.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "sketch/feel/felt_stroke.h"
#include "sketch/files/stroke_files.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLongestStroke = 3600.0;  // s, that is drawn as it was

/// A stroke as it was felt, and the curve of what was drawn; none where the pen never pressed.
struct FeltRow {
  std::size_t samples;
  std::size_t ticks;
  std::size_t drawn;
  double greatest, greatest_step, rubbing, work;
  std::optional<sketch::FittedStroke> curve;
};

struct FeelReport {
  std::string device;
  std::vector<FeltRow> rows;
  std::vector<std::string> notes;
};

base::Result<sketch::SimulatedPen> pen_of(const SketchOptions& options) {
  sketch::SimulatedPen pen;
  pen.rate_hz = options.rate_hz;
  pen.eraser = options.eraser;
  if (options.device.empty() || options.device == pen.device.name) return pen;
  auto device = devices::find_device_profile(options.device);
  if (!device) return tl::unexpected(device.error());
  pen.device = *device;
  return pen;
}

void write_pen_ticks(io::NewFile& file, std::size_t stroke, const std::vector<sketch::PenTick>& ticks) {
  std::string text;
  for (const sketch::PenTick& tick : ticks) {
    text += std::to_string(stroke + 1);
    for (const double number : {tick.time, tick.tip.x(), tick.tip.y(), tick.tip.z(), tick.force.x(),
                                tick.force.y(), tick.force.z(), tick.pressure}) {
      text += ',';
      io::append_number(text, number);
    }
    text += '\n';
  }
  file.write(text);
}

/// A recording may pause for hours within a stroke, which nobody wants to wait for.
base::Result<void> check_length(const sketch::PenStroke& stroke, std::size_t number) {
  const double seconds = stroke.back().time - stroke.front().time;
  if (seconds <= kLongestStroke) return {};
  return base::fail(fmt::format("stroke {} takes {:.0f} s; strokes of up to {:.0f} s can be drawn",
                                number + 1, seconds, kLongestStroke));
}

FeltRow felt_row(const sketch::PenStroke& stroke, const sketch::FeltStroke& felt,
                 const sketch::FitSettings& settings) {
  FeltRow row = {stroke.size(),      felt.ticks.size(), felt.drawn.size(), felt.greatest,
                 felt.greatest_step, felt.rubbing,      felt.work,         {}};
  if (!felt.drawn.empty()) row.curve = sketch::fit_stroke(felt.drawn, settings);
  return row;
}

std::string feel_json(const SketchOptions& options, const FeelReport& report) {
  Json json = {{"file", options.in.string()}, {"paper", options.paper},     {"eraser", options.eraser},
               {"device", report.device},     {"rate_hz", options.rate_hz}, {"notes", report.notes}};
  json["strokes"] = Json::array();
  for (const FeltRow& row : report.rows) {
    json["strokes"].push_back(
        {{"samples", row.samples},
         {"ticks", row.ticks},
         {"drawn", row.drawn},
         {"max_force_n", row.greatest},
         {"max_step_n", row.greatest_step},
         {"rubbing_n", row.rubbing},
         {"work_j", row.work},
         {"segments", row.curve ? row.curve->curve.segments.size() : 0},
         {"max_error_mm", row.curve ? Json(row.curve->error * kMillimetresOfMetre) : Json(nullptr)}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string feel_text(const SketchOptions& options, const FeelReport& report) {
  constexpr std::size_t kMostRows = 30;
  std::string text =
      fmt::format("{} on {}, {} at {:g} Hz\n{:>8}{:>10}{:>10}{:>12}{:>12}{:>12}{:>12}{:>10}\n",
                  options.eraser ? "An eraser" : "A pen", options.paper, report.device, options.rate_hz,
                  "stroke", "ticks", "drawn", "force, N", "step, N", "rubbing, N", "work, mJ", "segments");
  for (std::size_t i = 0; i < std::min(report.rows.size(), kMostRows); ++i) {
    const FeltRow& row = report.rows[i];
    text += fmt::format("{:>8}{:>10}{:>10}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}{:>10}\n", i + 1, row.ticks,
                        row.drawn, row.greatest, row.greatest_step, row.rubbing,
                        row.work * kMillimetresOfMetre, row.curve ? row.curve->curve.segments.size() : 0);
  }
  if (report.rows.size() > kMostRows)
    text += fmt::format("  and {} more, which --json tells\n", report.rows.size() - kMostRows);
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  return text;
}

}  // namespace

int run_sketch_feel(const SketchOptions& options) {
  const auto paper = sketch::find_paper(options.paper);
  if (!paper) return sketch_failed(paper.error());
  const auto pen = pen_of(options);
  if (!pen) return sketch_failed(pen.error());
  if (!options.out.empty()) {
    if (const auto able = sketch::check_can_write_drawing(options.out); !able)
      return sketch_failed(able.error());
  }
  std::optional<io::NewFile> trace;
  if (!options.trace.empty()) {
    auto made = io::NewFile::create(options.trace);
    if (!made) return sketch_failed(made.error());
    trace.emplace(std::move(*made));
    trace->write("stroke,t,x,y,z,force_x,force_y,force_z,pressure\n");
  }
  const auto read = sketch::read_strokes(options.in);
  if (!read) return sketch_failed(read.error());
  FeelReport report = {pen->device.name, {}, read->notes};
  std::vector<sketch::FittedStroke> drawn;
  StatusLine status;
  for (std::size_t i = 0; i < read->strokes.size(); ++i) {
    if (interrupted()) return kSketchInterrupted;
    status.progress("Drawing", double(i), double(read->strokes.size()), "strokes");
    if (const auto good = check_length(read->strokes[i], i); !good) return sketch_failed(good.error());
    const sketch::FeltStroke felt = sketch::felt_stroke(read->strokes[i], *paper, *pen);
    report.rows.push_back(felt_row(read->strokes[i], felt, options.fit.settings()));
    if (report.rows.back().curve) drawn.push_back(*report.rows.back().curve);
    if (trace) write_pen_ticks(*trace, i, felt.ticks);
  }
  status.clear();
  if (trace) {
    if (const auto finished = trace->finish(); !finished) return sketch_failed(finished.error());
  }
  if (!options.out.empty()) {
    const auto written =
        sketch::write_drawing(sketch::drawing_of(drawn), options.out, {}, drawing::SvgLines::Outlines);
    if (!written) return sketch_failed(written.error());
  }
  return print_answer(options.json ? feel_json(options, report) : feel_text(options, report));
}

}  // namespace icome::apps
