#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"

namespace icome::session {

using base::Vector3;

/// One tick of a device while it is tested.
struct ProbedTick {
  double t = 0.0;                      // s, since the first tick
  bool fresh = false;                  // the device gave a new reading
  Vector3 position = Vector3::Zero();  // m, of the newest reading
  Vector3 force = Vector3::Zero();     // N, as it was sent
};

struct DeviceTestSettings {
  double rate_hz = 1000.0;  // ticks a second
  double seconds = 2.0;     // s at rest
  double force = 0.0;       // N, the most that it pushes with; 0: no force is tried
};

/// Intervals between fresh readings, ms.
struct ReadingIntervals {
  double median = 0.0, p99 = 0.0, longest = 0.0;
};

/// The outcome of the device's pushes.
struct ForceTest {
  double strongest = 0.0;       // N
  double moved = 0.0;           // m, the farthest from rest
  std::optional<double> delay;  // s from a force to the motion that it makes; none: too little moved to tell
};

/// The findings of a test.
struct DeviceTestResult {
  std::uint64_t readings = 0;
  double rate_hz = 0.0;  // fresh readings a second, as far as the ticks can tell: no more than theirs
  ReadingIntervals interval_ms;
  Vector3 noise = Vector3::Zero();  // m, standard deviation at rest, slow drift taken out
  double moved = 0.0;               // m, the farthest way along an axis at rest
  bool was_still = true;            // at rest; else noise and delay tell nothing of the device
  std::uint64_t stalled = 0;        // ticks without a fresh reading
  std::uint64_t lost = 0;           // ticks in which the device was not there
  bool lost_at_end = false;         // it was not there in the last tick, which ended the test
  std::optional<ForceTest> force;
  std::vector<ProbedTick> ticks;
};

/// Tests a device in the caller's time: at rest, and then, if the settings say so, with a force that grows
/// slowly and with short pushes to and fro, from which the delay follows: a mass that is pushed from a time d
/// on has gone a way D at t1 and 4 D at t2, so d is 2 t1 - t2 whatever its mass. All forces go through the
/// limiter. `goes_on` is asked many times a second; false ends the test early, as does a device that has been
/// away for 3 s. Fails when the servo loop
/// cannot start or the device never reads.
base::Result<DeviceTestResult> test_device(devices::PointerDevice& device, const DeviceTestSettings& settings,
                                           const std::function<bool(double seconds, double all)>& goes_on);

/// The place and size of the workspace that a person has led the device through.
struct DeviceRange {
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();  // m, device frame
  Vector3 centre() const { return 0.5 * (low + high); }
};

/// Reads the device for some seconds without any force while a person leads it to the corners of its
/// workspace.
base::Result<DeviceRange> find_range(devices::PointerDevice& device, double rate_hz, double seconds,
                                     const std::function<bool(double seconds, double all)>& goes_on);

}  // namespace icome::session
