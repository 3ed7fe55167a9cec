#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "collab/link/link_loop.h"

namespace icome::collab {

/// The server's side of its relays, which they call as messages come and time passes; publish() also from
/// within calls to them.
class RelayEvents {
 public:
  virtual ~RelayEvents() = default;
  /// Brings bytes to another server, or with an empty name to all.
  virtual void publish(const std::string& server, std::string bytes) = 0;

  // A guest: a client of another server, whose design is here.
  virtual void guest_opened(LinkId guest, const std::string& address) = 0;
  virtual void guest_received(LinkId guest, std::string_view frame) = 0;
  /// The frame before has gone to the client: the next one may be sent.
  virtual void guest_sent(LinkId guest) = 0;
  virtual void guest_closed(LinkId guest) = 0;

  // A client of this server, whose design is elsewhere.
  /// Precondition for the next one: Relays::client_sent().
  virtual void client_frame(LinkId client, SharedBytes frame) = 0;
  virtual void client_ends(LinkId client, const std::string& why) = 0;
};

/// Passes clients of one server on to the one that has their design, over a bus that may lose messages: each
/// message of a relay has a number and is signed, and a relay with a gap, or with a server that is silent,
/// ends; its client connects again and goes on. No sockets, threads and clocks: `now` is ms on a steady
/// clock.
class Relays {
 public:
  struct Settings {
    std::string id = {};   // of this server, which others publish to
    std::string key = {};  // that all servers of the store have, and nobody else
  };
  static constexpr std::int64_t kHeartbeat = 500;  // ms between two signs of life
  static constexpr std::int64_t kSilence = 2'500;  // ms after which a server counts as dead

  /// `events` outlives it.
  Relays(Settings settings, RelayEvents& events) : settings_(std::move(settings)), events_(events) {}

  const std::string& id() const { return settings_.id; }
  /// Is the number that of a guest, and of no connection of this server's own?
  static bool is_guest(LinkId link) { return link >> 63U != 0; }

  // ---- clients of this server
  /// Begins to pass a client on. False where that server is not known to live.
  bool pass_on(LinkId client, const std::string& server, std::string_view hello, std::int64_t now);
  bool passes_on(LinkId client) const { return clients_.contains(client); }
  void from_client(LinkId client, std::string_view frame);
  /// The last frame was sent.
  void client_sent(LinkId client);
  void client_closed(LinkId client);

  // ---- guests
  /// Precondition: guest_sent() came for the frame before.
  void to_guest(LinkId guest, std::string_view frame);
  void end_guest(LinkId guest, const std::string& why);

  // ---- the bus
  void heard(std::string_view bytes, std::int64_t now);
  /// Call some ten times a second.
  void tick(std::int64_t now);

 private:
  enum class Kind : std::uint8_t { Alive, Open, Frame, Part, Sent, End };
  struct Message {
    Kind kind = Kind::Alive;
    std::string from;
    LinkId client = 0;  // as the server knows it that has the connection
    bool is_to_guest = false;
    std::uint64_t number = 0;  // of the relay's messages in this direction, from 1; 0: of none
    std::string payload;
  };
  /// One end of a relay.
  struct End {
    std::string server;  // that has the other
    LinkId client = 0;   // as there or here
    std::uint64_t said = 0, heard = 0;
    std::string parts;  // of a frame, that have come
  };
  using GuestName = std::pair<std::string, LinkId>;  // the server, and its number for the client

  void say(const std::string& server, Message message);
  void say(End& end, bool is_to_guest, Kind kind, std::string_view payload);
  void say_frame(End& end, bool is_to_guest, std::string_view frame);
  std::string signature(const std::string& to, std::string_view bytes) const;
  std::optional<Message> understood(std::string_view bytes) const;
  void open_guest(const Message& message);
  void hear_as_client(const Message& message);
  void hear_as_guest(const Message& message);
  /// A whole frame, when its last part has come; nothing before. Nothing more comes of a relay that is
  /// broken.
  std::optional<std::string> whole_frame(End& end, const Message& message, bool& is_broken);
  void break_client(LinkId client, const std::string& why);
  void break_guest(LinkId guest);

  Settings settings_;
  RelayEvents& events_;
  std::map<std::string, std::int64_t> alive_;  // ms, when each server was heard last
  std::map<LinkId, End> clients_;
  std::map<LinkId, End> guests_;
  std::map<GuestName, LinkId> guest_names_;
  LinkId next_guest_ = LinkId{1} << 63U;
  std::int64_t next_beat_ = 0;  // ms
};

}  // namespace icome::collab
