// Measures the cost, for the servo, of keeping every tick of a trial, beside the naive ways; and the cost of
// a trial on its way to the disk. One run, one table.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "base/clock.h"
#include "devices/simulated/simulated_device.h"
#include "files/design_files.h"
#include "haptics/servo/servo.h"
#include "places.h"
#include "realtime/message_pipe.h"
#include "session/felt/haptic_representation.h"
#include "session/session.h"
#include "study/definition/study_reader.h"
#include "study/definition/templates.h"
#include "study/records/data_folder.h"

namespace icome::benchmarks {
namespace {

struct Extent {
  int ticks = 200'000;
  int synced_ticks = 300;
  double seconds = 5.0;  // of each live row
  int trials = 20;
};

template <typename T>
T must(base::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

std::filesystem::path study_scene() {
  return places::project_folder() / "data" / "studies" / "scenes" / "menu-room.wrl";
}

/// A hand that wanders over the menu room's menu.
class Wandering {
 public:
  Wandering() : hand_(devices::SimulatedSettings{}), servo_(hand_, haptics::ServoSettings{}) {
    felt_.open(must(files::read_design(study_scene())).world);
    servo_.publish(felt_.scene());
  }

  const haptics::TickReport& tick() {
    const double t = hand_.time();
    hand_.set_target({0.05 + 0.05 * std::cos(2.0 * t), 0.07 * std::sin(3.0 * t), -0.037});
    return servo_.tick(0.001);
  }

 private:
  session::HapticRepresentation felt_;
  devices::SimulatedDevice hand_;
  haptics::Servo servo_;
};

session::PointerView view_of(const haptics::TickReport& report) {
  session::PointerView view;
  view.tip = report.tip;
  view.orientation = report.orientation;
  view.scp = report.contact.scp;
  view.force = report.force;
  view.buttons = report.buttons;
  view.touching = report.contact.touching;
  view.touched = report.object;
  return view;
}

struct Cost {
  double median, high, worst;  // us
};

Cost cost_of(std::vector<std::int64_t>& times) {
  std::ranges::sort(times);
  const auto at = [&](double share) {
    return double(times[std::size_t(share * double(times.size() - 1))]) * 1e-3;
  };
  return {at(0.5), at(0.999), at(1.0)};
}

/// Cost of a tick together with `keep`; `between` runs, untimed, after every 16th tick.
Cost measure(int ticks, const std::function<void(const session::PointerView&)>& keep,
             const std::function<void()>& between) {
  Wandering hand;
  for (int i = 0; i < 2000; ++i) hand.tick();  // warm
  std::vector<std::int64_t> times;
  times.reserve(std::size_t(ticks));
  for (int i = 0; i < ticks; ++i) {
    const std::int64_t began = base::steady_nanoseconds();
    const session::PointerView view = view_of(hand.tick());
    keep(view);
    times.push_back(base::steady_nanoseconds() - began);
    if (i % 16 == 0) between();
  }
  return cost_of(times);
}

void write_row(std::FILE* file, const session::PointerView& view) {
  std::fprintf(file, "%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%u\t%u\n",
               view.tip.x(), view.tip.y(), view.tip.z(), view.orientation.x(), view.orientation.y(),
               view.orientation.z(), view.orientation.w(), view.scp.x(), view.scp.y(), view.scp.z(),
               view.force.x(), view.force.y(), view.force.z(), view.buttons, view.touched.index);
}

void print_row(const char* what, const Cost& cost, const Cost& alone) {
  fmt::print("{:<44}{:>10.2f}{:>10.2f}{:>10.1f}{:>16.2f}\n", what, cost.median, cost.high, cost.worst,
             cost.median / alone.median);
}

void tick_costs(const Extent& extent) {
  fmt::print("a tick, and what becomes of it                median us  p99.9 us  worst us  median / alone\n");
  const auto nothing = [] {};
  const Cost alone = measure(
      extent.ticks, [](const auto&) {}, nothing);
  print_row("alone", alone, alone);
  realtime::MessagePipe<session::PointerView> pipe(4096);
  const Cost piped = measure(
      extent.ticks, [&](const auto& view) { (void)pipe.try_push(view); },
      [&] {
        while (pipe.try_pop()) {
        }
      });
  print_row("kept for another thread (what is done)", piped, alone);
  std::FILE* const file = std::tmpfile();
  const Cost printed = measure(
      extent.ticks, [&](const auto& view) { write_row(file, view); }, nothing);
  print_row("fprintf in the tick", printed, alone);
  const Cost flushed = measure(
      extent.ticks / 10,
      [&](const auto& view) {
        write_row(file, view);
        std::fflush(file);
      },
      nothing);
  print_row("fprintf and fflush in the tick", flushed, alone);
  const Cost synced = measure(
      extent.synced_ticks,
      [&](const auto& view) {
        write_row(file, view);
        std::fflush(file);
        (void)::fdatasync(::fileno(file));
      },
      nothing);
  print_row("fprintf, fflush and fdatasync in the tick", synced, alone);
  std::fclose(file);
}

/// A folder for a study's data, removed with the object.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("icome-study-bench-{}", ::getpid())) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

study::Trace trace_of(double seconds) {
  Wandering hand;
  study::Trace trace;
  for (int i = 0; i < int(1000 * seconds); ++i) {
    const haptics::TickReport& report = hand.tick();
    study::Sample sample;
    sample.time = 0.001 * i;
    sample.tip = report.tip;
    sample.scp = report.contact.scp;
    sample.force = report.force;
    trace.samples.push_back(sample);
  }
  return trace;
}

/// Writes trials of a person, each with its trace, to the disk one after the other.
class Trials {
 public:
  Trials()
      : text_(must(study::study_template("blank", "bench"))),
        study_(many(must(study::read_study(text_, "bench")))),
        data_(must(study::DataFolder::open(study_, text_, folder_.path(), false))),
        log_(must(data_.open_log(must(data_.enrol({}, 0, {"30"}))))) {}

  void add(const study::Trace& trace) {
    study::TrialRecord record;
    record.plan = study::measured_trial(study_, log_.participant(), 0, number_++);
    must_do(log_.add(record, trace));
  }

 private:
  static study::Study many(study::Study study) {
    study.trials.measured = 10000;
    return study;
  }
  static void must_do(const base::Result<void>& done) {
    if (!done) throw std::runtime_error(done.error().message);
  }

  Folder folder_;
  std::string text_;
  study::Study study_;
  study::DataFolder data_;
  study::SessionLog log_;
  std::size_t number_ = 0;
};

void disk_costs(const Extent& extent) {
  fmt::print("\na trial onto the disk                            median ms  worst ms\n");
  for (const double seconds : {1.0, 10.0, 60.0}) {
    Trials trials;
    const study::Trace trace = trace_of(seconds);
    std::vector<std::int64_t> times;
    for (int i = 0; i < extent.trials; ++i) {
      const std::int64_t began = base::steady_nanoseconds();
      trials.add(trace);
      times.push_back(base::steady_nanoseconds() - began);
    }
    const Cost cost = cost_of(times);
    fmt::print("{:<46}{:>12.1f}{:>10.1f}\n", fmt::format("{:g} s at 1 kHz", seconds), cost.median * 1e-3,
               cost.worst * 1e-3);
  }
}

/// Prints a row on a session's servo while its ticks are kept or not, and trials are written to disk or not.
void live_row(const char* what, double seconds, bool kept, bool written) {
  auto session = must(session::Session::create({}));
  session->files().open(study_scene());
  session->settle();
  session->hands().trace(kept);
  const study::Trace trace = trace_of(10.0);
  Trials trials;
  const std::int64_t began = base::steady_nanoseconds();
  double time = 0.0, write_due = 0.5;
  std::uint64_t ticks = 0, lost = 0;
  while (time < seconds) {
    time = double(base::steady_nanoseconds() - began) * 1e-9;
    session->hands().aim({0.05 + 0.05 * std::cos(2.0 * time), 0.07 * std::sin(3.0 * time), -0.037});
    session->update();
    const auto taken = session->hands().take_trace();
    ticks += taken.ticks.size();
    lost = taken.lost;
    if (written && time > write_due) {
      trials.add(trace);
      write_due += 0.5;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  const session::ServoHealth health = session->hands().servo();
  fmt::print("{:<38}{:>11.1f}{:>10.1f}{:>10.0f}{:>10}{:>8}{:>7}\n", what, health.summary.busy.median * 1e6,
             health.summary.busy.p999 * 1e6, health.summary.busy.max * 1e6, health.summary.overruns, ticks,
             lost);
}

void live_costs(const Extent& extent) {
  fmt::print(
      "\na live session's servo                median us  p99.9 us  worst us  overruns    kept   lost\n");
  live_row("ticks are not kept", extent.seconds, false, false);
  live_row("ticks are kept", extent.seconds, true, false);
  live_row("and a 10 s trace is written each 0.5 s", extent.seconds, true, true);
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  CLI::App app("Measures what logging a study costs. Takes half a minute.");
  bool is_quick = false;
  app.add_flag("--quick", is_quick, "A little of everything: does it work at all?");
  CLI11_PARSE(app, argc, argv);
  Extent extent;
  if (is_quick) extent = {.ticks = 2000, .synced_ticks = 10, .seconds = 0.3, .trials = 2};
  tick_costs(extent);
  disk_costs(extent);
  live_costs(extent);
}
