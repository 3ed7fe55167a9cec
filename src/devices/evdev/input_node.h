#pragma once
// The input devices of Linux (evdev), as far as the back-ends of this folder need them. Codes, types and
// values are those of linux/input-event-codes.h.
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <tl/expected.hpp>
#include <vector>

namespace icome::devices {

constexpr std::size_t kInputKeys = 0x300;     // KEY_CNT: keys and buttons
constexpr std::size_t kInputAxes = 0x40;      // ABS_CNT
constexpr std::size_t kInputRelative = 0x10;  // REL_CNT

struct InputEvent {
  std::int64_t time = 0;  // ns, steady clock
  std::uint16_t type = 0;
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

/// An absolute axis, in its device's counts.
struct InputAxis {
  std::int32_t least = 0;
  std::int32_t most = 0;        // a device may say less than `least`
  std::int32_t flat = 0;        // counts about the middle that mean rest
  std::int32_t resolution = 0;  // counts per mm, or per radian for tilts; 0: not told
};

/// The keys that are pressed, and the values of the absolute axes.
struct InputState {
  std::bitset<kInputKeys> keys;
  std::array<std::int32_t, kInputAxes> axes{};

  /// Takes in an event of a key or an axis; others, and unknown codes, change nothing.
  void take(const InputEvent& event);
};

/// A device's abilities, and its state when it was opened.
struct InputAbilities {
  std::string name;  // as it calls itself
  std::string path;  // of its node, without links
  std::bitset<kInputKeys> keys;
  std::bitset<kInputRelative> relative;
  std::array<std::optional<InputAxis>, kInputAxes> axes{};
  bool rumbles = false;         // it has FF_RUMBLE, and may be written to
  bool rumble_refused = false;  // it has FF_RUMBLE, but may only be read
  InputState state;
};

enum class InputTold : std::uint8_t {
  Event,    // the next event was given
  Nothing,  // no event is left for now
  Missed,   // the system dropped events (SYN_DROPPED): next_missed() tells the differences
  Gone,     // unplugged
};

/// An open input device. One thread uses it. A program has one of libevdev and tests have theirs.
class InputNode {
 public:
  virtual ~InputNode() = default;
  virtual const InputAbilities& abilities() const = 0;
  /// Waits until there is something to take, for that time at most, ms.
  virtual void wait(int milliseconds) = 0;
  /// The next event; never waits.
  virtual InputTold next(InputEvent& event) = 0;
  /// After Missed: the next difference of the state now from the events told; Nothing after the last.
  virtual InputTold next_missed(InputEvent& event) = 0;
  /// Rumbles by that strength, 0 to 1, for that time, ms, or until told otherwise.
  virtual std::error_code rumble(double strength, int milliseconds) = 0;
};

/// The input devices of a system.
class InputSystem {
 public:
  virtual ~InputSystem() = default;
  /// The folder that nodes are looked for in.
  virtual const std::string& folder() const = 0;
  /// Paths of the nodes there are, in the order of their numbers.
  virtual tl::expected<std::vector<std::string>, std::error_code> nodes() = 0;
  virtual tl::expected<std::unique_ptr<InputNode>, std::error_code> open(const std::string& path) = 0;
};

}  // namespace icome::devices
