#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.h"

namespace icome::devices::vrpn {

using base::Quaternion;
using base::Vector3;

// The wire of VRPN (version 07.38), TCP. Each side first sends a cookie, then messages: a header of six
// big-endian numbers of 32 bits (length of header and payload, seconds, microseconds, sender, type,
// sequence), the payload, and zeros up to the next multiple of 8 bytes. Sender and type are numbers of the
// side that sends; it tells their names first, by messages of the types -1 and -2 whose `sender` is the
// number. Units are metres, seconds and newtons.

constexpr int kPort = 3883;
constexpr std::size_t kCookieSize = 24;
constexpr std::size_t kHeaderSize = 24;
/// Bytes, with header and padding; a stock peer's buffers hold 64,000 bytes.
constexpr std::size_t kLongestMessage = 65536;
constexpr std::size_t kLongestName = 100;

constexpr std::int32_t kSenderDescription = -1;
constexpr std::int32_t kTypeDescription = -2;
constexpr std::int32_t kDisconnect = -5;

/// The bytes that each side sends first.
std::array<char, kCookieSize> cookie();
/// Can we talk with a side that sent these bytes? The text up to its last dot must be ours, as that is the
/// version that tells of changes to the wire; the rest does not matter.
bool cookie_fits(std::string_view bytes);

/// The types of messages that we know, by name on the wire. The number that we give a type is its place here.
enum class Kind : std::uint8_t {
  PosQuat,
  Velocity,
  ButtonChange,
  ButtonStates,
  AnalogChannel,
  Force,
  Plane,
  ForceField,
  Ping,
  Pong,
  Unknown,  // the last
};
constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::Unknown);

std::string_view name_of(Kind kind);
Kind kind_named(std::string_view name);

/// A message as it was received; `payload` lies in the decoder's memory.
struct Message {
  std::int32_t sender = 0;
  std::int32_t type = 0;
  std::int64_t time = 0;  // microseconds, the sender's clock
  std::string_view payload;
};

// Payloads.
struct PosQuat {
  std::int32_t sensor = 0;
  Vector3 position = Vector3::Zero();               // m
  Quaternion orientation = Quaternion::Identity();  // x, y, z, w on the wire
};
struct Velocity {
  std::int32_t sensor = 0;
  Vector3 velocity = Vector3::Zero();  // m/s; followed by a turn (x, y, z, w) in an interval (s)
};
struct Button {
  std::int32_t button = 0;
  bool down = false;
};
/// Forces that the server renders: out of the half space where normal . x + offset < 0.
struct Plane {
  Vector3 normal = Vector3::Zero();  // zero: no plane
  double offset = 0.0;               // m, if the normal has length 1
  double spring = 0.0;               // units of the server
  double damper = 0.0;
  double dynamic_friction = 0.0;
  double static_friction = 0.0;
  std::int32_t index = 0;
  std::int32_t recovery = 0;  // cycles of the server's loop in which it comes to its place
};
/// force + jacobian (x - origin), N, within the radius.
struct ForceField {
  Vector3 origin = Vector3::Zero();                // m
  Vector3 force = Vector3::Zero();                 // N
  base::Matrix3 jacobian = base::Matrix3::Zero();  // N/m, row by row on the wire
  double radius = 0.0;                             // m; 0: no field
};

// Readers of payloads: nothing when they are too short. Numbers may be any, also none. Real-time safe.
std::optional<PosQuat> read_pos_quat(std::string_view payload);
std::optional<Velocity> read_velocity(std::string_view payload);
std::optional<Button> read_button(std::string_view payload);
/// The states of the first 32 buttons, bit i: button i is down.
std::optional<std::uint32_t> read_buttons(std::string_view payload);
/// The value of one channel.
std::optional<double> read_channel(std::string_view payload, int channel);
std::optional<Plane> read_plane(std::string_view payload);
std::optional<ForceField> read_force_field(std::string_view payload);
/// The name that a description tells.
std::optional<std::string_view> read_name(std::string_view payload);

/// A payload that is written, number by number. Real-time safe.
class Payload {
 public:
  Payload& put(std::int32_t number);
  Payload& put(float number);
  Payload& put(double number);
  Payload& put(const Vector3& vector);         // three doubles
  Payload& put(const Quaternion& quaternion);  // x, y, z, w
  std::string_view bytes() const { return {bytes_.data(), size_}; }

 private:
  static constexpr std::size_t kRoom = 192;
  template <typename Number>
  Payload& append(Number number);

  std::array<char, kRoom> bytes_;
  std::size_t size_ = 0;
};
Payload pack(const PosQuat& pose);
Payload pack(const Velocity& velocity);
Payload pack(const Button& button);
Payload pack_buttons(std::uint32_t buttons, int count);
Payload pack(const Plane& plane);
Payload pack(const ForceField& field);

/// Messages on their way to a socket, in memory that is taken once.
class Outbox {
 public:
  explicit Outbox(std::size_t capacity = 1 << 16) : bytes_(capacity) {}

  /// Appends the cookie, a message, or the description of a number; false, and nothing of it, where there is
  /// no room. Real-time safe.
  bool put_cookie();
  bool put(std::int32_t sender, std::int32_t type, std::string_view payload);
  bool put(std::int32_t sender, Kind kind, std::string_view payload) {
    return put(sender, static_cast<std::int32_t>(kind), payload);
  }
  bool describe(std::int32_t what, std::int32_t number, std::string_view name);
  bool describe(Kind kind);
  /// Describes every Kind.
  bool describe_kinds();

  std::string_view waiting() const { return {bytes_.data() + begin_, end_ - begin_}; }
  /// Drops so many of the waiting bytes, which were sent.
  void sent(std::size_t count);

 private:
  char* room_for(std::size_t count);

  std::vector<char> bytes_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint32_t sequence_ = 0;
};

/// Takes a peer's bytes as they come, in pieces of any size, and gives its messages, in memory that is taken
/// once. Bytes that are no VRPN end it. Real-time safe, but for the constructor.
class Decoder {
 public:
  Decoder() : bytes_(2 * kLongestMessage) {}

  /// Room for the next bytes, at least kLongestMessage of them once next() gave More; messages that were
  /// given are invalid from here on.
  std::span<char> room();
  void received(std::size_t count) { end_ += count; }

  enum class Step : std::uint8_t { More, Message, Broken };
  /// The next message; More: more bytes are needed; Broken: this is no VRPN, or another version's.
  Step next(Message& message);
  bool greeted() const { return greeted_; }

 private:
  std::vector<char> bytes_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool greeted_ = false;
  bool broken_ = false;
};

/// The meanings of a peer's numbers, as far as it has told them. Memory is bounded, whatever is told.
class PeerNames {
 public:
  PeerNames() : kinds_(kMostTypes, Kind::Unknown) {}

  /// Takes note of a description; does nothing with other messages.
  void learn(const Message& message);
  Kind kind(std::int32_t type) const;
  /// The name of a sender; empty when unknown.
  std::string_view sender(std::int32_t number) const;
  const std::vector<std::string>& senders() const { return senders_; }
  bool knows(Kind kind) const { return known_[static_cast<std::size_t>(kind)]; }

 private:
  static constexpr std::int32_t kMostTypes = 2000;   // a stock peer has no more
  static constexpr std::int32_t kMostSenders = 512;  // a stock peer has 2000

  std::vector<Kind> kinds_;
  std::vector<std::string> senders_;
  std::array<bool, kKinds + 1> known_ = {};
};

}  // namespace icome::devices::vrpn
