#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "devices/pointer_device.h"

namespace icome::benchmarks {

/// The fake behind a device, whose arm is held in place. Any thread.
struct FakeEnd {
  std::function<void(double x)> move;         // m
  std::function<double()> force;              // N, along x, that the motors were told last
  std::function<std::int64_t()> force_since;  // ns, steady clock, of that force's last change
};

/// The pace at which the servo calls the device.
enum class ServoPace : std::uint8_t {
  AtOnce,     // reads every 20 us, so that the way to it and back is measured
  Kilohertz,  // on a timer of its own, as ours is
};

/// The force that answers a place: 1 N a millimetre, which no two places of a round trip share.
inline double answer_to(double x) { return 1000.0 * x; }

/// Round trips, ns: the hand moves, a servo answers with a force, and the motors have it. The device has its
/// full force. Empty where the device gives no reading or no force for some seconds.
std::vector<std::int32_t> round_trips(devices::PointerDevice& device, const FakeEnd& fake, ServoPace pace,
                                      int count);

/// Round trips, ns, where some other thread answers.
std::vector<std::int32_t> timed_answers(const FakeEnd& fake, int count);

}  // namespace icome::benchmarks
