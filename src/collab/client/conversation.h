#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "collab/client/divergence.h"
#include "collab/client/obstacle.h"
#include "collab/client/replica.h"
#include "collab/content/content_fetcher.h"
#include "collab/link/link_loop.h"
#include "collab/protocol/address.h"
#include "drawing/shape/every_kind.h"

namespace icome::collab {

/// Who a client is.
struct ClientIdentity {
  std::string key = {};      // the same one is the same author to a server; nobody else should know it
  std::string name = {};     // of the person
  std::uint32_t colour = 0;  // 0xRRGGBB; 0: the server chooses one that nobody else has
  std::string program = {};
  bool only_reads = false;  // nothing will be changed
};

/// How far a conversation has got.
enum class ConversationState : std::uint8_t {
  Away,     // no connection (yet, or any more); it may come
  Joining,  // connected: the design comes
  Live,
  Ended,  // no connection will help: see why_ended()
};

// What a conversation tells of, besides the world itself.

/// An edit that was ordered; one's own as well.
struct SeenEdit {
  std::uint64_t sequence = 0;  // of the last, where several were merged
  std::uint32_t author = 0;
  std::uint64_t number = 0;  // of one's own; else 0
  std::string word = {};     // "create", "translate" and so on
  std::vector<Item> items = {};
};
/// Everything up to here is durable.
struct SeenDurable {
  std::uint64_t sequence = 0;
  std::vector<std::uint64_t> own = {};  // numbers of one's own that have become durable
};
struct SeenState {
  ConversationState state = ConversationState::Away;
  std::string why = {};
};
/// What happens in a conversation, in order.
using Seen = std::variant<SeenEdit, SeenDurable, SeenState, Dropped, Selected, FloorChanged, Person, Said>;

/// A client's side of the work on one design, without sockets and clocks: the copy of the design, the floor,
/// the people, and what is still to be said. Whoever owns it brings frames in and out, connects again when a
/// connection is lost, and says what time it is (ms on a steady clock). What was done while nobody was
/// connected is sent when somebody is. One thread.
class Conversation {
 public:
  /// `cache` keeps the contents that come in; null: each is fetched whenever it is needed.
  Conversation(DesignAddress address, ClientIdentity identity,
               world::GeometryFactory factory = drawing::every_kind_of_shape(),
               ContentCachePointer cache = nullptr);

  // ---- the connection
  void opened(std::int64_t now);
  void received(std::string_view frame, std::int64_t now);
  void closed(const std::string& why, std::int64_t now);
  /// The next frame to send; null when there is nothing now. Only while connected.
  SharedBytes next_frame(std::int64_t now);
  /// The connection should be ended: the copy differs from the server's, or everything was said.
  bool wants_to_close() const { return wants_to_close_; }

  ConversationState state() const { return state_; }
  const std::string& why_ended() const { return why_; }
  Parting how_ended() const { return parting_; }
  /// The part of the design that has come, in [0, 1].
  double progress() const;
  /// ms since the server said anything, on the clock that the last call knew; it answers every two seconds or
  /// so.
  std::int64_t silence() const { return state_ == ConversationState::Live ? now_ - heard_at_ : 0; }
  /// ms there and back, of the last answer; nothing before the first.
  std::optional<std::int64_t> delay() const { return delay_; }
  Role role() const { return role_; }
  const DesignAddress& address() const { return address_; }

  // ---- the design
  Replica& replica() { return replica_; }
  const Replica& replica() const { return replica_; }
  /// Performs an edit here and for all; see Replica::perform. It is sent under the holds that cover it. Fails
  /// at once for who may only look, and where another holds what it changes: "Ann holds leg."
  base::Result<std::uint64_t> perform(const world::Edit& edit, const std::string& name, bool goes_on = false);
  /// The reason why perform() would fail for the floor or the role; nothing: it would not.
  std::optional<std::string> refusal(const world::Edit& edit) const;
  base::Result<std::uint64_t> undo() { return turn(true); }
  base::Result<std::uint64_t> redo() { return turn(false); }

  // ---- kept for another program
  /// The copy from which the next program can go on; nothing: there is no durable world now.
  std::optional<KeptCopy> keep() const;
  /// Goes on from such a copy. Before the first connection, with the copy's key as one's own.
  void resume(const KeptCopy& copy);

  // ---- work without a connection
  /// From now on a person chooses where own edits of a time without a connection and others' are in conflict:
  /// when it is back, nothing is sent until resolve().
  void ask_for_choices() { asks_for_choices_ = true; }
  /// The things to choose for; empty: there is nothing to choose.
  const std::vector<Conflict>& conflicts() const { return conflicts_; }
  /// Does as was chosen, and goes on: one choice for each of conflicts(), in order. New things get ids of the
  /// source.
  base::Result<void> resolve(std::span<const Choice> choices, world::IdSource& ids);

  // ---- the floor
  void select(Item item, bool waits = false);
  void deselect(Item item);
  void take_away(Item item);
  /// All that is held, by whom.
  const Holds& holds() const { return holds_; }

  // ---- people
  void present(const Whereabouts& where);
  /// Says something to all. Fails without a connection, and for more at a time than a server passes on.
  base::Result<void> say(const std::string& text);
  const std::map<std::uint32_t, Person>& people() const { return people_; }
  /// The places at which others were told to be, by author.
  struct Sighting {
    Whereabouts where = {};
    std::int64_t time = 0;  // ms, when it came
  };
  const std::map<std::uint32_t, Sighting>& sightings() const { return sightings_; }
  /// "Ann", or "Somebody".
  std::string name_of(std::uint32_t author) const;

  /// Leaves for good, once what is pending is durable.
  void leave() { leaves_ = true; }

  /// What has happened since the last call.
  std::vector<Seen> take_seen();

 private:
  void hear(Welcome& message);
  void hear(Refused& message);
  void hear(Piece& message);
  void hear(Ordered& message);
  void hear(Accepted& message);
  void hear(Rejected& message);
  void hear(Durable& message);
  void hear(Selected& message);
  void hear(FloorChanged& message);
  void hear(FloorState& message);
  void hear(People& message);
  void hear(Presence& message);
  void hear(Said& message);
  void hear(Living& message);
  void hear(Goodbye& message);

  base::Result<std::uint64_t> turn(bool back);
  std::vector<std::uint64_t> fences_for(const world::Edit& edit) const;
  void queue(const ClientMessage& message);
  void queue_edit(Submit submit);
  void queue_edits();
  void ask_again();
  base::Result<void> notice_restored(std::uint32_t author);
  void take_in(ServerMessage message);
  bool waits_for_contents(const ServerMessage& message) const;
  void go_on_with_contents();
  bool make_whole(Ordered& message);
  void want_contents();
  void load();
  void go_live_if_caught_up();
  void find_conflicts();
  /// The world as it was made here, without what others did meanwhile. Precondition: there is a state before.
  world::World world_as_made_here() const;
  void change_state(ConversationState state, const std::string& why);
  void begin_anew(const base::Error& error);
  void end(const std::string& why, Parting code);
  std::int64_t now_ = 0;

  DesignAddress address_;
  ClientIdentity identity_;
  world::GeometryFactory factory_;
  Replica replica_;
  ConversationState state_ = ConversationState::Away;
  bool connected_ = false;
  bool wants_to_close_ = false;
  bool needs_anew_ = false;    // the next hello says that there is no world
  std::uint64_t history_ = 0;  // that the copy is of
  bool leaves_ = false, said_bye_ = false;
  std::string why_;
  Parting parting_ = Parting::Other;
  Role role_ = Role::View;

  std::deque<std::string> outgoing_;
  std::optional<Whereabouts> to_present_;
  std::optional<Welcome> welcome_;
  ContentFetcher contents_;
  bool loads_ = false;                   // a snapshot
  std::deque<ServerMessage> held_back_;  // until contents are here
  std::size_t held_back_bytes_ = 0;      // of their edits
  bool settled_ = false;
  std::uint32_t lease_ = 0;      // ms
  std::int64_t alive_said_ = 0;  // ms
  std::int64_t heard_at_ = 0;    // ms
  std::int64_t said_until_ = 0;  // ms, until then there was enough to be said
  std::optional<std::int64_t> delay_;

  bool asks_for_choices_ = false;
  /// The design as the server had it when the connection was lost; own edits are pending.
  struct Before {
    world::World world;
    std::uint64_t sequence = 0;
  };
  std::optional<Before> before_;        // from the next connection on, until nothing is left to choose
  std::size_t actions_before_ = 0;      // own ones, when the connection was lost
  std::vector<world::Edit> made_here_;  // of them, what was pending
  std::vector<Conflict> conflicts_;

  Holds holds_;
  std::map<Item, bool> wanted_;  // what was selected, so that it is asked for again; waits?
  bool asks_again_ = false;      // for what is wanted, once all own edits are on their way
  std::map<std::uint32_t, Person> people_;
  std::map<std::uint32_t, Sighting> sightings_;
  std::vector<Seen> seen_;
};

}  // namespace icome::collab
