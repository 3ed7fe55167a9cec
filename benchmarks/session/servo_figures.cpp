// Measures how steady the servo is: alone, beside a display that draws without a pause, and beside an import.
#include <unistd.h>

#include <cmath>
#include <functional>

#include "bench_session.h"
#include "files/design_files.h"
#include "session_figures.h"
#include "watching_display.h"
#include "world/world.h"

namespace icome::benchmarks {
namespace {

/// Runs the main loop for `seconds` while the hand wanders over the plate.
void wander(session::Session& session, double seconds, const std::function<void()>& at_each_turn) {
  const auto start = std::chrono::steady_clock::now();
  double time = 0.0;
  while (time < seconds) {
    time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    session.hands().aim({0.08 * std::cos(2.0 * time), -0.002, 0.08 * std::sin(3.0 * time)});
    session.update();
    at_each_turn();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

struct Measured {
  realtime::LoopSummary summary;
  std::string note;
};

/// A design file of the large mesh, removed with the object.
class LargeFile {
 public:
  explicit LargeFile(int grid)
      : path_(std::filesystem::temp_directory_path() /
              ("icome_large_" + std::to_string(::getpid()) + ".ply")) {
    world::World world;
    must(world::apply(world, world::CreateGeometry{{1}, large_plate(grid)}));
    world::PhysicalObject object;
    object.geometry = {1};
    must(world::apply(world, world::CreateObject{{2}, 0, object}));
    (void)must(files::write_design(path_, world));
  }
  ~LargeFile() { std::filesystem::remove(path_); }
  LargeFile(const LargeFile&) = delete;
  LargeFile& operator=(const LargeFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::unique_ptr<session::Session> session_with_plate() {
  auto session = start_session();
  add_shape(*session, thick_plate(), lowered(0.01));
  return session;
}

realtime::LoopSummary alone(double seconds) {
  const auto session = session_with_plate();
  wander(*session, seconds, [] {});
  return session->hands().servo().summary;
}

realtime::LoopSummary beside_display(double seconds) {
  const auto session = session_with_plate();
  WatchingDisplay display(session->view().display(), 1280, 800, WatchingDisplay::Pace::Always);
  wander(*session, seconds, [] {});
  return session->hands().servo().summary;
}

realtime::LoopSummary beside_import(double seconds, const std::filesystem::path& large, int& imports) {
  const auto session = session_with_plate();
  wander(*session, seconds, [&] {
    if (session->files().opening()) return;
    ++imports;
    session->files().open(large);
  });
  session->files().cancel_open();
  return session->hands().servo().summary;
}

void add_servo_rows(const std::string& what, const realtime::LoopSummary& it,
                    const realtime::LoopSummary& compared, std::vector<SessionRow>& rows) {
  const auto add = [&](const char* name, const char* unit, double factor,
                       const realtime::Quantiles& quantiles, const realtime::Quantiles& its) {
    rows.push_back({.figure = what + ": " + name,
                    .unit = unit,
                    .median = factor * quantiles.median,
                    .high = factor * quantiles.p999,
                    .worst = factor * quantiles.max,
                    .times_of = factor * its.median,
                    .of = "alone"});
  };
  add("haptic load", "%", 100.0, it.load, compared.load);
  add("period", "ms", 1e3, it.period, compared.period);
  add("lateness", "us", 1e6, it.lateness, compared.lateness);
  rows.push_back({.figure = what + ": overruns in a million ticks",
                  .unit = "",
                  .median = it.ticks == 0 ? 0.0 : 1e6 * double(it.overruns) / double(it.ticks)});
}

}  // namespace

SessionSection servo_figures(const SessionExtent& extent) {
  const LargeFile large(extent.grid);
  int imports = 0;
  const realtime::LoopSummary none = alone(extent.seconds);
  const realtime::LoopSummary display = beside_display(extent.seconds);
  const realtime::LoopSummary import = beside_import(extent.seconds, large.path(), imports);
  SessionSection section{"the servo at 1 kHz, a hand wandering over a plate", {}};
  add_servo_rows("alone", none, none, section.rows);
  add_servo_rows("display drawing without a pause", display, none, section.rows);
  add_servo_rows("importing " + std::to_string(2 * extent.grid * extent.grid) + " triangles, " +
                     std::to_string(imports) + " times",
                 import, none, section.rows);
  return section;
}

}  // namespace icome::benchmarks
