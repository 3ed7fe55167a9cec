#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/vector.h"

namespace icome::devices {

using base::Quaternion;
using base::Vector3;

/// The name that the service gives a device, such as 049D: letters, digits, '-', '_', '.' and ':' only, so
/// that it can stand in a command as it is.
class ServiceDeviceId {
 public:
  static constexpr std::size_t kLongest = 40;
  /// Sets the id; false, and unchanged, for a text that is no id. Real-time safe.
  bool set(std::string_view text);
  std::string_view text() const { return {letters_.data(), size_}; }
  /// Is the id this one, upper and lower case alike? Real-time safe.
  bool is(std::string_view text) const;

 private:
  std::array<char, kLongest> letters_ = {};
  std::size_t size_ = 0;
};

/// The state that the service has told of one Inverse3, in the service's axes.
struct ServiceArm {
  ServiceDeviceId id;
  Vector3 position = Vector3::Zero();  // m
  Vector3 velocity = Vector3::Zero();  // m/s
  std::uint8_t placed = 0;             // bits 0, 1, 2: x, y, z of the position have been told
  bool calibrated = true;
  bool powered = true;
  bool ready = true;
  std::uint64_t told = 0;  // number of the last message that mentioned it

  bool has_position() const { return placed == 7; }
};

/// The state that the service has told of one VerseGrip, wired or wireless.
struct ServiceGrip {
  ServiceDeviceId id;
  Quaternion orientation = Quaternion::Identity();
  std::uint32_t buttons = 0;  // wireless: a, b, c; wired: button, hall
};

/// All that the service's messages have told since the connection began: parts that a message leaves out keep
/// their last value. Owns its memory, which it takes when it is made. One thread uses it.
class ServiceState {
 public:
  static constexpr std::size_t kMostArms = 4;
  static constexpr std::size_t kMostGrips = 8;

  ServiceState();
  ~ServiceState();

  /// Takes a message, after which 64 more bytes may be read (WebSocket::kPadding), whatever they hold. False,
  /// and nothing of it counts, when it is no JSON throughout or a part that is used makes no sense. Real-time
  /// safe.
  bool take(std::string_view message);

  std::span<const ServiceArm> arms() const { return {told_.arms.devices.data(), told_.arms.count}; }
  /// The grip that belongs to an arm: the one of that id or, where that is empty, the wireless one or else
  /// the wired one in the arm's place; null without one. Real-time safe.
  const ServiceGrip* grip_of(std::size_t arm, std::string_view id) const;

  /// Messages that were taken, and that were refused.
  std::uint64_t taken() const { return told_.messages; }
  std::uint64_t refused() const { return refused_; }

  /// Devices of one kind. An entry without an id is of the device last named in its place.
  template <typename Device, std::size_t kMost>
  struct Listed {
    std::array<Device, kMost> devices = {};
    std::size_t count = 0;
    std::array<std::uint8_t, kMost> places = {};  // which device is meant there, + 1; 0: none yet
  };
  struct Told {
    Listed<ServiceArm, kMostArms> arms;
    Listed<ServiceGrip, kMostGrips> wired;
    Listed<ServiceGrip, kMostGrips> wireless;
    std::uint64_t messages = 0;
  };

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
  Told told_;
  Told next_;  // told_ with the additions of a message
  std::uint64_t refused_ = 0;
};

/// The service's answer to GET /version.
struct ServiceVersion {
  std::string text;  // "3.5.0", for people; empty: it does not tell
  int major = 0;     // 0: not known
  int minor = 0;
};
ServiceVersion read_service_version(std::string_view answer);

/// An event of the service.
struct ServiceEvent {
  std::string name;  // "device-safety-triggered"
  std::string category;
  std::string level;
  std::string device_family;  // of its data; empty: not told
  std::string device_id;
  std::string message;  // for people
};
/// The event of a message; nothing for a message that is none.
std::optional<ServiceEvent> read_service_event(std::string_view message);

}  // namespace icome::devices
