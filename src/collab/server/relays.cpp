#include "collab/server/relays.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <vector>

#include "io/byte_order.h"

namespace icome::collab {
namespace {

constexpr std::size_t kMostPart = 512U << 10U;  // bytes of a frame in one message; NATS takes a megabyte
constexpr std::size_t kMostFrame = 80U << 20U;  // bytes
constexpr std::size_t kSignatureBytes = 16;
constexpr std::size_t kLongestName = 255;  // of a server
constexpr const char* kServerGone = "The server that has the design does not answer.";

/// Takes parts from the front of a message.
struct Reader {
  std::string_view rest;
  bool is_good = true;

  std::string_view take(std::size_t count) {
    if (rest.size() < count) {
      is_good = false;
      return {};
    }
    const std::string_view part = rest.substr(0, count);
    rest.remove_prefix(count);
    return part;
  }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    const std::string_view part = take(bytes);
    for (std::size_t i = part.size(); i-- > 0;) value = value << 8U | static_cast<unsigned char>(part[i]);
    return value;
  }
};

}  // namespace

// ---- clients of this server

bool Relays::pass_on(LinkId client, const std::string& server, std::string_view hello, std::int64_t now) {
  const auto known = alive_.find(server);
  if (known == alive_.end() || now - known->second > kSilence) return false;
  End& end = clients_[client];
  end = {server, client, 0, 0, {}};
  say(end, true, Kind::Open, hello);
  return true;
}

void Relays::from_client(LinkId client, std::string_view frame) {
  if (const auto found = clients_.find(client); found != clients_.end())
    say_frame(found->second, true, frame);
}

void Relays::client_sent(LinkId client) {
  if (const auto found = clients_.find(client); found != clients_.end())
    say(found->second, true, Kind::Sent, {});
}

void Relays::client_closed(LinkId client) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  say(found->second, true, Kind::End, {});
  clients_.erase(found);
}

void Relays::break_client(LinkId client, const std::string& why) {
  client_closed(client);
  events_.client_ends(client, why);
}

// ---- guests

void Relays::to_guest(LinkId guest, std::string_view frame) {
  if (const auto found = guests_.find(guest); found != guests_.end()) say_frame(found->second, false, frame);
}

void Relays::end_guest(LinkId guest, const std::string& why) {
  const auto found = guests_.find(guest);
  if (found == guests_.end()) return;
  say(found->second, false, Kind::End, why);
  guest_names_.erase({found->second.server, found->second.client});
  guests_.erase(found);
}

void Relays::break_guest(LinkId guest) {
  end_guest(guest, "A message between two servers was lost.");
  events_.guest_closed(guest);
}

// ---- the bus

void Relays::say(const std::string& server, Message message) {
  std::string bytes;
  bytes += char(message.kind);
  bytes += char(message.is_to_guest);
  bytes += char(settings_.id.size());
  bytes += settings_.id;
  io::store<std::uint64_t>(message.client, io::ByteOrder::LittleEndian, bytes);
  io::store<std::uint64_t>(message.number, io::ByteOrder::LittleEndian, bytes);
  bytes += message.payload;
  bytes += signature(server, bytes);
  events_.publish(server, std::move(bytes));
}

void Relays::say(End& end, bool is_to_guest, Kind kind, std::string_view payload) {
  say(end.server, {kind, {}, end.client, is_to_guest, ++end.said, std::string(payload)});
}

void Relays::say_frame(End& end, bool is_to_guest, std::string_view frame) {
  for (; frame.size() > kMostPart; frame.remove_prefix(kMostPart))
    say(end, is_to_guest, Kind::Part, frame.substr(0, kMostPart));
  say(end, is_to_guest, Kind::Frame, frame);
}

/// Signs the bytes together with the name of whom they are for, so that nobody else takes them.
std::string Relays::signature(const std::string& to, std::string_view bytes) const {
  std::string text = to;
  text += '\0';
  text += bytes;
  std::array<unsigned char, EVP_MAX_MD_SIZE> mac{};
  unsigned length = 0;
  const auto* const first = reinterpret_cast<const unsigned char*>(text.data());
  if (!HMAC(EVP_sha256(), settings_.key.data(), int(settings_.key.size()), first, text.size(), mac.data(),
            &length))
    return {};
  return std::string(reinterpret_cast<const char*>(mac.data()), kSignatureBytes);
}

std::optional<Relays::Message> Relays::understood(std::string_view bytes) const {
  if (bytes.size() < kSignatureBytes) return std::nullopt;
  const std::string_view body = bytes.substr(0, bytes.size() - kSignatureBytes);
  const bool is_for_all = !body.empty() && Kind(body[0]) == Kind::Alive;
  const std::string expected = signature(is_for_all ? std::string() : settings_.id, body);
  if (expected.size() != kSignatureBytes ||
      CRYPTO_memcmp(expected.data(), bytes.data() + body.size(), kSignatureBytes) != 0)
    return std::nullopt;
  Reader reader{body};
  Message message;
  const std::uint64_t kind = reader.number(1);
  message.kind = Kind(kind);
  message.is_to_guest = reader.number(1) != 0;
  message.from = reader.take(std::size_t(reader.number(1)));
  message.client = reader.number(8);
  message.number = reader.number(8);
  message.payload = reader.rest;
  if (!reader.is_good || kind > std::uint64_t(Kind::End)) return std::nullopt;
  return message;
}

void Relays::heard(std::string_view bytes, std::int64_t now) {
  const auto message = understood(bytes);
  if (!message || message->from == settings_.id) return;
  alive_[message->from] = now;
  if (message->kind == Kind::Alive) return;
  message->is_to_guest ? hear_as_guest(*message) : hear_as_client(*message);
}

std::optional<std::string> Relays::whole_frame(End& end, const Message& message, bool& is_broken) {
  is_broken = message.number != ++end.heard || end.parts.size() + message.payload.size() > kMostFrame;
  if (is_broken || (message.kind != Kind::Frame && message.kind != Kind::Part)) return std::nullopt;
  end.parts += message.payload;
  if (message.kind == Kind::Part) return std::nullopt;
  return std::exchange(end.parts, {});
}

void Relays::hear_as_client(const Message& message) {
  const auto found = clients_.find(message.client);
  if (found == clients_.end() || found->second.server != message.from) return;
  bool is_broken = false;
  auto frame = whole_frame(found->second, message, is_broken);
  if (is_broken) return break_client(message.client, "A message between two servers was lost.");
  if (frame)
    return events_.client_frame(message.client, std::make_shared<const std::string>(std::move(*frame)));
  if (message.kind != Kind::End) return;
  clients_.erase(found);
  events_.client_ends(message.client, message.payload);
}

void Relays::open_guest(const Message& message) {
  const LinkId guest = next_guest_++;
  guests_[guest] = {message.from, message.client, 0, message.number, {}};
  guest_names_[{message.from, message.client}] = guest;
  events_.guest_opened(guest, "a client of server " + message.from.substr(0, 8));
  events_.guest_received(guest, message.payload);
}

void Relays::hear_as_guest(const Message& message) {
  const auto known = guest_names_.find({message.from, message.client});
  if (message.kind == Kind::Open && message.number == 1 && known == guest_names_.end())
    return open_guest(message);
  if (known == guest_names_.end()) {
    // The relay has ended here: the other end goes, too.
    if (message.kind != Kind::End)
      say(message.from,
          {Kind::End, {}, message.client, false, 0, "The connection between two servers was lost."});
    return;
  }
  const LinkId guest = known->second;
  End& end = guests_.at(guest);
  bool is_broken = false;
  const auto frame = whole_frame(end, message, is_broken);
  if (is_broken) return break_guest(guest);
  if (frame) return events_.guest_received(guest, *frame);
  if (message.kind == Kind::Sent) return events_.guest_sent(guest);
  if (message.kind != Kind::End) return;
  guest_names_.erase(known);
  guests_.erase(guest);
  events_.guest_closed(guest);
}

void Relays::tick(std::int64_t now) {
  if (now >= next_beat_) {
    next_beat_ = now + kHeartbeat;
    say({}, {Kind::Alive, {}, 0, false, 0, {}});
  }
  const auto is_silent = [&](const End& end) {
    const auto found = alive_.find(end.server);
    return found == alive_.end() || now - found->second > kSilence;
  };
  std::vector<LinkId> silent_clients, silent_guests;
  for (const auto& [client, end] : clients_)
    if (is_silent(end)) silent_clients.push_back(client);
  for (const auto& [guest, end] : guests_)
    if (is_silent(end)) silent_guests.push_back(guest);
  for (const LinkId client : silent_clients) break_client(client, kServerGone);
  for (const LinkId guest : silent_guests) break_guest(guest);
  std::erase_if(alive_, [&](const auto& it) { return now - it.second > 10 * kSilence; });
}

}  // namespace icome::collab
