#include "devices/vrpn/protocol.h"

#include <time.h>

#include <algorithm>
#include <cstring>

#include "io/byte_order.h"

namespace icome::devices::vrpn {
namespace {

constexpr std::string_view kGreeting = "vrpn: ver. 07.38  0";
constexpr std::array<std::string_view, kKinds> kNames = {
    "vrpn_Tracker Pos_Quat",  "vrpn_Tracker Velocity",        "vrpn_Button Change",
    "vrpn_Button States",     "vrpn_Analog Channel",          "vrpn_ForceDevice Force",
    "vrpn_ForceDevice Plane", "vrpn_ForceDevice Force_Field", "vrpn_Base ping_message",
    "vrpn_Base pong_message",
};
constexpr io::ByteOrder kNetwork = io::ByteOrder::BigEndian;
constexpr int kButtonBits = 32;

/// Reads a payload from its beginning; its end must have been looked at before.
class PayloadReader {
 public:
  explicit PayloadReader(std::string_view payload) : at_(payload.data()) {}

  template <typename Number>
  Number take() {
    const Number number = io::load<Number>(at_, kNetwork);
    at_ += sizeof(Number);
    return number;
  }
  /// Three numbers; of a type, as argument lists have no order.
  template <typename Number>
  Vector3 take_vector() {
    Vector3 vector;
    for (int i = 0; i < 3; ++i) vector[i] = static_cast<double>(take<Number>());
    return vector;
  }
  Quaternion take_quaternion() {
    Quaternion quaternion;
    for (int i = 0; i < 4; ++i) quaternion.coeffs()[i] = take<double>();
    return quaternion;
  }

 private:
  const char* at_;
};

constexpr std::size_t padded(std::size_t length) { return (length + 7) / 8 * 8; }

}  // namespace

std::array<char, kCookieSize> cookie() {
  std::array<char, kCookieSize> bytes = {};
  std::copy(kGreeting.begin(), kGreeting.end(), bytes.begin());
  return bytes;
}

bool cookie_fits(std::string_view bytes) {
  return bytes.starts_with(kGreeting.substr(0, kGreeting.rfind('.') + 1));
}

std::string_view name_of(Kind kind) { return kNames.at(static_cast<std::size_t>(kind)); }

Kind kind_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  return static_cast<Kind>(found - kNames.begin());
}

std::optional<PosQuat> read_pos_quat(std::string_view payload) {
  if (payload.size() < 64) return std::nullopt;
  PayloadReader reader(payload);
  PosQuat pose;
  pose.sensor = reader.take<std::int32_t>();
  reader.take<std::int32_t>();
  pose.position = reader.take_vector<double>();
  pose.orientation = reader.take_quaternion();
  return pose;
}

std::optional<Velocity> read_velocity(std::string_view payload) {
  if (payload.size() < 72) return std::nullopt;
  PayloadReader reader(payload);
  Velocity velocity;
  velocity.sensor = reader.take<std::int32_t>();
  reader.take<std::int32_t>();
  velocity.velocity = reader.take_vector<double>();
  return velocity;
}

std::optional<Button> read_button(std::string_view payload) {
  if (payload.size() < 8) return std::nullopt;
  PayloadReader reader(payload);
  Button button;
  button.button = reader.take<std::int32_t>();
  button.down = reader.take<std::int32_t>() != 0;
  return button;
}

std::optional<std::uint32_t> read_buttons(std::string_view payload) {
  if (payload.size() < 4) return std::nullopt;
  PayloadReader reader(payload);
  const auto count = reader.take<std::int32_t>();
  if (count < 0 || payload.size() / 4 - 1 < static_cast<std::size_t>(count)) return std::nullopt;
  std::uint32_t buttons = 0;
  for (int i = 0; i < std::min(count, kButtonBits); ++i) {
    if (reader.take<std::int32_t>() != 0) buttons |= 1U << i;
  }
  return buttons;
}

std::optional<double> read_channel(std::string_view payload, int channel) {
  if (channel < 0 || payload.size() / 8 < static_cast<std::size_t>(channel) + 2) return std::nullopt;
  const auto count = io::load<double>(payload.data(), kNetwork);
  if (!(count > channel)) return std::nullopt;
  return io::load<double>(payload.data() + 8 * (static_cast<std::size_t>(channel) + 1), kNetwork);
}

std::optional<Plane> read_plane(std::string_view payload) {
  if (payload.size() < 40) return std::nullopt;
  PayloadReader reader(payload);
  Plane plane;
  plane.normal = reader.take_vector<float>();
  for (double* number :
       {&plane.offset, &plane.spring, &plane.damper, &plane.dynamic_friction, &plane.static_friction})
    *number = static_cast<double>(reader.take<float>());
  plane.index = reader.take<std::int32_t>();
  plane.recovery = reader.take<std::int32_t>();
  return plane;
}

std::optional<ForceField> read_force_field(std::string_view payload) {
  if (payload.size() < 64) return std::nullopt;
  PayloadReader reader(payload);
  ForceField field;
  field.origin = reader.take_vector<float>();
  field.force = reader.take_vector<float>();
  for (int row = 0; row < 3; ++row) field.jacobian.row(row) = reader.take_vector<float>();
  field.radius = static_cast<double>(reader.take<float>());
  return field;
}

std::optional<std::string_view> read_name(std::string_view payload) {
  if (payload.size() < 4) return std::nullopt;
  const auto length = io::load<std::int32_t>(payload.data(), kNetwork);
  payload.remove_prefix(4);
  if (length < 1 || static_cast<std::size_t>(length) > payload.size()) return std::nullopt;
  const std::string_view name = payload.substr(0, std::min<std::size_t>(payload.find('\0'), length));
  if (name.empty() || name.size() > kLongestName) return std::nullopt;
  return name;
}

template <typename Number>
Payload& Payload::append(Number number) {
  if (size_ + sizeof(number) > kRoom) return *this;
  io::store(number, kNetwork, bytes_.data() + size_);
  size_ += sizeof(number);
  return *this;
}

Payload& Payload::put(std::int32_t number) { return append(number); }
Payload& Payload::put(float number) { return append(number); }
Payload& Payload::put(double number) { return append(number); }
Payload& Payload::put(const Vector3& vector) { return put(vector.x()).put(vector.y()).put(vector.z()); }
Payload& Payload::put(const Quaternion& quaternion) {
  return put(quaternion.x()).put(quaternion.y()).put(quaternion.z()).put(quaternion.w());
}

Payload pack(const PosQuat& pose) {
  return Payload().put(pose.sensor).put(pose.sensor).put(pose.position).put(pose.orientation);
}

Payload pack(const Velocity& velocity) {
  // No turn, in an interval of 1 s: a reader that divides by it finds no rotation.
  return Payload()
      .put(velocity.sensor)
      .put(velocity.sensor)
      .put(velocity.velocity)
      .put(Quaternion::Identity())
      .put(1.0);
}

Payload pack(const Button& button) {
  return Payload().put(button.button).put(button.down ? std::int32_t{1} : std::int32_t{0});
}

Payload pack_buttons(std::uint32_t buttons, int count) {
  count = std::clamp(count, 0, kButtonBits);
  Payload result;
  result.put(std::int32_t{count});
  for (int i = 0; i < count; ++i) result.put(static_cast<std::int32_t>((buttons >> i) & 1U));
  return result;
}

Payload pack(const Plane& plane) {
  Payload result;
  for (int i = 0; i < 3; ++i) result.put(static_cast<float>(plane.normal[i]));
  for (const double number :
       {plane.offset, plane.spring, plane.damper, plane.dynamic_friction, plane.static_friction})
    result.put(static_cast<float>(number));
  return result.put(plane.index).put(plane.recovery);
}

Payload pack(const ForceField& field) {
  Payload result;
  for (int i = 0; i < 3; ++i) result.put(static_cast<float>(field.origin[i]));
  for (int i = 0; i < 3; ++i) result.put(static_cast<float>(field.force[i]));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) result.put(static_cast<float>(field.jacobian(row, column)));
  return result.put(static_cast<float>(field.radius));
}

char* Outbox::room_for(std::size_t count) {
  if (begin_ == end_) begin_ = end_ = 0;
  if (bytes_.size() - end_ < count && begin_ > 0) {
    std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (bytes_.size() - end_ < count) return nullptr;
  char* room = bytes_.data() + end_;
  end_ += count;
  return room;
}

bool Outbox::put_cookie() {
  char* at = room_for(kCookieSize);
  if (at == nullptr) return false;
  std::memcpy(at, cookie().data(), kCookieSize);
  return true;
}

bool Outbox::put(std::int32_t sender, std::int32_t type, std::string_view payload) {
  const std::size_t length = kHeaderSize + payload.size();
  char* at = room_for(padded(length));
  if (at == nullptr) return false;
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  io::store(static_cast<std::uint32_t>(length), kNetwork, at);
  io::store(static_cast<std::uint32_t>(now.tv_sec), kNetwork, at + 4);
  io::store(static_cast<std::uint32_t>(now.tv_nsec / 1000), kNetwork, at + 8);
  io::store(sender, kNetwork, at + 12);
  io::store(type, kNetwork, at + 16);
  io::store(sequence_++, kNetwork, at + 20);
  std::copy(payload.begin(), payload.end(), at + kHeaderSize);
  std::fill(at + length, at + padded(length), '\0');
  return true;
}

bool Outbox::describe(std::int32_t what, std::int32_t number, std::string_view name) {
  std::array<char, 4 + kLongestName + 1> bytes = {};
  name = name.substr(0, kLongestName);
  io::store(static_cast<std::int32_t>(name.size() + 1), kNetwork, bytes.data());
  std::copy(name.begin(), name.end(), bytes.begin() + 4);
  return put(number, what, {bytes.data(), 4 + name.size() + 1});
}

bool Outbox::describe(Kind kind) {
  return describe(kTypeDescription, static_cast<std::int32_t>(kind), name_of(kind));
}

bool Outbox::describe_kinds() {
  for (std::size_t i = 0; i < kKinds; ++i) {
    if (!describe(static_cast<Kind>(i))) return false;
  }
  return true;
}

void Outbox::sent(std::size_t count) { begin_ += std::min(count, end_ - begin_); }

std::span<char> Decoder::room() {
  if (begin_ == end_) begin_ = end_ = 0;
  if (bytes_.size() - end_ < kLongestMessage) {
    std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  return std::span(bytes_).subspan(end_);
}

Decoder::Step Decoder::next(Message& message) {
  if (broken_) return Step::Broken;
  const auto give_up = [this] {
    broken_ = true;
    return Step::Broken;
  };
  if (!greeted_) {
    if (end_ - begin_ < kCookieSize) return Step::More;
    if (!cookie_fits({bytes_.data() + begin_, kCookieSize})) return give_up();
    begin_ += kCookieSize;
    greeted_ = true;
  }
  if (end_ - begin_ < kHeaderSize) return Step::More;
  const char* at = bytes_.data() + begin_;
  const std::size_t length = io::load<std::uint32_t>(at, kNetwork);
  if (length < kHeaderSize || padded(length) > kLongestMessage) return give_up();
  if (end_ - begin_ < padded(length)) return Step::More;
  message.time = std::int64_t{io::load<std::uint32_t>(at + 4, kNetwork)} * 1'000'000 +
                 io::load<std::uint32_t>(at + 8, kNetwork);
  message.sender = io::load<std::int32_t>(at + 12, kNetwork);
  message.type = io::load<std::int32_t>(at + 16, kNetwork);
  message.payload = {at + kHeaderSize, length - kHeaderSize};
  begin_ += padded(length);
  return Step::Message;
}

void PeerNames::learn(const Message& message) {
  const std::int32_t number = message.sender;
  if (number < 0) return;
  const auto name = read_name(message.payload);
  if (!name) return;
  if (message.type == kTypeDescription && number < kMostTypes) {
    const Kind kind = kind_named(*name);
    kinds_[static_cast<std::size_t>(number)] = kind;
    known_[static_cast<std::size_t>(kind)] = true;
  } else if (message.type == kSenderDescription && number < kMostSenders) {
    if (senders_.size() <= static_cast<std::size_t>(number))
      senders_.resize(static_cast<std::size_t>(number) + 1);
    senders_[static_cast<std::size_t>(number)] = *name;
  }
}

Kind PeerNames::kind(std::int32_t type) const {
  return type >= 0 && type < kMostTypes ? kinds_[static_cast<std::size_t>(type)] : Kind::Unknown;
}

std::string_view PeerNames::sender(std::int32_t number) const {
  if (number < 0 || static_cast<std::size_t>(number) >= senders_.size()) return {};
  return senders_[static_cast<std::size_t>(number)];
}

}  // namespace icome::devices::vrpn
