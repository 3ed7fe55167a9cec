#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector.h"
#include "collab/order/items.h"

namespace icome::collab {

// What the server and the clients of a design say to each other: message.fbs, field by field. Authors are
// numbers that the server gives, the same for all of a design; 0 is nobody. Sequences count a design's edits
// from 1.

inline constexpr std::uint16_t kProtocolVersion = 2;

/// What somebody may do with a design; each includes what is before it.
enum class Role : std::uint8_t { View, Edit, Own };
std::string_view role_name(Role role);  // "view", "edit", "own"

// ---- client to server

/// The first message of a client.
struct Hello {
  std::uint16_t least_version = kProtocolVersion;
  std::uint16_t most_version = kProtocolVersion;
  std::string token = {};
  std::string design = {};
  std::string client_key = {};  // of the client's own making: the same one is the same author
  std::string name = {};        // of the person
  std::uint32_t colour = 0;     // 0xRRGGBB
  std::string program = {};     // with its version, for logs
  bool has_world = false;       // the client has the world as it was after the edit `have`, which is durable
  std::uint64_t have = 0;
  std::uint64_t history = 0;  // that the world is of, as Welcome said
  /// The lowest number of the client's edits that are not known to be durable.
  std::uint64_t first_pending = 0;
  bool only_reads = false;  // nothing will be changed: the client need not be an author
};
/// Asks for a part of a content: a long shape or picture, or the outline of a snapshot. It comes in pieces.
struct Fetch {
  std::string hash = {};     // SHA-256, 32 bytes
  std::uint64_t offset = 0;  // bytes
  std::uint64_t bytes = 0;   // at most kMostWanted
};
inline constexpr std::uint64_t kMostWanted = 1U << 18U;
/// The snapshot has been read: now the edits behind it.
struct Loaded {
  std::uint64_t snapshot = 0;
};
/// An edit that the client has made.
struct Submit {
  std::uint64_t number = 0;  // the client's own count, rising
  std::uint64_t base = 0;    // sequence of the last ordered edit that the client knew as it made this
  std::vector<std::uint64_t> fences = {};  // of the holds under which it was made
  std::string edit = {};                   // world::to_bytes, or the next part of them
  std::uint64_t total = 0;                 // bytes of all parts; 0: it is whole
  bool takes_back = false;                 // it undoes or redoes: not over what others did since `base`
};
/// Asks for a thing (SELECT_COLOBJ).
struct Select {
  Item item = {};
  bool waits = false;  // if it is held, wait until it is free
};
/// Gives a thing back, or waits for it no longer (DESELECT_COLOBJ).
struct Deselect {
  Item item = {};
};
/// An owner takes a thing away from whoever has it.
struct TakeAway {
  Item item = {};
};
/// A pose in the design's frame.
struct SharedPose {
  base::Vector3 position = base::Vector3::Zero();  // m
  base::Quaternion turn = base::Quaternion::Identity();
};
/// Where somebody's pointer, view and head are.
struct Whereabouts {
  std::optional<SharedPose> pointer = {}, view = {}, head = {};
};
struct Present {
  Whereabouts where = {};
};
struct Say {
  std::string text = {};
};
/// Who says more than so many lines at once, and then one for each such time (ms), is not heard.
inline constexpr std::int64_t kLinesAtOnce = 10, kLineTime = 1'000;
/// Keeps the holds alive, and measures the way there and back.
struct Alive {
  std::uint64_t echo = 0;
};
/// The client leaves for good: its holds are free at once.
struct Bye {};

// ---- server to client

struct Welcome {
  std::uint16_t version = kProtocolVersion;
  std::uint32_t author = 0;
  std::uint64_t last_number = 0;  // of the author's edits that the server knows
  Role role = Role::View;
  std::uint64_t sequence = 0;  // of the design's last edit
  std::uint64_t durable = 0;   // of the last one on the disk
  bool loads = false;  // the client is to load a snapshot first; else the edits behind `have` follow at once
  std::uint64_t snapshot = 0;                // its sequence
  std::uint64_t snapshot_bytes = 0;          // of its outline, to_bytes(Outline) of world_to_bytes
  std::uint32_t lease = 0;                   // ms without a word after which holds are lost
  std::uint64_t history = 0;                 // another one where the store was restored from a backup
  std::vector<std::uint64_t> accepted = {};  // numbers of the author's edits that the snapshot holds,
  std::uint64_t accepted_from = 0;           // all of them from this number on
  std::uint64_t content_bytes = 0;           // of the snapshot's contents
  std::string snapshot_hash = {};            // of its outline
};
/// The reason why somebody does not get in, or has to leave.
enum class Parting : std::uint8_t {
  Other,        // may be tried again
  NotAllowed,   // the link is forged, has expired or was revoked
  NoDesign,     // there is no such design
  Version,      // neither understands the other
  ServerStops,  // may be tried again soon
  Broken,       // the client said what no client says
  TooSlow,      // may be tried again: begins with a snapshot
};
struct Refused {
  std::string why = {};
  Parting code = Parting::Other;
};
/// A part of a content. One without bytes says that the server does not have it any more.
struct Piece {
  std::string hash = {};
  std::uint64_t offset = 0;
  std::string bytes = {};
};
/// An edit in its order, to all but its author; one that creates objects also to the author, without bytes,
/// in place of Accepted. One message may stand for several edits, merged: `first` to `last`.
struct Ordered {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint32_t author = 0;
  std::uint64_t number = 0;  // the author's, of the last one
  std::string edit = {};
  bool creates = false;     // COLOBJ_CREATE
  bool is_outline = false;  // `edit` is to_bytes(Outline): its contents are fetched by themselves
};
/// The author's own edit has been ordered; it is durable when a Durable says so.
struct Accepted {
  std::uint64_t number = 0;
  std::uint64_t sequence = 0;
};
struct Rejected {
  std::uint64_t number = 0;
  std::string why = {};
  std::uint32_t whose = 0;  // the author whose hold or edit is in the way
};
struct Durable {
  std::uint64_t sequence = 0;
};
/// The answer to Select, also a late one to somebody who waited.
struct Selected {
  Item item = {};
  bool granted = false;
  std::uint64_t fence = 0;
  std::uint32_t by = 0;  // who has what is in the way
  Item obstacle = {};    // and what that is
  std::string why = {};
  bool waits = false;
};
/// Somebody has got a thing, or it is free (holder 0), perhaps because an owner took it away.
struct FloorChanged {
  Item item = {};
  std::uint32_t holder = 0;
  std::uint64_t fence = 0;
  std::uint32_t taken_by = 0;
};
/// All that is held, to somebody who comes in.
struct FloorState {
  std::vector<FloorChanged> holds = {};
};
/// From here on the numbers of those who only read, who are authors of nothing.
inline constexpr std::uint32_t kFirstGuest = 1U << 24U;
struct Person {
  std::uint32_t author = 0;
  std::string name = {};
  std::uint32_t colour = 0;  // 0xRRGGBB
  Role role = Role::View;
  bool here = true;

  bool operator==(const Person&) const = default;
};
/// People who came, went or changed.
struct People {
  std::vector<Person> people = {};
};
struct Presence {
  std::uint32_t author = 0;
  Whereabouts where = {};
};
struct Said {
  std::uint32_t author = 0;
  std::string text = {};
};
struct Living {
  std::uint64_t echo = 0;
};
struct Goodbye {
  std::string why = {};
  Parting code = Parting::Other;
};

using ClientMessage =
    std::variant<Hello, Fetch, Loaded, Submit, Select, Deselect, TakeAway, Present, Say, Alive, Bye>;
using ServerMessage = std::variant<Welcome, Refused, Piece, Ordered, Accepted, Rejected, Durable, Selected,
                                   FloorChanged, FloorState, People, Presence, Said, Living, Goodbye>;

}  // namespace icome::collab
