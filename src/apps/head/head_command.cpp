#include "apps/head/head_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "devices/head_trace.h"
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
    "\n"
    "TRACE has rows t x y z qx qy qz qw (s, m, a quaternion), with blanks or commas between; lines\n"
    "that begin with # are passed over. The head looks along -z, y is up, and the first pose is the\n"
    "one at rest. Each row of VIEW.csv (t,x,y,z,qx,qy,qz,qw) is the movement of the view from rest, in\n"
    "the frame of the head at rest: the mean of the last five samples, with each move along and turn\n"
    "about x, y and z (taken apart as turns about y, then x, then z) through the transfer function of\n"
    "its axis. A turn beyond half a turn comes in from the other side. A table file changes what it\n"
    "names; the rest is as in table 5.4.\n"
    "\n"
    "JSON: {trace, out, samples, seconds, rate_hz, head: {move_m: [x,y,z], turn_deg: [x,y,z]},\n"
    "view: ...}, the most that head and view move and turn.";

constexpr std::uint64_t kLongestTrace = 1ULL << 30U;  // bytes
constexpr std::size_t kRowsAtOnce = 4096;             // between two looks at Ctrl-C
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
                                     const interaction::HeadTransfer& transfer, io::NewFile& out) {
  HeadReport report{samples.size(), samples.back().time - samples.front().time, {}, {}};
  interaction::HeadMotion motion(transfer);
  const base::Pose rest_from_tracker = samples.front().tracker_from_head.inverse();
  std::string text = "t,x,y,z,qx,qy,qz,qw\n";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const base::Pose view = motion.moved(samples[i].tracker_from_head);
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
  trace->needs(out);
  out->needs(trace);
  table->needs(trace);
  print_table->excludes(trace);
  head.callback([&options] {
    if (!options.print_table && options.trace.empty()) throw CLI::RequiredError("TRACE");
  });
}

int run_head(const HeadOptions& options) {
  catch_interrupts();
  if (options.print_table)
    return print_answer(interaction::transfer_table_text(interaction::HeadTransfer::of_thesis()));
  const auto transfer = transfer_of(options);
  if (!transfer) return head_failed(transfer.error());
  std::error_code error;
  if (std::filesystem::equivalent(options.trace, options.out, error))
    return head_failed({options.out.string() + ": is the recording itself; give --out another name."});
  auto out = io::NewFile::create(options.out);
  if (!out) return head_failed(out.error());
  StatusLine status;
  status.say("Reading " + options.trace.string());
  const auto text = io::read_bytes(options.trace, kLongestTrace);
  if (!text) return head_failed(text.error());
  const auto samples = devices::read_head_trace(*text, options.trace.string());
  if (!samples) return head_failed(samples.error());
  status.say("Writing " + options.out.string());
  const auto report = write_view(*samples, *transfer, *out);
  status.clear();
  if (!report) return kHeadInterrupted;
  if (const auto finished = out->finish(); !finished) return head_failed(finished.error());
  return print_answer(options.json ? json_text(options, *report) : report_text(options, *report));
}

}  // namespace icome::apps
