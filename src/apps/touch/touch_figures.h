#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/touch/tick_log.h"
#include "apps/touch/touch_models.h"
#include "apps/touch/touch_run.h"
#include "realtime/recorder.h"

namespace icome::apps {

/// The figures of a run, ready to be printed.
struct TouchFigures {
  static constexpr std::size_t kLoadBins = 7;
  /// Upper ends of all load bins but the last, which takes the rest; shares of the period.
  static constexpr std::array<double, kLoadBins - 1> kLoadEdges = {0.001, 0.003, 0.01, 0.03, 0.1, 1.0};

  std::string model;           // the MODELs as given, a blank between
  std::size_t triangles = 0;   // of all meshes
  double build_seconds = 0.0;  // s, of what the servo touches; without reading files
  std::uint64_t ticks = 0;
  double rate_hz = 0.0;
  realtime::Quantiles tick_us;  // us, exact: all of a tick except device input and output
  realtime::Quantiles load;     // tick_us as a share of the period
  std::array<std::uint64_t, kLoadBins> load_bins{};  // ticks by load
  std::uint64_t overruns = 0;                        // ticks that were not done when the next was due
  std::uint64_t lost_ticks = 0;                      // ticks without the device
  double max_force = 0.0;                            // N
  double touch_fraction = 0.0;                       // of the ticks
  std::optional<std::uint64_t> pops;                 // none without --check
  std::optional<std::uint64_t> sticks;
  std::optional<std::uint64_t> silent;
  std::optional<std::uint64_t> pulls;
  std::optional<std::uint64_t> unjudged;          // ticks of which the judge could not tell if they were pops
  std::optional<std::uint64_t> late;              // ticks in which the contact was still on its way
  std::optional<std::uint64_t> judge_unfinished;  // questions of the judge that took too long
  std::optional<std::string> texture;             // as it was asked for
  std::vector<std::string> effects;               // as they were asked for, then those of designs
  std::vector<std::string> capped;                // sentences, one for each feel softer than asked for
  std::size_t peak_memory_bytes = 0;              // of the whole program
};

/// The nearest-rank quantiles of raw samples, divided by `unit`; zeros without samples. Takes a
/// copy to sort.
realtime::Quantiles exact_quantiles(std::vector<std::uint32_t> samples, double unit);

TouchFigures figures_of(const std::vector<TouchModel>& models, double build_seconds, const TickLog& log,
                        const RunOutcome& outcome, const TouchOptions& options);

}  // namespace icome::apps
