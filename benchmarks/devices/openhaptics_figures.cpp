// OpenHaptics through its fake: our layers when its scheduler drives and when we make frames ourselves, and a
// callback of its scheduler that answers in the same frame.
#include <array>
#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>

#include "device_figures.h"
#include "devices/driver/driven_device.h"
#include "devices/fakes/fake_hd.h"
#include "devices/fakes/loaded_fake.h"
#include "devices/openhaptics/hd_library.h"
#include "devices/openhaptics/open_haptics.h"
#include "round_trips.h"

namespace icome::benchmarks {
namespace {

using devices::HdLibrary;
using devices::OpenHapticsSettings;
using LoadedHd = devices::fakes::LoadedFake<devices::fakes::FakeHd>;

constexpr double kHdRate = 1000.0;  // Hz

FakeEnd end_of(devices::fakes::FakeUnit& unit) {
  return {[&unit](double x) {
            devices::fakes::FakeUnit::Sample pose;
            pose.position.x() = x;
            unit.pose(pose);
          },
          [&unit] { return unit.held().x(); }, [&unit] { return unit.held_since(); }};
}

/// A program without our layers: one callback that reads and answers.
struct DirectHd {
  HdLibrary hd;
  unsigned device = 0;
  std::atomic<bool> stop = false;
  std::atomic<bool> stopped = false;

  static unsigned call(void* context) {
    DirectHd& it = *static_cast<DirectHd*>(context);
    if (it.stop) {
      it.stopped = true;
      return HdLibrary::kDone;
    }
    std::array<double, 3> position = {};
    it.hd.begin_frame(it.device);
    it.hd.get_doublev(HdLibrary::kPosition, position.data());
    const std::array<double, 3> force = {answer_to(0.001 * position[0]), 0.0, 0.0};
    it.hd.set_doublev(HdLibrary::kForce, force.data());
    it.hd.end_frame(it.device);
    return HdLibrary::kContinue;
  }
};

std::vector<std::int32_t> direct_hd(const FakeEnd& fake, int trips) {
  const auto hd = HdLibrary::load();
  if (!hd) return {};
  DirectHd direct{*hd};
  direct.device = hd->init_device(nullptr);
  hd->enable(HdLibrary::kForceOutput);
  hd->set_scheduler_rate(static_cast<unsigned long>(kHdRate));
  hd->start_scheduler();
  hd->schedule_asynchronous(&DirectHd::call, &direct, HdLibrary::kMaxPriority);
  std::vector<std::int32_t> durations = timed_answers(fake, trips);
  direct.stop = true;
  while (!direct.stopped) std::this_thread::yield();
  hd->stop_scheduler();
  hd->disable_device(direct.device);
  return durations;
}

std::vector<std::int32_t> layered_hd(OpenHapticsSettings::Mode mode, const FakeEnd& fake, ServoPace pace,
                                     int trips) {
  auto device =
      devices::DrivenDevice::create(devices::open_haptics_driver("", {.mode = mode, .rate = kHdRate}));
  if (device) return round_trips(**device, fake, pace, trips);
  std::fprintf(stderr, "%s\n", device.error().message.c_str());
  return {};
}

}  // namespace

std::vector<DelayRow> openhaptics_rows(int trips) {
  const LoadedHd fake("fake_hd", "ICOME_LIBHD");
  fake->set_up(1, "Touch");
  const FakeEnd end = end_of(fake->devices[0].unit);
  std::vector<DelayRow> rows;
  double direct_us = 0.0;
  const auto add = [&](const char* way, const std::vector<std::int32_t>& durations) {
    if (durations.empty()) return;
    rows.push_back({"openhaptics", way, kHdRate, quantiles_us(durations), direct_us});
  };
  using Mode = OpenHapticsSettings::Mode;
  add("a callback alone", direct_hd(end, trips));
  if (!rows.empty()) direct_us = rows.front().us.median;
  add("drives, servo at once", layered_hd(Mode::Drives, end, ServoPace::AtOnce, trips));
  add("follows, servo at once", layered_hd(Mode::Follows, end, ServoPace::AtOnce, trips));
  add("drives, servo at 1 kHz", layered_hd(Mode::Drives, end, ServoPace::Kilohertz, trips));
  add("follows, servo at 1 kHz", layered_hd(Mode::Follows, end, ServoPace::Kilohertz, trips));
  return rows;
}

}  // namespace icome::benchmarks
