#include "cutout/output/tuio.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace icome::cutout {
namespace {

constexpr std::size_t kMostInBundle = 12;  // objects, so that a datagram stays below 1.5 kB
constexpr double kFullTurn = 2.0 * std::numbers::pi;

void append_big_endian(std::string& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char((number >> unsigned(shift)) & 0xffU);
}

/// Text of OSC: ended by zeros up to a multiple of four.
void append_osc_text(std::string& bytes, const std::string& text) {
  bytes += text;
  bytes.append(4 - text.size() % 4, '\0');
}

/// A message of OSC: its address, then arguments with their types.
class OscMessage {
 public:
  explicit OscMessage(std::string address) : address_(std::move(address)) {}

  OscMessage& text(const std::string& argument) {
    types_ += 's';
    append_osc_text(arguments_, argument);
    return *this;
  }
  OscMessage& whole(std::int32_t argument) {
    types_ += 'i';
    append_big_endian(arguments_, std::bit_cast<std::uint32_t>(argument));
    return *this;
  }
  OscMessage& number(double argument) {
    types_ += 'f';
    append_big_endian(arguments_, std::bit_cast<std::uint32_t>(float(argument)));
    return *this;
  }
  std::string bytes() const {
    std::string all;
    append_osc_text(all, address_);
    append_osc_text(all, types_);
    return all + arguments_;
  }

 private:
  std::string address_;
  std::string types_ = ",";
  std::string arguments_;
};

void append_to_bundle(std::string& bundle, const OscMessage& message) {
  const std::string bytes = message.bytes();
  append_big_endian(bundle, std::uint32_t(bytes.size()));
  bundle += bytes;
}

std::string empty_bundle() {
  std::string bundle;
  append_osc_text(bundle, "#bundle");
  append_big_endian(bundle, 0);
  append_big_endian(bundle, 1);  // at once
  return bundle;
}

OscMessage object_message() { return OscMessage("/tuio/2Dobj"); }

}  // namespace

TuioBundles::TuioBundles(double table_width, double table_height, std::string source)
    : table_width_(table_width), table_height_(table_height), source_(std::move(source)) {}

TuioBundles::Object TuioBundles::moved(const Sighting& sighting, double seconds) {
  Object object;
  object.triangle = sighting.triangle;
  object.place = {sighting.pose.centroid.x() / table_width_, sighting.pose.centroid.y() / table_height_};
  object.angle = std::fmod(kFullTurn - sighting.pose.angle, kFullTurn);
  if (object.angle < 0) object.angle += kFullTurn;
  for (const Object& before : objects_) {
    if (before.triangle != object.triangle) continue;
    object.session = before.session;
    if (!(seconds > 0)) return object;
    object.speed = (object.place - before.place) / seconds;
    object.turn = std::remainder(object.angle - before.angle, kFullTurn) / kFullTurn / seconds;
    object.speed_up = (object.speed.norm() - before.speed.norm()) / seconds;
    object.turn_up = (object.turn - before.turn) / seconds;
    return object;
  }
  object.session = next_session_++;
  return object;
}

std::vector<std::string> TuioBundles::of(const std::vector<Sighting>& sightings, double time) {
  std::vector<Object> now;
  for (const Sighting& sighting : sightings) now.push_back(moved(sighting, time - last_time_));
  objects_ = std::move(now);
  last_time_ = time;
  ++frame_;
  OscMessage alive = object_message();
  alive.text("alive");
  for (const Object& object : objects_) alive.whole(object.session);
  std::vector<std::string> bundles;
  for (std::size_t from = 0; from == 0 || from < objects_.size(); from += kMostInBundle) {
    std::string bundle = empty_bundle();
    append_to_bundle(bundle, object_message().text("source").text(source_));
    append_to_bundle(bundle, alive);
    for (std::size_t i = from; i < std::min(objects_.size(), from + kMostInBundle); ++i) {
      const Object& object = objects_[i];
      append_to_bundle(bundle, object_message()
                                   .text("set")
                                   .whole(object.session)
                                   .whole(std::int32_t(object.triangle))
                                   .number(object.place.x())
                                   .number(object.place.y())
                                   .number(object.angle)
                                   .number(object.speed.x())
                                   .number(object.speed.y())
                                   .number(object.turn)
                                   .number(object.speed_up)
                                   .number(object.turn_up));
    }
    append_to_bundle(bundle, object_message().text("fseq").whole(frame_));
    bundles.push_back(std::move(bundle));
  }
  return bundles;
}

base::Result<UdpSender> UdpSender::create(const io::HostPort& place) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(place.host.c_str(), std::to_string(place.port).c_str(), &wanted, &found);
  if (error != 0)
    return base::fail(
        fmt::format("{}:{}: the host is not known ({})", place.host, place.port, ::gai_strerror(error)));
  int opened = -1;
  for (const addrinfo* one = found; one != nullptr && opened < 0; one = one->ai_next) {
    opened = ::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, one->ai_protocol);
    if (opened >= 0 && ::connect(opened, one->ai_addr, one->ai_addrlen) != 0) {
      ::close(opened);
      opened = -1;
    }
  }
  ::freeaddrinfo(found);
  if (opened < 0) return base::fail(fmt::format("{}:{}: nothing can be sent there", place.host, place.port));
  return UdpSender(opened);
}

UdpSender::UdpSender(UdpSender&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), lost_(other.lost_) {}

UdpSender::~UdpSender() {
  if (socket_ >= 0) ::close(socket_);
}

void UdpSender::send(const std::string& datagram) {
  // A host where nobody listens answers the datagram before: that is told here, and no loss of this one.
  for (int tries = 0; tries < 2; ++tries)
    if (::send(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL) == ssize_t(datagram.size())) return;
  ++lost_;
}

}  // namespace icome::cutout
