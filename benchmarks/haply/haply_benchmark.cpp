// Round trips with a fake of Haply's Inverse Service on this machine: a force is sent, the answer says where
// the arm is, and the servo may have it. One table: as long as our driver takes for that, and a bare
// WebSocket that sends the same message and looks at no answer; both at the rates at which the service is
// used. What the fake itself takes is in both. `--quick` is a tenth of it.
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/clock.h"
#include "devices/driver/driver_link.h"
#include "devices/fakes/fake_inverse_service.h"
#include "devices/haply/haply_driver.h"
#include "realtime/guard/guard.h"
#include "realtime/histogram.h"
#include "realtime/loop.h"
#include "realtime/this_thread.h"

namespace {

using namespace icome;
using devices::Vector3;

[[noreturn]] void give_up(const std::string& why) {
  fmt::print(stderr, "haply benchmark: {}\n", why);
  std::exit(EXIT_FAILURE);
}

struct Measured {
  realtime::DurationHistogram trips;
  std::uint64_t late = 0;  // deadlines that were skipped
  std::uint64_t allocations = 0;
};

/// Calls `trip` at a rate (Hz), the first tenth for warming up.
template <typename Trip>
void measure(double rate, int count, Measured& measured, Trip&& trip) {
  for (int i = 0; i < count / 10; ++i) trip();
  const realtime::Timetable timetable(base::steady_nanoseconds(), rate);
  realtime::RealtimeGuard guard;
  std::uint64_t index = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t next = timetable.next(index, base::steady_nanoseconds());
    measured.late += next - index - 1;
    index = next;
    realtime::sleep_until(timetable.deadline(index));
    const std::int64_t begin = base::steady_nanoseconds();
    trip();
    measured.trips.add(base::steady_nanoseconds() - begin);
  }
  guard.stop();
  measured.allocations = guard.allocations();
}

devices::HaplySettings settings_of(const devices::fakes::FakeInverseService& fake) {
  devices::HaplySettings settings;
  settings.service = {"127.0.0.1", fake.port()};
  settings.events_port = 0;
  settings.patience = settings.connect_patience = 10.0;
  return settings;
}

void measure_driver(const devices::fakes::FakeInverseService& fake, double rate, int count,
                    Measured& measured) {
  devices::HaplyDriver driver(settings_of(fake));
  const auto info = driver.open();
  if (!info) give_up(info.error().message);
  devices::DriverLink link(*info);
  link.connect(*info);
  devices::PointerState state;
  measure(rate, count, measured, [&] {
    link.write({0.5, 0.0, 0.0}, base::steady_nanoseconds());
    if (!driver.exchange(link)) give_up("the fake is lost");
    link.read(state);
  });
  driver.close();
}

void measure_socket(const devices::fakes::FakeInverseService& fake, double rate, int count,
                    Measured& measured) {
  auto socket = devices::WebSocket::connect({"127.0.0.1", fake.port()}, 10.0);
  if (!socket) give_up(socket.error().message);
  devices::ForceCommand command("049D", "vector");
  const std::string_view text = command.write({0.5, 0.0, 0.0}, false);
  measure(rate, count, measured, [&] {
    const std::int64_t deadline = base::steady_nanoseconds() + 10'000'000'000;
    if (!(*socket)->send(text, deadline) || !(*socket)->receive(deadline)) give_up((*socket)->why());
  });
}

void print_row(std::string_view way, double rate, const Measured& measured, int count) {
  fmt::print("{:<16} {:>6.0f} {:>12.1f} {:>12.1f} {:>10.2f} {:>12}\n", way, rate,
             1e-3 * measured.trips.quantile(0.5), 1e-3 * measured.trips.quantile(0.999),
             100.0 * double(measured.late) / count, measured.allocations);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  const devices::fakes::FakeInverseService fake;
  fmt::print("{:<16} {:>6} {:>12} {:>12} {:>10} {:>12}\n", "round trip", "Hz", "median us", "p99.9 us",
             "skipped %", "allocations");
  for (const double rate : {1000.0, 2000.0, 4000.0}) {
    const int count = int(rate * (quick ? 0.5 : 5.0));
    Measured socket;
    measure_socket(fake, rate, count, socket);
    print_row("bare WebSocket", rate, socket, count);
    Measured driver;
    measure_driver(fake, rate, count, driver);
    print_row("driver", rate, driver, count);
  }
}
