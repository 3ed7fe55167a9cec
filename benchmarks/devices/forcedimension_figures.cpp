// Force Dimension's library through its fake: our layers, and a loop that answers in the same turn.
#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>

#include "device_figures.h"
#include "devices/driver/driven_device.h"
#include "devices/driver/pace.h"
#include "devices/fakes/fake_dhd.h"
#include "devices/fakes/loaded_fake.h"
#include "devices/forcedimension/dhd_library.h"
#include "devices/forcedimension/force_dimension.h"
#include "round_trips.h"

namespace icome::benchmarks {
namespace {

using devices::DhdLibrary;
using LoadedDhd = devices::fakes::LoadedFake<devices::fakes::FakeDhd>;

/// Our x, to the right, is its y.
FakeEnd dhd_end(devices::fakes::FakeUnit& unit) {
  return {[&unit](double x) {
            devices::fakes::FakeUnit::Sample pose;
            pose.position.y() = x;
            unit.pose(pose);
          },
          [&unit] { return unit.held().y(); }, [&unit] { return unit.held_since(); }};
}

/// A program without our layers: one loop that reads and answers.
std::vector<std::int32_t> direct_dhd(double rate, const FakeEnd& fake, int trips) {
  const auto dhd = DhdLibrary::load();
  if (!dhd) return {};
  const char id = static_cast<char>(dhd->open_id(0));
  dhd->enable_force(1, id);
  std::atomic<bool> stop = false;
  std::thread loop([&] {
    static_cast<void>(realtime::ask_for_realtime_priority(82));
    devices::Pace pace(rate);
    double x = 0.0, y = 0.0, z = 0.0, frame[3][3];
    while (!stop) {
      dhd->get_position_and_orientation_frame(&x, &y, &z, frame, id);
      dhd->set_force(0.0, answer_to(y), 0.0, id);
      pace.wait();
    }
  });
  std::vector<std::int32_t> durations = timed_answers(fake, trips);
  stop = true;
  loop.join();
  dhd->close(id);
  return durations;
}

std::vector<std::int32_t> layered_dhd(double rate, const FakeEnd& fake, ServoPace pace, int trips) {
  devices::ForceDimensionSettings settings;
  settings.rate = rate;
  auto driver = devices::force_dimension_driver("", settings);
  if (!driver) return {};
  auto device = devices::DrivenDevice::create(std::move(*driver));
  if (device) return round_trips(**device, fake, pace, trips);
  std::fprintf(stderr, "%s\n", device.error().message.c_str());
  return {};
}

}  // namespace

std::vector<DelayRow> forcedimension_rows(int trips) {
  const LoadedDhd fake("fake_dhd", "ICOME_LIBDHD");
  fake->set_up(1, "omega.7");
  const FakeEnd end = dhd_end(fake->devices[0].unit);
  std::vector<DelayRow> rows;
  for (const double rate : {1000.0, 4000.0}) {
    double direct_us = 0.0;
    const auto add = [&](const char* way, const std::vector<std::int32_t>& durations) {
      if (durations.empty()) return;
      rows.push_back({"forcedimension", way, rate, quantiles_us(durations), direct_us});
    };
    add("a loop alone", direct_dhd(rate, end, trips));
    if (!rows.empty()) direct_us = rows.back().us.median;
    add("servo at once", layered_dhd(rate, end, ServoPace::AtOnce, trips));
    add("servo at 1 kHz", layered_dhd(rate, end, ServoPace::Kilohertz, trips));
  }
  return rows;
}

}  // namespace icome::benchmarks
