// Delays of VRPN between a device and a program on the same computer: of the state of a device, from the
// server that shares it until the client's servo could read it, and of the servo's force, until the server
// wants it on the device. Both loops at 1 kHz, as they are in use; a row each, median and p99.9.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "device_figures.h"
#include "devices/driver/driven_device.h"
#include "devices/vrpn/vrpn_driver.h"
#include "devices/vrpn/vrpn_server.h"
#include "realtime/this_thread.h"

namespace {

using namespace icome::devices;
using icome::base::steady_nanoseconds;

constexpr std::int64_t kPeriod = 1'000'000;  // ns
constexpr double kStep = 1e-6;               // m a number, so that a place tells its number
constexpr double kSlope = 1e-3;              // a number: a force's y by its x, a ratio that ramps keep
constexpr int kNumbers = 1000;

/// The times at which numbers were given to the one side.
struct Stamps {
  std::vector<std::atomic<std::int64_t>> given = std::vector<std::atomic<std::int64_t>>(kNumbers);
  std::vector<std::int64_t> delays;  // ns, of the numbers that came to the other side

  void note(int number) { given[static_cast<std::size_t>(number)].store(steady_nanoseconds()); }
  void arrived(double value) {
    const auto number = static_cast<int>(std::lround(value));
    if (number <= 0 || number >= kNumbers) return;
    const std::int64_t since = given[static_cast<std::size_t>(number)].exchange(0);
    if (since != 0) delays.push_back(steady_nanoseconds() - since);
  }
};

/// The device's own loop: it shares its state and takes the force that is wanted on it.
void run_device(VrpnServer& server, Stamps& states, Stamps& forces, const std::atomic<bool>& stop) {
  std::int64_t next = steady_nanoseconds();
  PointerState state;
  for (int tick = 0; !stop; ++tick) {
    const int number = 1 + tick % (kNumbers - 1);
    state.position.x() = kStep * number;
    states.note(number);
    server.feed(state, Vector3::Zero());
    // Ten looks a period, so that the delay is that of the way and not of this loop.
    for (int look = 1; look <= 10; ++look) {
      const Vector3 wanted = server.wanted_force(state, steady_nanoseconds());
      if (wanted.x() > 0.0) forces.arrived(wanted.y() / wanted.x() / kSlope);
      icome::realtime::sleep_until(next + look * kPeriod / 10);
    }
    next = std::max(next + kPeriod, steady_nanoseconds());
  }
}

/// A servo at 1 kHz, which looks for a new state ten times a period.
void run_servo(PointerDevice& device, Stamps& states, Stamps& forces, int ticks) {
  std::int64_t next = steady_nanoseconds();
  PointerState state;
  for (int tick = 0; tick < ticks; ++tick) {
    const int number = 1 + tick % (kNumbers - 1);
    forces.note(number);
    device.write({1.0, kSlope * number, 0.0});
    for (int look = 1; look <= 10; ++look) {
      if (device.read(state) == DeviceStatus::Ok) states.arrived(state.position.x() / kStep);
      icome::realtime::sleep_until(next + look * kPeriod / 10);
    }
    next = std::max(next + kPeriod, steady_nanoseconds());
  }
}

void print_row(const char* name, std::vector<std::int64_t> delays) {
  std::sort(delays.begin(), delays.end());
  const auto quantile = [&](double share) {
    return delays.empty()
               ? 0.0
               : 1e-3 *
                     static_cast<double>(delays[static_cast<std::size_t>(share * double(delays.size() - 1))]);
  };
  std::printf("%-40s %9zu %12.0f %12.0f %12.0f\n", name, delays.size(), quantile(0.5), quantile(0.999),
              quantile(1.0));
}

}  // namespace

namespace icome::benchmarks {

void print_vrpn_delays(int ticks) {
  VrpnServerSettings settings;
  settings.port = 0;
  auto server = VrpnServer::create(settings);
  if (!server) return static_cast<void>(std::fprintf(stderr, "%s\n", server.error().message.c_str()));
  Stamps states;
  Stamps forces;
  std::atomic<bool> stop = false;
  std::thread device([&] { run_device(**server, states, forces, stop); });
  auto address = VrpnAddress::parse("Pointer0@" + (*server)->listening() + "?forces=fields");
  auto client = DrivenDevice::create(std::make_unique<VrpnDriver>(*address));
  if (client) run_servo(**client, states, forces, ticks);
  stop = true;
  device.join();
  if (!client) return static_cast<void>(std::fprintf(stderr, "%s\n", client.error().message.c_str()));
  std::printf("\n%-40s %9s %12s %12s %12s\n", "VRPN on this computer", "samples", "median us", "p99.9 us",
              "worst us");
  print_row("device -> server -> client's servo", states.delays);
  print_row("client's servo -> server -> device", forces.delays);
}

}  // namespace icome::benchmarks
