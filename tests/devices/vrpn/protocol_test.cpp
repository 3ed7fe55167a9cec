#include "devices/vrpn/protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "devices/vrpn/remote_forces.h"
#include "devices/vrpn/tracker_readings.h"
#include "realtime/guard/guard.h"
#include "repeats.h"

namespace icome::devices::vrpn {
namespace {

using std::string_literals::operator""s;

// Messages written by hand, byte by byte.
const std::string kHandCookie = "vrpn: ver. 07.38  0\0\0\0\0\0"s;
// length 37, 2 s, 3 microseconds, sender 1, type -1, sequence 0, then 9 and the name with its zero, padded.
const std::string kHandSender =
    "\x00\x00\x00\x25\x00\x00\x00\x02\x00\x00\x00\x03\x00\x00\x00\x01\xff\xff\xff\xff\x00\x00\x00\x00"
    "\x00\x00\x00\x09Tracker0\x00\x00\x00\x00"s;
const std::string kHandType =
    "\x00\x00\x00\x32\x00\x00\x00\x02\x00\x00\x00\x03\x00\x00\x00\x04\xff\xff\xff\xfe\x00\x00\x00\x01"
    "\x00\x00\x00\x16vrpn_Tracker Pos_Quat\x00\x00\x00\x00\x00\x00\x00"s;
// Sensor 2 at (1, -2, 0.5), turned half about z: quaternion (0, 0, 1, 0).
const std::string kHandPose =
    "\x00\x00\x00\x58\x00\x00\x00\x05\x00\x00\x00\x07\x00\x00\x00\x01\x00\x00\x00\x04\x00\x00\x00\x02"
    "\x00\x00\x00\x02\x00\x00\x00\x02"
    "\x3f\xf0\x00\x00\x00\x00\x00\x00\xc0\x00\x00\x00\x00\x00\x00\x00\x3f\xe0\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x3f\xf0\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00"s;
// A plane (0, 1, 0, -0.5), spring 0.5, damping 0.25, friction 1 and 2, index 3, 10 cycles.
const std::string kHandPlane =
    "\x00\x00\x00\x00\x3f\x80\x00\x00\x00\x00\x00\x00\xbf\x00\x00\x00"
    "\x3f\x00\x00\x00\x3e\x80\x00\x00\x3f\x80\x00\x00\x40\x00\x00\x00\x00\x00\x00\x03\x00\x00\x00\x0a"s;

std::string hand_stream() { return kHandCookie + kHandSender + kHandType + kHandPose + kHandPose; }

/// Gives a decoder bytes as a socket would.
void give(Decoder& decoder, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::span<char> room = decoder.room();
    const std::size_t count = std::min(room.size(), bytes.size());
    std::copy_n(bytes.begin(), count, room.begin());
    decoder.received(count);
    bytes.remove_prefix(count);
  }
}

/// All messages that are whole, as text.
std::string taken(Decoder& decoder) {
  std::string text;
  Message message;
  while (decoder.next(message) == Decoder::Step::Message) {
    text += std::to_string(message.sender) + " " + std::to_string(message.type) + " " +
            std::to_string(message.time) + " " + std::to_string(message.payload.size()) + " " +
            std::string(message.payload) + "\n";
  }
  return text;
}

/// A written message without its time, which nobody knows beforehand.
std::string without_time(std::string_view message) {
  std::string text(message);
  for (std::size_t i = 4; i < 12; ++i) text.at(i) = 0;
  return text;
}

TEST(VrpnProtocol, ReadsAStreamWrittenByHand) {
  Decoder decoder;
  give(decoder, hand_stream());
  Message message;
  PeerNames names;
  ASSERT_EQ(decoder.next(message), Decoder::Step::Message);
  names.learn(message);
  EXPECT_EQ(names.sender(1), "Tracker0");
  ASSERT_EQ(decoder.next(message), Decoder::Step::Message);
  names.learn(message);
  EXPECT_EQ(names.kind(4), Kind::PosQuat);
  EXPECT_TRUE(names.knows(Kind::PosQuat));
  EXPECT_FALSE(names.knows(Kind::Plane));
  ASSERT_EQ(decoder.next(message), Decoder::Step::Message);
  EXPECT_EQ(message.time, 5'000'007);
  EXPECT_EQ(message.sender, 1);
  EXPECT_EQ(message.type, 4);
  const auto pose = read_pos_quat(message.payload);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->sensor, 2);
  EXPECT_EQ(pose->position, Vector3(1, -2, 0.5));
  EXPECT_EQ(pose->orientation.coeffs(), Eigen::Vector4d(0, 0, 1, 0));
  ASSERT_EQ(decoder.next(message), Decoder::Step::Message);
  EXPECT_EQ(decoder.next(message), Decoder::Step::More);
}

TEST(VrpnProtocol, WritesWhatIsWrittenByHand) {
  Outbox outbox;
  ASSERT_TRUE(outbox.put_cookie());
  EXPECT_EQ(outbox.waiting(), kHandCookie);
  outbox.sent(kCookieSize);
  ASSERT_TRUE(outbox.describe(kSenderDescription, 1, "Tracker0"));
  EXPECT_EQ(without_time(outbox.waiting()), without_time(kHandSender));
  outbox.sent(outbox.waiting().size());
  ASSERT_TRUE(outbox.describe(kTypeDescription, 4, "vrpn_Tracker Pos_Quat"));
  EXPECT_EQ(without_time(outbox.waiting()), without_time(kHandType));
  outbox.sent(outbox.waiting().size());
  ASSERT_TRUE(outbox.put(1, 4, pack(PosQuat{2, {1, -2, 0.5}, Quaternion(0, 0, 0, 1)}).bytes()));
  EXPECT_EQ(without_time(outbox.waiting()), without_time(kHandPose));
}

TEST(VrpnProtocol, PlaneIsReadAndWrittenAsByHand) {
  const auto plane = read_plane(kHandPlane);
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->normal, Vector3(0, 1, 0));
  EXPECT_EQ(plane->offset, -0.5);
  EXPECT_EQ(plane->spring, 0.5);
  EXPECT_EQ(plane->damper, 0.25);
  EXPECT_EQ(plane->dynamic_friction, 1.0);
  EXPECT_EQ(plane->static_friction, 2.0);
  EXPECT_EQ(plane->index, 3);
  EXPECT_EQ(plane->recovery, 10);
  EXPECT_EQ(pack(*plane).bytes(), kHandPlane);
}

TEST(VrpnProtocol, PayloadsComeBack) {
  ForceField field;
  field.origin = {1, 2, 3};
  field.force = {-1, 0.5, 4};
  field.jacobian << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  field.radius = 0.25;
  const Payload bytes = pack(field);
  ASSERT_EQ(bytes.bytes().size(), 64U);
  const auto read = read_force_field(bytes.bytes());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->origin, field.origin);
  EXPECT_EQ(read->force, field.force);
  EXPECT_EQ(read->jacobian, field.jacobian);
  EXPECT_EQ(read->radius, field.radius);
  EXPECT_EQ(read_velocity(pack(Velocity{1, {3, 4, 5}}).bytes())->velocity, Vector3(3, 4, 5));
  EXPECT_EQ(pack(Velocity{}).bytes().size(), 72U);
  EXPECT_EQ(pack(Button{3, true}).bytes(), "\x00\x00\x00\x03\x00\x00\x00\x01"s);
  EXPECT_TRUE(read_button("\x00\x00\x00\x03\x00\x00\x00\x01"s)->down);
  EXPECT_EQ(read_buttons(pack_buttons(0b101, 3).bytes()), 0b101U);
  const Payload channels = Payload().put(2.0).put(0.25).put(-2.0);  // their number first
  EXPECT_EQ(read_channel(channels.bytes(), 1), -2.0);
  EXPECT_EQ(read_channel(channels.bytes(), 2), std::nullopt);
}

TEST(VrpnProtocol, ShortPayloadsAreRefused) {
  const std::string longest(64, '\1');
  for (std::size_t size = 0; size < 40; ++size) {
    const std::string_view bytes = std::string_view(longest).substr(0, size);
    EXPECT_FALSE(read_plane(bytes));
    EXPECT_FALSE(read_pos_quat(bytes));
    EXPECT_FALSE(read_force_field(bytes));
    EXPECT_FALSE(read_velocity(bytes));
    EXPECT_EQ(read_button(bytes).has_value(), size >= 8);
  }
  EXPECT_FALSE(read_buttons("\x7f\xff\xff\xff\x00\x00\x00\x01"s)) << "more states than bytes";
  EXPECT_FALSE(read_buttons("\xff\xff\xff\xff"s));
  EXPECT_FALSE(read_name("\x00\x00\x00\x09Tracker"s)) << "longer than the payload";
  EXPECT_FALSE(read_name("\x00\x00\x00\x01\x00"s)) << "empty";
  EXPECT_EQ(read_name("\x00\x00\x00\x02q\x00"s), "q");
}

TEST(VrpnProtocol, BytesMayComeInAnyPieces) {
  const std::string stream = hand_stream();
  Decoder whole;
  give(whole, stream);
  const std::string expected = taken(whole);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    Decoder decoder;
    give(decoder, std::string_view(stream).substr(0, cut));
    std::string text = taken(decoder);
    give(decoder, std::string_view(stream).substr(cut));
    EXPECT_EQ(text + taken(decoder), expected) << "cut at " << cut;
  }
  Decoder decoder;
  std::string text;
  for (const char byte : stream) {
    give(decoder, {&byte, 1});
    text += taken(decoder);
  }
  EXPECT_EQ(text, expected);
}

TEST(VrpnProtocol, OnlyTheVersionUpToTheLastDotCounts) {
  EXPECT_TRUE(cookie_fits("vrpn: ver. 07.35  1"));
  EXPECT_FALSE(cookie_fits("vrpn: ver. 08.38  0"));
  EXPECT_FALSE(cookie_fits("vrpn"));
  Decoder decoder;
  give(decoder, "GET / HTTP/1.1\r\nHost: a\r\n\r\n");
  Message message;
  EXPECT_EQ(decoder.next(message), Decoder::Step::Broken);
  EXPECT_EQ(decoder.next(message), Decoder::Step::Broken);
}

TEST(VrpnProtocol, LengthsThatCannotBeEndTheConnection) {
  for (const std::string& length :
       {"\x00\x00\x00\x17"s, "\x00\x00\x00\x00"s, "\xff\xff\xff\xff"s, "\x00\x01\x00\x01"s}) {
    Decoder decoder;
    give(decoder, kHandCookie + length + std::string(20, '\0'));
    Message message;
    EXPECT_EQ(decoder.next(message), Decoder::Step::Broken);
  }
  Decoder decoder;
  give(decoder, kHandCookie + "\x00\x01\x00\x00"s + std::string(65532, 'x'));
  Message message;
  EXPECT_EQ(decoder.next(message), Decoder::Step::Message) << "the longest";
  EXPECT_EQ(message.payload.size(), 65512U);
}

TEST(VrpnProtocol, AFullOutboxRefusesWholeMessages) {
  Outbox outbox(64);
  EXPECT_TRUE(outbox.put(0, Kind::Ping, {}));
  EXPECT_FALSE(outbox.put(0, Kind::PosQuat, pack(PosQuat{}).bytes()));
  EXPECT_EQ(outbox.waiting().size(), 24U);
  EXPECT_TRUE(outbox.put(0, Kind::Ping, {}));
  outbox.sent(30);
  EXPECT_TRUE(outbox.put(0, Kind::Ping, {})) << "what is sent gives room";
  EXPECT_EQ(outbox.waiting().size(), 42U);
}

TEST(VrpnProtocol, NothingIsAllocatedForAMessage) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "sanitizers have the allocator";
  Decoder decoder;
  Outbox outbox;
  give(decoder, hand_stream());
  TrackerReadings readings(VrpnAddress{.sensor = 2});
  Message message;
  realtime::RealtimeGuard guard;
  while (decoder.next(message) == Decoder::Step::Message) readings.take(Kind::PosQuat, message, 1);
  outbox.put(0, Kind::Plane, pack(Plane{}).bytes());
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(guard.locks(), 0U);
  EXPECT_EQ(readings.state().position, Vector3(1, -2, 0.5));
}

/// Messages of a peer that means harm: descriptions and payloads of random bytes, mostly of fitting lengths.
class HostilePeer {
 public:
  std::string message() {
    const std::int32_t type = pick(8) == 0 ? number() : pick(16) - 3;
    std::string payload(static_cast<std::size_t>(pick(4) == 0 ? pick(200) : 64 + 8 * pick(2)), '\0');
    for (char& byte : payload) byte = static_cast<char>(pick(3) == 0 ? 0x7f : random_());
    if (type < 0 && payload.size() >= 5) payload.replace(0, 4, "\0\0\0\5"s);
    Outbox outbox(1024);
    outbox.put(pick(4) == 0 ? number() : pick(3), type, payload);
    return std::string(outbox.waiting());
  }
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

 private:
  std::int32_t number() { return static_cast<std::int32_t>(random_()); }
  std::mt19937 random_{7};
};

TEST(VrpnProtocol, HostileMessagesGiveNoForceBeyondTheBounds) {
  const RemoteForceSettings settings;
  HostilePeer peer;
  Decoder decoder;
  PeerNames names;
  give(decoder, kHandCookie);
  TrackerReadings readings((VrpnAddress()));
  RemoteForces forces(settings);
  WantedForces wanted;
  // A message of each known type that a stranger could have described.
  std::string stream;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    Outbox outbox;
    outbox.describe(kTypeDescription, static_cast<std::int32_t>(kind), name_of(static_cast<Kind>(kind)));
    stream += outbox.waiting();
  }
  std::uint64_t revision = 0;
  int usable = 0;
  int tried = 0;
  for (int i = 0; i < repeats(1'000'000);) {
    for (int k = 0; k < 50; ++k) stream += peer.message();
    give(decoder, stream);
    stream.clear();
    Message message;
    while (decoder.next(message) == Decoder::Step::Message) {
      ++i;
      // The names that were told first stay, as hostile ones would take the others' place.
      if (message.type == kSenderDescription || i <= static_cast<int>(kKinds)) names.learn(message);
      const Kind kind = names.kind(message.type);
      readings.take(kind, message, i);
      if (auto plane = kind == Kind::Plane ? read_plane(message.payload) : std::nullopt;
          plane && tidy(*plane, settings)) {
        wanted.clients[0].planes[0] = {*plane, ++revision};
        ++usable;
      }
      if (auto field = kind == Kind::ForceField ? read_force_field(message.payload) : std::nullopt;
          field && tidy(*field, settings)) {
        wanted.clients[1].field = *field;
        ++usable;
      }
      if (usable == tried) continue;
      tried = usable;
      PointerState state;
      state.position = {0.01 * (i % 7), 0.0, 0.0};
      ASSERT_TRUE(forces.force(wanted, state, std::int64_t{i} * 1'000'000).allFinite());
    }
    ASSERT_EQ(decoder.next(message), Decoder::Step::More);
  }
  EXPECT_GT(usable, 10) << "the messages are too odd to try anything";
  EXPECT_LE(names.senders().size(), 512U);
}

TEST(VrpnProtocol, RandomBytesEndAConnectionAndNothingElse) {
  std::mt19937 random(3);
  for (int i = 0; i < repeats(2000); ++i) {
    Decoder decoder;
    std::string bytes = kHandCookie + kHandSender + kHandPose;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    for (int k = 0; k < 2000; ++k) bytes += static_cast<char>(random());
    give(decoder, bytes);
    PeerNames names;
    Message message;
    while (decoder.next(message) == Decoder::Step::Message) names.learn(message);
  }
}

}  // namespace
}  // namespace icome::devices::vrpn
