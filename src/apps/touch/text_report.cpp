#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "apps/touch/touch_report.h"
#include "base/shown_text.h"
#include "devices/catalogue.h"

namespace icome::apps {
namespace {

constexpr std::size_t kLabelWidth = 14;
constexpr std::size_t kBarWidth = 24;

/// Rows of "label  value"; a row without a label continues the one before.
class Table {
 public:
  void row(std::string_view label, std::string_view value) {
    text_ += fmt::format("  {:<{}}{}\n", label, kLabelWidth, value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string seconds_text(double seconds) {
  if (seconds < 1.0) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

std::string microseconds_text(double microseconds) {
  if (microseconds < 1e3) return fmt::format("{:.3g} us", microseconds);
  return seconds_text(microseconds * 1e-6);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string counted(std::uint64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", grouped(count), thing, count == 1 ? "" : "s");
}

std::string extent_of(const TouchModel& model) {
  if (model.kind == kPrimitive && is_half_space(model.body())) return "unlimited";
  const base::Vector3 size = bounds(model).sizes();
  return fmt::format("{} x {} x {}", length_text(size.x()), length_text(size.y()), length_text(size.z()));
}

const char* sides_of(const TouchBody& body, const TouchOptions& options) {
  return surface_of(body, options).sides == haptics::TouchableSides::Both ? "both sides" : "the front";
}

void add_bodies(Table& table, const TouchModel& model, const TouchOptions& options) {
  const TouchBody& body = model.body();
  if (model.kind == kPrimitive) {
    table.row(
        "", fmt::format("{}, {}, touchable from {}", model.kind, extent_of(model), sides_of(body, options)));
    return;
  }
  const std::string triangles =
      model.triangles > 0 ? fmt::format("{} triangles", grouped(model.triangles)) : "touched without a mesh";
  table.row("", fmt::format("{}, {}, {}", model.kind, triangles, extent_of(model)));
  if (model.bodies.size() == 1) {
    table.row("",
              fmt::format("{}, touchable from {}", body.closed ? "closed" : "open", sides_of(body, options)));
  }
}

void add_model(Table& table, const TouchModel& model, const TouchOptions& options) {
  table.row("model", model.name);
  if (model.bodies.empty()) {
    table.row("", model.kind);
  } else {
    add_bodies(table, model, options);
  }
  for (const std::string& sentence : model.repairs) table.row("", sentence);
  if (model.kind != kPrimitive) table.row("", fmt::format("read in {}", seconds_text(model.read_seconds)));
}

void add_effects(Table& table, const std::vector<std::string>& effects) {
  constexpr std::size_t kMostListed = 20;
  const std::size_t listed = std::min(effects.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i) table.row("effect", base::shown_text(effects[i]));
  if (listed < effects.size()) table.row("", fmt::format("and {} more", effects.size() - listed));
}

void add_histogram(Table& table, const TouchFigures& figures) {
  constexpr std::array<std::string_view, TouchFigures::kLoadBins> kLabels = {
      "     up to 0.1 %", "     0.1 - 0.3 %", "       0.3 - 1 %", "         1 - 3 %",
      "        3 - 10 %", "      10 - 100 %", " more than 100 %"};
  const auto& bins = figures.load_bins;
  const std::uint64_t most = std::max<std::uint64_t>(1, *std::max_element(bins.begin(), bins.end()));
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i] == 0) continue;
    const double share = static_cast<double>(bins[i]) / static_cast<double>(most);
    const auto length = static_cast<std::size_t>(std::ceil(share * kBarWidth));
    table.row(
        "", fmt::format("{}  {:<{}} {}", kLabels[i], std::string(length, '#'), kBarWidth, grouped(bins[i])));
  }
}

void add_run(Table& table, const TouchFigures& figures, const RunOutcome& outcome,
             const TouchOptions& options) {
  table.row("built in", seconds_text(figures.build_seconds));
  if (options.path) {
    table.row("run", fmt::format("{} along {} in {}, no clock", counted(figures.ticks, "tick"),
                                 options.path->string(), seconds_text(outcome.wall_seconds)));
  } else {
    const char* const whose = devices::is_device_address(options.device) ? "by hand" : "by a simulated hand";
    table.row("run", fmt::format("{} at {:g} Hz {} ({})", counted(figures.ticks, "tick"), figures.rate_hz,
                                 whose, options.device));
    const realtime::Quantiles& late = outcome.lateness;
    table.row("lateness",
              fmt::format("median {}, 99.9 % within {}, worst {}", microseconds_text(late.median * 1e6),
                          microseconds_text(late.p999 * 1e6), microseconds_text(late.max * 1e6)));
  }
  const realtime::Quantiles& tick = figures.tick_us;
  table.row("tick", fmt::format("median {}, 99 % within {}, 99.9 % within {}, worst {}",
                                microseconds_text(tick.median), microseconds_text(tick.p99),
                                microseconds_text(tick.p999), microseconds_text(tick.max)));
  table.row("haptic load", fmt::format("median {}, 99.9 % within {}, worst {}", percent(figures.load.median),
                                       percent(figures.load.p999), percent(figures.load.max)));
  add_histogram(table, figures);
  table.row("overruns",
            fmt::format("{}, {} skipped", grouped(figures.overruns), counted(outcome.skipped, "deadline")));
}

}  // namespace

std::string grouped(std::uint64_t number) {
  if (number < 1000) return fmt::format("{}", number);
  return fmt::format("{},{:03}", grouped(number / 1000), number % 1000);
}

std::string length_text(double metres) {
  if (metres < 1e-3) return fmt::format("{:.3g} um", metres * 1e6);
  if (metres < 1.0) return fmt::format("{:.3g} mm", metres * 1e3);
  return fmt::format("{:.3g} m", metres);
}

std::string text_report(const TouchFigures& figures, const std::vector<TouchModel>& models,
                        const RunOutcome& outcome, const TouchOptions& options) {
  Table table;
  for (const TouchModel& model : models) add_model(table, model, options);
  add_run(table, figures, outcome, options);
  if (options.texture) table.row("texture", *options.texture);
  add_effects(table, figures.effects);
  if (figures.lost_ticks > 0)
    table.row("lost", fmt::format("{} without the device", counted(figures.lost_ticks, "tick")));
  table.row("touched", fmt::format("{} of the ticks", percent(figures.touch_fraction)));
  table.row("force", fmt::format("at most {:.3g} N", figures.max_force));
  if (figures.pops && figures.sticks && figures.silent && figures.pulls && figures.unjudged && figures.late) {
    table.row("check", fmt::format("{}, {}, {}, {}, {} unjudged, {} late", counted(*figures.pops, "pop"),
                                   counted(*figures.sticks, "stick"), counted(*figures.silent, "silent tick"),
                                   counted(*figures.pulls, "pull"), grouped(*figures.unjudged),
                                   grouped(*figures.late)));
  }
  if (figures.judge_unfinished.value_or(0) > 0) {
    table.row("", fmt::format("{} of the check took too long: what they would have found is not counted",
                              counted(*figures.judge_unfinished, "question")));
  }
  table.row("memory",
            fmt::format("{:.3g} MB at most", static_cast<double>(figures.peak_memory_bytes) * 1e-6));
  return table.text();
}

}  // namespace icome::apps
