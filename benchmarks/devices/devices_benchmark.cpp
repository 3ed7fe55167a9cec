// Delays through the fakes of device back-ends: from a move of the hand until the motors have the force that
// answers it; with our layers and without. No real device is asked.
#include <cstdio>
#include <cstring>

#include "device_figures.h"

namespace {

using icome::benchmarks::DelayRow;

void print(const std::vector<DelayRow>& rows) {
  for (const DelayRow& row : rows) {
    std::printf("%-15s %-25s %8.0f %11.0f %11.0f", row.backend.c_str(), row.way.c_str(), row.rate,
                row.us.median, row.us.p999);
    if (row.direct_us > 0.0)
      std::printf(" %11.0f\n", row.us.median - row.direct_us);
    else
      std::printf(" %11s\n", "-");
  }
}

}  // namespace

int main(int count, char** arguments) {
  const bool is_quick = count > 1 && std::strcmp(arguments[1], "--quick") == 0;
  const int trips = is_quick ? 100 : 3000;
  std::printf("Hand to motors, through fakes, %d round trips each\n", trips);
  std::printf("%-15s %-25s %8s %11s %11s %11s\n", "back-end", "way", "Hz", "median us", "p99.9 us",
              "added us");
  print(icome::benchmarks::openhaptics_rows(trips));
  print(icome::benchmarks::forcedimension_rows(trips));
  print(icome::benchmarks::haply_rows(trips));
  icome::benchmarks::print_vrpn_delays(3 * trips);
}
