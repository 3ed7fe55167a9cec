// Haply's Inverse Service through its fake: our layers, and a loop that answers by the next message.
#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>

#include "device_figures.h"
#include "devices/driver/driven_device.h"
#include "devices/driver/pace.h"
#include "devices/fakes/fake_inverse_service.h"
#include "devices/haply/haply_driver.h"
#include "realtime/this_thread.h"
#include "round_trips.h"

namespace icome::benchmarks {
namespace {

using devices::fakes::FakeInverseService;

/// Our x, to the right, is the service's.
FakeEnd haply_end(FakeInverseService& fake, const devices::Vector3& middle) {
  return {[&fake, middle](double x) { fake.pin(middle + devices::Vector3(x, 0.0, 0.0)); },
          [&fake] { return fake.commanded().x(); }, [&fake] { return fake.commanded_since(); }};
}

/// A program without our layers: one loop that sends the force and takes the answer.
std::vector<std::int32_t> direct_haply(const devices::HaplySettings& settings, const FakeEnd& fake,
                                       int trips) {
  auto service = devices::InverseService::connect(settings);
  if (!service || !(*service)->choose({})) return {};
  std::atomic<bool> stop = false;
  std::thread loop([&] {
    static_cast<void>(realtime::ask_for_realtime_priority(82));
    devices::Pace pace(settings.rate);
    while (!stop) {
      const double x = (*service)->arm().position.x() - settings.middle.x();
      const auto force = [x] { return devices::Vector3(answer_to(x), 0.0, 0.0); };
      if ((*service)->exchange(force) == devices::InverseService::Answer::Lost) return;
      pace.wait();
    }
  });
  std::vector<std::int32_t> durations = timed_answers(fake, trips);
  stop = true;
  loop.join();
  return durations;
}

std::vector<std::int32_t> layered_haply(const devices::HaplySettings& settings, const FakeEnd& fake,
                                        ServoPace pace, int trips) {
  auto device = devices::DrivenDevice::create(std::make_unique<devices::HaplyDriver>(settings));
  if (device) return round_trips(**device, fake, pace, trips);
  std::fprintf(stderr, "%s\n", device.error().message.c_str());
  return {};
}

}  // namespace

std::vector<DelayRow> haply_rows(int trips) {
  FakeInverseService fake;
  devices::HaplySettings settings;
  settings.service = {"127.0.0.1", fake.port()};
  settings.events_port = fake.events_port();
  settings.patience = 5.0;  // a machine that stands still is no fault of the service
  const FakeEnd end = haply_end(fake, settings.middle);
  std::vector<DelayRow> rows;
  for (const double rate : {1000.0, 2000.0, 4000.0}) {
    settings.rate = rate;
    double direct_us = 0.0;
    const auto add = [&](const char* way, const std::vector<std::int32_t>& durations) {
      if (durations.empty()) return;
      rows.push_back({"haply", way, rate, quantiles_us(durations), direct_us});
    };
    add("a loop alone", direct_haply(settings, end, trips));
    if (!rows.empty()) direct_us = rows.back().us.median;
    add("servo at once", layered_haply(settings, end, ServoPace::AtOnce, trips));
    add("servo at 1 kHz", layered_haply(settings, end, ServoPace::Kilohertz, trips));
  }
  return rows;
}

}  // namespace icome::benchmarks
