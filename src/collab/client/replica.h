#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "collab/client/kept_copy.h"
#include "collab/order/items.h"
#include "collab/protocol/message.h"
#include "drawing/shape/every_kind.h"
#include "world/edit/edit.h"
#include "world/shape/geometry_factory.h"

namespace icome::collab {

/// An edit of one's own that did not come to be, for people to hear of.
struct Dropped {
  std::uint64_t number = 0;
  std::string name = {};    // of the action: "Move leg"
  std::string why = {};     // a sentence
  std::uint32_t whose = 0;  // the author whose hold or edit was in the way; 0: nobody's
  world::Edit edit;
};

/// A client's copy of a design. Its world is what the server has ordered, and on top the person's own edits
/// that the server has not ordered yet: they show at once. When others' edits come first, the own ones are
/// taken back, theirs applied, and the own ones redone; one that no longer applies stays aside until the
/// server has spoken. Owns the world; one thread uses it.
///
/// What the server has ordered may be lost with it until it is durable: rewind() goes back to what cannot be
/// lost.
class Replica {
 public:
  explicit Replica(world::GeometryFactory factory = drawing::every_kind_of_shape())
      : factory_(std::move(factory)) {}

  const world::World& world() const { return world_; }
  /// Sequence of the last ordered edit in it.
  std::uint64_t sequence() const { return sequence_; }
  /// Sequence of the last edit in it that cannot be lost any more; all of a snapshot's count as soon as the
  /// server has said so.
  std::uint64_t durable() const { return base_; }
  /// Is the world beneath all tentative edits durable, so that one may resume from it?
  bool can_resume() const { return has_base_ && base_ <= durable_; }

  /// Calls `listener` with each edit that world() goes through from now on, in the form that leads another
  /// copy of it along, and with null when it has become another world.
  void on_change(std::function<void(const world::Edit*)> listener) { listener_ = std::move(listener); }

  /// The author whose edits are one's own, and the highest number that it has used.
  void set_author(std::uint32_t author, std::uint64_t last_number);
  std::uint32_t author() const { return author_; }

  // ---- one's own edits

  /// Applies an edit and queues it for the server. Where it `goes_on` with the last action, as the steps of a
  /// drag do, it is undone with that, and may replace its last edit where that has not been sent and both
  /// only place the same objects or move the same vertices. Gives its number.
  base::Result<std::uint64_t> perform(const world::Edit& edit, const std::string& name,
                                      std::vector<std::uint64_t> fences = {}, bool goes_on = false);
  /// Takes the last own action back, as a new edit, or fails and says what is in the way: somebody's later
  /// edit, with the author in `whose`.
  base::Result<std::uint64_t> undo(std::vector<std::uint64_t> fences = {}, std::uint32_t* whose = nullptr);
  base::Result<std::uint64_t> redo(std::vector<std::uint64_t> fences = {}, std::uint32_t* whose = nullptr);
  bool can_undo() const { return !done_.empty(); }
  bool can_redo() const { return !undone_.empty(); }
  std::string undo_name() const { return done_.empty() ? "" : done_.back().name; }
  std::string redo_name() const { return undone_.empty() ? "" : undone_.back().name; }

  /// The next edit to send; nothing when all are on their way. It counts as sent.
  std::optional<Submit> next_to_send();
  bool has_unsent() const;
  /// The lowest number of own edits that are not durable yet; above all where there are none.
  std::uint64_t first_pending() const;
  /// The last ordered edit, until a durable() covers it; then null.
  const world::Edit* last_ordered() const { return tentative_.empty() ? nullptr : &tentative_.back().edit; }
  /// Own edits that the server has not ordered yet.
  std::size_t pending() const { return pending_.size(); }
  /// Own edits that are not durable yet, ordered or not.
  std::size_t unacknowledged() const;

  /// Own edits are taken back while much of what the server says is taken in; refresh() redoes them. Until
  /// then world() is without them.
  base::Result<void> put_aside();
  void refresh();

  // ---- kept for another program
  /// Puts the durable world, the own edits behind it and the author into a copy. False: there is no durable
  /// world now.
  bool keep_in(KeptCopy& copy) const;
  /// Goes on from a copy, instead of an empty replica. Own edits are each an action to undo. New ones get
  /// numbers far above those of the copy, as the program before may have given some after it was kept. Nobody
  /// else may go on from the same copy: keep what this one gives in its place, before anything is done.
  void resume(const KeptCopy& copy);
  /// The first number for new things of one's own: of no program that went on from a copy of this design.
  std::uint64_t first_free_number() const;

  // ---- what was done while there was no connection
  /// The world without the own edits that the server has not ordered.
  world::World world_of_server();
  /// The own edits that the server has not ordered, in order.
  std::vector<world::Edit> pending_edits() const;
  /// The author of the last edit of another that changed this thing, of those that were heard since the world
  /// began; 0: none.
  std::uint32_t last_other(Item item) const;
  /// Gives up those that change this thing.
  base::Result<void> give_up(Item item);
  /// All own actions behind the first `count` are one from now on, to be taken back at once.
  void join_actions(std::size_t count, const std::string& name);
  std::size_t actions() const { return done_.size(); }

  // ---- what the server says; a failure means that the copy differs from the server's: begin() anew

  /// Begins with a snapshot, which holds the own edits with these numbers; the other pending ones are redone
  /// on it. What it holds can be taken back no more, as it is not known how.
  base::Result<void> begin(world::World world, std::uint64_t sequence,
                           const std::vector<std::uint64_t>& accepted);
  base::Result<void> ordered(const Ordered& it);
  base::Result<void> accepted(const Accepted& it);
  /// Nothing where there is no such edit.
  base::Result<std::optional<Dropped>> rejected(const Rejected& it);
  /// Gives the numbers of own edits that cannot be lost any more from now on.
  std::vector<std::uint64_t> durable(const Durable& it);
  /// All that the server had ordered when it said welcome is here: own edits up to its `last_number` that
  /// were not among it were refused while nobody listened.
  /// `accepted_from`: it is known of all numbers from this one on.
  base::Result<std::vector<Dropped>> settle(std::uint64_t last_number, std::uint64_t accepted_from);
  /// Own edits that are not ordered yet are given up; the world is without them.
  base::Result<std::vector<Dropped>> give_up_pending(const std::string& why);
  /// The design is of another history from now on: what was durable or can be undone of the old one says
  /// nothing of it. Own pending edits stay. begin() follows.
  void begin_history();
  /// The connection is lost: goes back to what is durable. Own edits behind it are pending and unsent again.
  base::Result<void> rewind();

 private:
  struct Pending {
    std::uint64_t number = 0;
    std::string name;
    world::Edit edit;
    std::vector<std::uint64_t> fences;
    std::uint64_t base = 0;
    bool sent = false;                   // by this connection
    bool was_sent = false;               // by any: the server may have it as it is
    std::optional<world::Edit> inverse;  // nothing: it does not apply now
    bool takes_back = false;             // it undoes or redoes
  };
  struct Tentative {
    std::uint64_t first = 0, last = 0;
    std::uint32_t author = 0;
    std::uint64_t number = 0;
    std::string name;
    world::Edit edit;
    world::Edit inverse;
    std::vector<std::uint64_t> fences;
    std::uint64_t base = 0;
  };
  /// An own edit as it may be taken back.
  struct Own {
    world::Edit inverse;
    std::uint64_t sequence = 0;  // 0: not ordered yet
    bool is_covered = false;     // the inverse of its action's first edit takes this back as well
  };
  struct Action {
    std::string name;
    std::vector<std::uint64_t> numbers;
  };
  struct Touch {
    std::uint64_t sequence = 0;
    std::uint32_t author = 0;
  };

  base::Result<world::Edit> change(const world::Edit& edit);
  base::Result<void> take_back(const world::Edit& inverse);
  base::Result<void> take_pending_back(std::size_t from = 0);
  void redo_pending(std::size_t from = 0);
  bool merges_into_last(const world::Edit& edit) const;
  std::uint64_t add_pending(const world::Edit& edit, const std::string& name, world::Edit inverse,
                            std::vector<std::uint64_t> fences);
  void set_inverse(std::uint64_t number, const world::Edit& inverse);
  void forget_oldest();
  void note_others(const world::Edit& edit, std::uint64_t sequence, std::uint32_t author);
  std::optional<Touch> later_touch(const world::Edit& edit, std::uint64_t since) const;
  base::Result<std::uint64_t> turn(std::vector<Action>& from, std::vector<Action>& to,
                                   std::vector<std::uint64_t> fences, std::uint32_t* whose);
  void forget(std::uint64_t number);
  static Pending pending_again(Tentative it);
  Dropped drop(std::size_t index, const std::string& why, std::uint32_t whose);

  world::GeometryFactory factory_;
  world::World world_;
  std::function<void(const world::Edit*)> listener_;
  std::uint32_t author_ = 0;
  std::uint64_t last_number_ = 0;
  std::uint64_t lives_ = 0;  // KeptCopy::lives
  bool has_base_ = false;
  std::uint64_t base_ = 0;      // sequence of the world beneath tentative_
  std::uint64_t sequence_ = 0;  // of the world beneath pending_
  std::uint64_t durable_ = 0;   // that the server has named
  std::deque<Tentative> tentative_;
  std::deque<Pending> pending_;
  bool aside_ = false;  // put_aside() was called, and not refresh() yet
  std::vector<Pending>
      covered_;  // own edits in the snapshot that the world began with, until that is durable
  std::map<std::uint64_t, Own> own_;  // by number
  std::vector<Action> done_, undone_;
  std::unordered_map<Item, std::map<Aspect, Touch>> others_;  // who changed what last, others only
};

}  // namespace icome::collab
