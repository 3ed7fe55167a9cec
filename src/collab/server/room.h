#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "collab/content/content_shelf.h"
#include "collab/link/link_loop.h"
#include "collab/protocol/message.h"
#include "collab/server/floor.h"
#include "collab/storage/op_log.h"
#include "world/edit/edit.h"
#include "world/shape/geometry_factory.h"

namespace icome::collab {

constexpr std::size_t kMostPersonBytes = 100;  // of a person's name

/// Limits and times of a room.
struct RoomSettings {
  std::int64_t lease = 8'000;      // ms without a word after which holds are lost
  std::int64_t presence_gap = 33;  // ms between two frames with presence to one client
  std::int64_t durable_gap = 100;  // ms until those hear that edits are durable who did not make them
  std::size_t most_frame_bytes = 1U << 18U;  // of edits that are joined; a single one may be longer
  std::size_t most_tail_bytes = 64U << 20U;  // of edits that are kept for those who lag behind
  std::size_t fresh_snapshot_bytes =
      1U << 20U;                 // of edits behind a snapshot after which late joiners get a new one
  std::size_t merge_from = 256;  // edits that a client lags behind before drags are merged
  std::size_t most_waiting_bytes = 1U << 20U;  // of all but edits; who lags more is sent away
  std::size_t most_edit_bytes = 256U << 20U;   // of one edit of a client
  std::size_t most_parts_bytes = 512U << 20U;  // of unfinished edits of all clients
  std::size_t most_waiting = 1'000;            // things that one person may wait for
  std::size_t most_holds = 10'000;             // of one client
  std::size_t piece_bytes = 1U << 18U;         // of a snapshot or a content
  std::size_t content_bytes = 1U << 14U;       // of a shape or a picture that goes by itself
};

/// What a room is made of: a design as its log has it.
struct RoomStart {
  std::string design = {};
  std::uint64_t fence = 0;                // of the server's lease of the design; at most 2^31
  std::uint64_t history = 0;              // DesignRow::history
  std::optional<Snapshot> snapshot = {};  // world_to_bytes; nothing: the design began empty
  std::vector<LogEntry> entries = {};  // all that are kept: some before the snapshot, for those who come back
  AuthorNames names = {};
};

/// Reads what a room is made of; `fence` is that of the reader's lease. Where an edit before the snapshot is
/// damaged, it begins with the snapshot; fails where one behind it is.
base::Result<RoomStart> read_start(OpLog& log, const DesignRow& design, std::uint64_t fence);

/// Somebody whose token was found good.
struct Arrival {
  std::uint32_t author = 0;
  std::uint64_t last_number = 0;  // of the author's last edit in the log
  Role role = Role::View;
  std::string name = {};
  std::uint32_t colour = 0;
  bool has_world = false;  // of the edit `have` of the history `history`
  std::uint64_t have = 0;
  std::uint64_t history = 0;
  std::uint64_t first_pending = 0;  // Hello::first_pending
};

/// One design that people work on: puts their edits in one order, has its floor, and knows what each client
/// still has to hear. Owns the server's copy of the world. Neither sockets nor clocks nor disks: whoever owns
/// it brings messages in, takes frames and log entries out, and says what time it is and what is on the disk.
/// One thread.
class Room {
 public:
  /// Fails for a log that cannot be read or replayed; the sentence names the design. The factory outlives the
  /// room.
  static base::Result<std::unique_ptr<Room>> open(const RoomStart& start, const RoomSettings& settings,
                                                  const world::GeometryFactory& factory);

  /// Lets a client in. An older connection of the same author is sent away.
  void join(LinkId link, const Arrival& arrival, std::int64_t now);
  /// A connection is gone; what its author holds stays until its lease ends, unless it said Bye.
  void leave(LinkId link);
  /// A message of a client that is in. `at`: ms since 1970, for the log.
  void receive(LinkId link, ClientMessage message, std::int64_t now, std::int64_t at);
  /// Ends leases. Call some times a second.
  void tick(std::int64_t now);
  /// Sends everybody away.
  void end(const std::string& why, Parting code);
  /// Changes what somebody may do from now on; nothing: sends them away.
  void set_role(LinkId link, std::optional<Role> role);

  /// Entries for the log since the last call.
  std::vector<LogEntry> take_entries();
  bool has_entries() const { return !entries_.empty(); }
  /// Everything up to this sequence is on the disk.
  void committed(std::uint64_t sequence);

  /// What a client has to hear next, joined into one frame; null when there is nothing now.
  SharedBytes next_frame(LinkId link, std::int64_t now);
  /// Does an answer about the floor wait for the client? People wait for it with their hand on the thing.
  bool has_answer(LinkId link) const;
  /// The reason to end a connection, once all frames before it have left.
  std::optional<std::string> parting(LinkId link) const;

  const std::string& design() const { return design_; }
  const world::World& world() const { return world_; }
  std::uint64_t sequence() const { return sequence_; }
  std::uint64_t durable() const { return durable_; }
  /// Edits that were refused so far.
  std::uint64_t refused() const { return refused_; }
  const Floor& floor() const { return floor_; }
  bool has(LinkId link) const { return members_.contains(link); }
  std::size_t members() const { return members_.size(); }
  /// Nobody is here and nothing waits to be committed.
  bool is_idle() const {
    return members_.empty() && entries_.empty() && durable_ == sequence_ && floor_.holds().empty();
  }

 private:
  Room(std::string design, std::uint64_t fence, const RoomSettings& settings,
       const world::GeometryFactory& factory);

  struct TailEdit {
    std::uint64_t sequence = 0;
    std::uint32_t author = 0;
    std::uint64_t number = 0;
    bool creates = false;
    world::Edit edit;
    std::string framed = {};             // Ordered, for all but the author, as frames have it
    std::uint64_t end = 0;               // bytes of all `framed` so far
    ContentShelf::Shelved shelved = {};  // its contents, where it has any

    std::size_t bytes() const { return framed.size() + shelved.bytes; }
  };
  struct SharedSnapshot {
    std::uint64_t sequence = 0;
    ContentShelf::ShelvedWorld world = {};
  };
  struct Member {
    Arrival who;
    std::optional<SharedSnapshot> loads;  // the snapshot that it loads; the edits wait
    std::uint64_t known_number = 0;       // own edits up to this one came by earlier connections
    std::uint64_t heard = 0;              // sequence of the last edit in frames
    std::uint64_t heard_durable = 0;
    std::uint64_t own = 0;          // sequence of its last own edit in frames
    std::int64_t durable_next = 0;  // ms: until then it need not hear what is durable, unless that is its own
    bool has_answer = false;        // about the floor
    std::deque<SharedBytes> waiting;  // messages but edits and presence
    std::size_t waiting_bytes = 0;
    std::uint64_t presence_heard = 0;
    std::int64_t presence_next = 0;
    std::int64_t said_until = 0;  // ms: what it has said counts until then
    std::string parts;            // of an edit that comes in parts
    std::optional<std::string> parting;
  };
  struct Author {
    std::uint64_t last_number = 0;       // also of refused edits
    std::deque<std::uint64_t> accepted;  // numbers of the last ordered edits
    std::int64_t last_word = 0;          // ms
    Person person = {.here = false};
    SharedBytes presence;
    std::uint64_t presence_version = 0;
    std::uint64_t last_edit = 0;  // its sequence; 0: none that is known here
  };
  struct Change {
    std::uint64_t sequence = 0;
    std::uint32_t author = 0;
  };

  void handle(Member& member, Fetch& message);
  void handle(Member& member, Loaded& message);
  void handle(Member& member, Submit& message, std::int64_t at);
  void handle(Member& member, Select& message);
  void handle(Member& member, Deselect& message);
  void handle(Member& member, TakeAway& message);
  void handle(Member& member, Present& message);
  void handle(Member& member, Say& message);
  void handle(Member& member, Alive& message);
  void handle(Member& member, Bye& message);
  void handle(Member& member, Hello& message);

  base::Result<void> replay(const RoomStart& start);
  void welcome(Member& member, bool may_resume);
  const SharedSnapshot& snapshot_for_joining();
  bool is_whole(Member& member, Submit& message);
  void forget_parts(Member& member);
  struct Refusal {
    std::string why;
    std::uint32_t whose = 0;
  };
  std::optional<Refusal> refusal(const Member& member, const Submit& message, const world::Edit& edit) const;
  std::optional<Refusal> wrong_ids(std::uint32_t author, const world::Edit& edit) const;
  std::optional<Refusal> fenced(const Member& member, const Submit& message, const world::Edit& edit) const;
  std::uint32_t author_of_last(const Touched& change) const;
  std::optional<Refusal> overtaken(std::uint32_t author, const Touched& mine, std::uint64_t base) const;
  void order(Member& member, const Submit& message, world::Edit edit, std::int64_t at);
  void append_to_tail(std::uint32_t author, std::uint64_t number, std::string bytes, world::Edit edit);
  void floor_follows(const world::Edit& edit);
  void reject(Member& member, const Submit& message, const std::string& why, std::uint32_t whose);
  void tell(Member& member, const ServerMessage& message);
  void tell_all(const ServerMessage& message, const Member* but = nullptr);
  void tell_free(const std::vector<Hold>& holds);
  void grant_waiting();
  People everybody() const;
  std::uint32_t free_colour(std::uint32_t author) const;
  void part(Member& member, const std::string& why, Parting code);
  void trim_tail();
  void add_waiting(Member& member, std::string& frame);
  void add_edits(Member& member, std::string& frame);
  void add_durable(Member& member, std::string& frame, std::int64_t now) const;
  std::size_t add_merged(Member& member, std::size_t index, std::string& frame);
  void add_presence(Member& member, std::string& frame, std::int64_t now);
  std::string person_name(std::uint32_t author) const;

  std::string design_;
  RoomSettings settings_;
  const world::GeometryFactory& factory_;
  world::World world_;
  std::uint64_t sequence_ = 0;
  std::uint64_t durable_ = 0;
  std::uint64_t history_ = 0;
  std::uint64_t epoch_ = 0;  // fences of holds of this room's life are at least this
  Floor floor_;
  std::deque<TailEdit> tail_;     // the newest edits, in order
  std::size_t tail_bytes_ = 0;    // with contents
  std::uint64_t framed_end_ = 0;  // of the newest edit
  ContentShelf shelf_;
  SharedSnapshot snapshot_;
  std::map<LinkId, Member> members_;
  std::map<std::uint32_t, Author> authors_;
  std::unordered_map<Touched, Change> changed_;  // who changed a side of a thing last
  std::vector<LogEntry> entries_;
  std::uint64_t presence_version_ = 0;
  std::int64_t now_ = 0;         // ms, of the last message
  std::size_t parts_bytes_ = 0;  // of unfinished edits of all members
  std::uint64_t refused_ = 0;
};

}  // namespace icome::collab
