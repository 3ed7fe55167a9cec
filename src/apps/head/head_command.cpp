#include "apps/head/head_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "apps/head/head_camera_command.h"
#include "apps/interrupt.h"
#include "apps/option_checks.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "devices/head_trace.h"
#include "interaction/head/head_comparison.h"
#include "interaction/head/head_motion.h"
#include "interaction/head/transfer_table.h"
#include "io/file_bytes.h"
#include "io/new_file.h"
#include "io/number_text.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHeadNotes =
    "Examples:\n"
    "  icome head trace.txt --out view.csv         by table 5.4 of the thesis\n"
    "  icome head --print-table > mine.toml        a table to edit\n"
    "  icome head trace.txt --out view.csv --table mine.toml --json\n"
    "  icome head trace.txt --out view.csv --filter one-euro --predict-ms 30\n"
    "  icome head trace.txt --compare              jitter and lag of each way of steadying\n"
    "  icome head --calibrate \"camera-marker?colour=green&size=40\" --distance-m 0.6 --out camera.toml\n"
    "  icome head --record \"camera-marker?calibration=camera.toml\" --out trace.txt\n"
    "\n"
    "CAMERA is camera (a face) or camera-marker (a spot of a strong colour on the cap), then perhaps\n"
    ":SOURCE (as icome track names cameras, videos and folders of pictures) and ?key=value&...: colour,\n"
    "size (mm across), field (degrees of the picture's width) or calibration (a file of --calibrate).\n"
    "\n"
    "TRACE has rows t x y z qx qy qz qw (s, m, a quaternion), with blanks or commas between; lines\n"
    "that begin with # are passed over. The head looks along -z, y is up, and the first pose is the\n"
    "one at rest. Each row of VIEW.csv (t,x,y,z,qx,qy,qz,qw) is the movement of the view from rest, in\n"
    "the frame of the head at rest: the mean of the last five samples, with each move along and turn\n"
    "about x, y and z (taken apart as turns about y, then x, then z) through the transfer function of\n"
    "its axis. A turn beyond half a turn comes in from the other side. A table file changes what it\n"
    "names; the rest is as in table 5.4.\n"
    "\n"
    "--compare: jitter is the deviation (root mean square) from a straight line, or an even turn, in\n"
    "the stillest twentieth of the half seconds; lag the shift in time by which the motion itself comes "
    "nearest;\n"
    "behind the distance to the motion at the same time (root mean square). Each filter is also tried\n"
    "with --predict-ms (50 ms without it).\n"
    "\n"
    "JSON: {trace, out, samples, seconds, rate_hz, head: {move_m: [x,y,z], turn_deg: [x,y,z]},\n"
    "view: ...}, the most that head and view move and turn. With --compare {trace, samples, seconds,\n"
    "rate_hz, filters: [{filter, predict_ms, jitter_mm, jitter_deg, lag_move_ms, lag_turn_ms, behind_mm,\n"
    "behind_deg}]}; null where the motion is too short to tell, or nothing moves. --calibrate: {source,\n"
    "out, pictures, found, focal_widths, size_mm}; --record: {source, out, pictures, found}.";

constexpr std::uint64_t kLongestTrace = 1ULL << 30U;  // bytes
constexpr std::size_t kRowsAtOnce = 4096;             // between two looks at Ctrl-C
constexpr double kComparedPrediction = 50.0;          // ms
constexpr int kHeadInterrupted = 130;                 // what shells report for Ctrl-C

/// The most of each movement, whichever way.
struct MostMoved {
  base::Vector3 moves = base::Vector3::Zero();  // m
  base::Vector3 turns = base::Vector3::Zero();  // rad

  void take(const base::Pose& from_rest) {
    moves = moves.cwiseMax(from_rest.translation().cwiseAbs());
    turns = turns.cwiseMax(interaction::turns_of(from_rest.linear()).cwiseAbs());
  }
};

struct HeadReport {
  std::size_t samples = 0;
  double seconds = 0.0;
  MostMoved head, view;

  double rate() const { return seconds > 0.0 ? double(samples - 1) / seconds : 0.0; }
};

base::Result<interaction::HeadTransfer> transfer_of(const HeadOptions& options) {
  if (!options.table) return interaction::HeadTransfer::of_thesis();
  return interaction::read_transfer_file(*options.table);
}

void append_row(std::string& text, double time, const base::Pose& pose) {
  const base::Vector3 place = pose.translation();
  base::Quaternion turn(pose.linear());
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  io::append_number(text, time);
  for (const double number : {place.x(), place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w()}) {
    text += ',';
    io::append_number(text, number);
  }
  text += '\n';
}

/// Writes the view's movement; nothing where it was interrupted.
std::optional<HeadReport> write_view(const std::vector<devices::HeadSample>& samples,
                                     const interaction::HeadTransfer& transfer,
                                     const interaction::HeadFilterSettings& filter, io::NewFile& out) {
  HeadReport report{samples.size(), samples.back().time - samples.front().time, {}, {}};
  interaction::HeadMotion motion(transfer, filter);
  const base::Pose rest_from_tracker = samples.front().tracker_from_head.inverse();
  std::string text = "t,x,y,z,qx,qy,qz,qw\n";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const base::Pose view = motion.moved(samples[i].tracker_from_head, samples[i].time);
    append_row(text, samples[i].time, view);
    report.head.take(rest_from_tracker * samples[i].tracker_from_head);
    report.view.take(view);
    if (i % kRowsAtOnce != 0) continue;
    if (interrupted()) return std::nullopt;
    out.write(text);
    text.clear();
  }
  out.write(text);
  return report;
}

std::array<double, 3> degrees(const base::Vector3& turns) {
  constexpr double kInDegrees = 180.0 / std::numbers::pi;
  return {turns.x() * kInDegrees, turns.y() * kInDegrees, turns.z() * kInDegrees};
}

Json json_of(const MostMoved& most) {
  const base::Vector3& moves = most.moves;
  return {{"move_m", {moves.x(), moves.y(), moves.z()}}, {"turn_deg", degrees(most.turns)}};
}

std::string json_text(const HeadOptions& options, const HeadReport& report) {
  const Json json{{"trace", options.trace.string()}, {"out", options.out.string()},
                  {"samples", report.samples},       {"seconds", report.seconds},
                  {"rate_hz", report.rate()},        {"head", json_of(report.head)},
                  {"view", json_of(report.view)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_text(const HeadOptions& options, const HeadReport& report) {
  std::string text = fmt::format("{}: {} samples in {:.4g} s, {:.4g} a second\n", options.trace.string(),
                                 report.samples, report.seconds, report.rate());
  text += fmt::format("  {:<22}{:>10}{:>10}\n", "at most", "head", "view");
  const char* const moves[] = {"right or left, cm", "up or down, cm", "back or forth, cm"};
  const char* const turns[] = {"nodding, degrees", "looking aside, degrees", "tilting, degrees"};
  for (int i = 0; i < 3; ++i)
    text += fmt::format("  {:<22}{:>10.2f}{:>10.2f}\n", moves[i], 100.0 * report.head.moves[i],
                        100.0 * report.view.moves[i]);
  const auto head = degrees(report.head.turns), view = degrees(report.view.turns);
  for (std::size_t i = 0; i < 3; ++i)
    text += fmt::format("  {:<22}{:>10.2f}{:>10.2f}\n", turns[i], head[i], view[i]);
  return text + fmt::format("{}: the movement of the view\n", options.out.string());
}

int head_failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

interaction::HeadFilterSettings filter_of(const HeadOptions& options) {
  return {*interaction::head_filter_of(options.filter), 0.001 * options.predict_ms.value_or(0.0)};
}

/// Each way of steadying, as it is and predicted.
std::vector<interaction::HeadFilterSettings> compared_ways(const HeadOptions& options) {
  using interaction::HeadFilterKind;
  std::vector<interaction::HeadFilterSettings> ways;
  for (const double predicted : {0.0, options.predict_ms.value_or(kComparedPrediction)})
    for (const auto kind : {HeadFilterKind::None, HeadFilterKind::Mean, HeadFilterKind::OneEuro})
      ways.push_back({kind, 0.001 * predicted});
  return ways;
}

Json scaled(const std::optional<double>& number, double unit) {
  return number ? Json(unit * *number) : Json(nullptr);
}

constexpr double kMillimetres = 1000.0, kMilliseconds = 1000.0, kDegrees = 180.0 / std::numbers::pi;

std::string comparison_json(const HeadOptions& options, const HeadReport& report,
                            const std::vector<interaction::HeadFilterScore>& scores) {
  Json json{{"trace", options.trace.string()},
            {"samples", report.samples},
            {"seconds", report.seconds},
            {"rate_hz", report.rate()},
            {"filters", Json::array()}};
  for (const interaction::HeadFilterScore& it : scores)
    json["filters"].push_back({{"filter", interaction::name_of(it.settings.kind)},
                               {"predict_ms", kMilliseconds * it.settings.predict},
                               {"jitter_mm", scaled(it.jitter_place, kMillimetres)},
                               {"jitter_deg", scaled(it.jitter_turn, kDegrees)},
                               {"lag_move_ms", scaled(it.lag_place, kMilliseconds)},
                               {"lag_turn_ms", scaled(it.lag_turn, kMilliseconds)},
                               {"behind_mm", kMillimetres * it.behind_place},
                               {"behind_deg", kDegrees * it.behind_turn}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string cell(const std::optional<double>& number, double unit, int digits) {
  if (!number) return "-";
  const double shown = unit * *number;
  return fmt::format("{:.{}f}", std::abs(shown) < 0.5 * std::pow(10.0, -digits) ? 0.0 : shown, digits);
}

std::string comparison_text(const HeadOptions& options, const HeadReport& report,
                            const std::vector<interaction::HeadFilterScore>& scores) {
  std::string text = fmt::format("{}: {} samples in {:.4g} s, {:.4g} a second\n", options.trace.string(),
                                 report.samples, report.seconds, report.rate());
  constexpr const char* kRow = "{:<10}{:>9}{:>11}{:>10}{:>13}{:>13}{:>11}{:>12}\n";
  text += fmt::format(kRow, "", "ahead,", "jitter,", "jitter,", "lag of", "lag of", "behind,", "behind,");
  text += fmt::format(kRow, "filter", "ms", "mm", "degrees", "moves, ms", "turns, ms", "mm", "degrees");
  for (const interaction::HeadFilterScore& it : scores)
    text +=
        fmt::format(kRow, interaction::name_of(it.settings.kind), cell(it.settings.predict, kMilliseconds, 0),
                    cell(it.jitter_place, kMillimetres, 3), cell(it.jitter_turn, kDegrees, 4),
                    cell(it.lag_place, kMilliseconds, 1), cell(it.lag_turn, kMilliseconds, 1),
                    cell(it.behind_place, kMillimetres, 2), cell(it.behind_turn, kDegrees, 3));
  return text;
}

int compare_filters(const HeadOptions& options, const std::vector<devices::HeadSample>& samples,
                    StatusLine& status) {
  status.say("Comparing");
  const HeadReport report{samples.size(), samples.back().time - samples.front().time, {}, {}};
  const auto scores = interaction::compare_head_filters(samples, compared_ways(options));
  status.clear();
  return print_answer(options.json ? comparison_json(options, report, scores)
                                   : comparison_text(options, report, scores));
}

base::Result<std::vector<devices::HeadSample>> read_trace(const HeadOptions& options) {
  const auto text = io::read_bytes(options.trace, kLongestTrace);
  if (!text) return tl::unexpected(text.error());
  return devices::read_head_trace(*text, options.trace.string());
}

}  // namespace

void add_head(CLI::App& app, HeadOptions& options) {
  CLI::App& head = *app.add_subcommand(
      "head", "Make the movement of the view of a recorded motion of a head (thesis 5.7.1)");
  head.footer(kHeadNotes);
  auto* const trace = head.add_option("TRACE", options.trace, "The motion of a head")->type_name("");
  auto* const out =
      head.add_option("--out", options.out, "Write the movement of the view")->type_name("VIEW.csv");
  auto* const table =
      head.add_option("--table", options.table, "The transfer function (default: table 5.4 of the thesis)")
          ->type_name("FILE.toml");
  auto* const print_table =
      head.add_flag("--print-table", options.print_table, "Print table 5.4 as a file for --table, and end");
  head.add_flag("--json", options.json, "Print the report as JSON (fields below)");
  head.add_option("--filter", options.filter, "How noise is steadied (default mean: of five samples)")
      ->type_name("none|mean|one-euro")
      ->check(CLI::IsMember({"none", "mean", "one-euro"}));
  head.add_option("--predict-ms", options.predict_ms,
                  "How far ahead of the samples the view is, at the speed that the head has (default 0)")
      ->type_name("MS")
      ->check(number_range(0.0, 1000.0 * interaction::HeadFilterSettings::kMostPredicted));
  auto* const compare = head.add_flag("--compare", options.compare,
                                      "Print jitter and lag of each filter on this motion, and end");
  auto* const calibrate =
      head.add_option("--calibrate", options.calibrate,
                      "Measure a camera by a head that is still at a known distance, and write it to --out")
          ->type_name("CAMERA");
  head.add_option("--distance-m", options.distance, "From that camera to the head (default 0.6)")
      ->type_name("M")
      ->check(number_range(0.1, 10.0))
      ->needs(calibrate);
  auto* const record =
      head.add_option("--record", options.record, "Write what a camera sees of a head as a motion to --out")
          ->type_name("CAMERA");
  head.add_option("--seconds", options.seconds, "Of the camera (default 10; a recording to its end)")
      ->type_name("S")
      ->check(number_range(0.1, 86400.0));
  for (auto* const option : {calibrate, record}) {
    option->needs(out);
    option->excludes(trace);
  }
  calibrate->excludes(record);
  compare->needs(trace);
  compare->excludes(out);
  table->needs(trace);
  print_table->excludes(trace);
  head.callback([&options] {
    const bool is_camera = !options.calibrate.empty() || !options.record.empty();
    if (is_camera) return;
    if (!options.print_table && options.trace.empty()) throw CLI::RequiredError("TRACE");
    if (!options.print_table && !options.compare && options.out.empty()) throw CLI::RequiredError("--out");
  });
}

int run_head(const HeadOptions& options) {
  catch_interrupts();
  if (options.print_table)
    return print_answer(interaction::transfer_table_text(interaction::HeadTransfer::of_thesis()));
  if (!options.calibrate.empty()) return run_head_calibration(options);
  if (!options.record.empty()) return run_head_recording(options);
  StatusLine status;
  if (options.compare) {
    status.say("Reading " + options.trace.string());
    const auto samples = read_trace(options);
    return samples ? compare_filters(options, *samples, status) : head_failed(samples.error());
  }
  const auto transfer = transfer_of(options);
  if (!transfer) return head_failed(transfer.error());
  std::error_code error;
  if (std::filesystem::equivalent(options.trace, options.out, error))
    return head_failed({options.out.string() + ": is the recording itself; give --out another name."});
  auto out = io::NewFile::create(options.out);
  if (!out) return head_failed(out.error());
  status.say("Reading " + options.trace.string());
  const auto samples = read_trace(options);
  if (!samples) return head_failed(samples.error());
  status.say("Writing " + options.out.string());
  const auto report = write_view(*samples, *transfer, filter_of(options), *out);
  status.clear();
  if (!report) return kHeadInterrupted;
  if (const auto finished = out->finish(); !finished) return head_failed(finished.error());
  return print_answer(options.json ? json_text(options, *report) : report_text(options, *report));
}

}  // namespace icome::apps
