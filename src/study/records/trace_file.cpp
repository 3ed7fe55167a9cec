#include "study/records/trace_file.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace icome::study {
namespace {

/// A column of a trace (BIDS "Motion": _channels.tsv).
struct Channel {
  const char* name;
  const char* component;
  const char* type;
  const char* point;  // tracked point
  const char* unit;
};

constexpr std::array<Channel, 18> kChannels = {{
    {"latency", "n/a", "LATENCY", "n/a", "s"},
    {"tip_x", "x", "POS", "tip", "m"},
    {"tip_y", "y", "POS", "tip", "m"},
    {"tip_z", "z", "POS", "tip", "m"},
    {"orientation_x", "quat_x", "ORNT", "tip", "n/a"},
    {"orientation_y", "quat_y", "ORNT", "tip", "n/a"},
    {"orientation_z", "quat_z", "ORNT", "tip", "n/a"},
    {"orientation_w", "quat_w", "ORNT", "tip", "n/a"},
    {"scp_x", "x", "POS", "scp", "m"},
    {"scp_y", "y", "POS", "scp", "m"},
    {"scp_z", "z", "POS", "scp", "m"},
    {"force_x", "x", "MISC", "tip", "N"},
    {"force_y", "y", "MISC", "tip", "N"},
    {"force_z", "z", "MISC", "tip", "N"},
    {"buttons", "n/a", "MISC", "n/a", "n/a"},
    {"touched", "n/a", "MISC", "n/a", "n/a"},
    {"lit", "n/a", "MISC", "n/a", "n/a"},
    {"chosen", "n/a", "MISC", "n/a", "n/a"},
}};

/// Digits that no device has are noise that fills disks, so steps are 0.1 um, 0.1 uN and 0.1 us.
constexpr double kStepsAUnit = 1e7;

double rounded(double number) { return std::round(number * kStepsAUnit) / kStepsAUnit; }

/// Adds a row with the numbers of a sample.
void add_sample(const Sample& sample, fmt::memory_buffer& table) {
  const base::Quaternion& q = sample.orientation;
  const std::array<double, 14> numbers = {sample.time,
                                          sample.tip.x(),
                                          sample.tip.y(),
                                          sample.tip.z(),
                                          q.x(),
                                          q.y(),
                                          q.z(),
                                          q.w(),
                                          sample.scp.x(),
                                          sample.scp.y(),
                                          sample.scp.z(),
                                          sample.force.x(),
                                          sample.force.y(),
                                          sample.force.z()};
  for (const double number : numbers) {
    if (std::isfinite(number)) {
      fmt::format_to(std::back_inserter(table), FMT_COMPILE("{}\t"), rounded(number));
    } else {
      fmt::format_to(std::back_inserter(table), FMT_COMPILE("{}\t"), kNotAvailable);
    }
  }
  fmt::format_to(std::back_inserter(table), FMT_COMPILE("{}\t{}\t{}\t{}\n"), sample.buttons, sample.touched,
                 sample.lit, sample.chosen);
}

}  // namespace

std::string trace_table(const Trace& trace) {
  fmt::memory_buffer table;
  for (const Sample& sample : trace.samples) add_sample(sample, table);
  return fmt::to_string(table);
}

Columns channel_columns(bool simulated) {
  return finished_columns(
      {{"name", "Of the column of the traces."},
       {"component", "Of the vector or quaternion."},
       {"type",
        "Of what it is (BIDS).",
        "",
        {{"LATENCY", "Since the start of the trial; before it negative."},
         {"POS", "A position in the frame of the stage."},
         {"ORNT", "The quaternion that turns the frame of the stylus to that of the stage."},
         {"MISC",
          "Forces on the hand in the frame of the stage; the buttons that are down (bit i: "
          "button i); the thing that is touched, the one that is lit as it would be chosen, and the one "
          "that was chosen in that sample, by click, push or touch; each or -1."}}},
       {"tracked_point", "tip: the pointer; scp: its surface contact point."},
       {"units", "Of SI."}},
      simulated);
}

std::string channels_table(bool simulated) {
  std::string table = header_of(channel_columns(simulated));
  for (const Channel& channel : kChannels)
    table += row_of({channel.name, channel.component, channel.type, channel.point, channel.unit}, simulated);
  return table;
}

std::size_t channel_count() { return kChannels.size(); }

std::size_t channel_count(std::string_view type) {
  return std::size_t(std::ranges::count_if(kChannels, [&](const Channel& it) { return it.type == type; }));
}

}  // namespace icome::study
