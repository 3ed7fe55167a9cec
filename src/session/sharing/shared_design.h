#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "collab/client/connection.h"
#include "collab/client/kept_design.h"
#include "session/background_task.h"
#include "session/sharing/shared_line.h"

namespace icome::session {

/// A design on a server as a session works on it: its connection, what the session's world has still to go
/// through, and what is asked of the floor for the selection. Main's.
class SharedDesign {
 public:
  explicit SharedDesign(std::unique_ptr<collab::Connection> connection);

  collab::Conversation& talk() { return connection_->talk(); }
  const collab::Conversation& talk() const { return connection_->talk(); }
  void work() { connection_->work(); }

  /// The way of the design's world since the last call.
  struct Way {
    bool is_another = false;  // it became another world
    std::vector<world::Edit> edits = {};
  };
  Way take_way();

  /// An edit that the session's world has gone through on trial, and nobody else's.
  struct Tried {
    world::Edit edit;
    std::string name;
  };
  std::optional<Tried> tried = {};
  /// The journal against crashes keeps the design, as the server may not have all of it.
  bool is_journalled = true;
  /// The last action may be gone on with.
  bool goes_on = false;

  /// Not null: the design is kept for offline work.
  std::shared_ptr<const collab::KeptDesign> kept = nullptr;
  /// Writes the copy anew, in the background.
  void keep_copy();
  /// Does so where it is old. Fails where the last time failed; once.
  base::Result<void> keep_copy_if_due();
  void forget_copy();

  /// Asks for these objects and gives back the others that were asked for.
  void hold(std::span<const world::ObjectId> objects);
  /// Asks for one, even if others are before.
  void wait_for(world::ObjectId object);
  /// Asks for a thing besides, which an action changes, until other objects are held.
  void hold_for_action(collab::Item item);
  /// Asks once more for objects that were refused because of a thing which is free now.
  void ask_again(collab::Item freed);
  /// Was this waited for, and not heard of yet?
  bool take_waited(collab::Item item) { return waited_.erase(item) > 0; }
  /// Another took it away: was it asked for?
  bool lose(collab::Item item) { return held_.erase(world::ObjectId{item.id}) > 0; }

  /// The reason why there was no connection, the last time.
  const std::string& last_why() const { return connection_->last_why(); }

  /// All that people said and did, the newest last; old lines go.
  const std::deque<SharedLine>& lines() const { return lines_; }
  void add_line(SharedLine line);
  /// Adds a line for somebody else who comes or goes, once for each time.
  void note_person(const collab::Person& person);
  /// Likewise for those who went while there was no connection.
  void note_who_left();

  /// The connection, to be left in good order.
  std::unique_ptr<collab::Connection> release();

 private:
  std::unique_ptr<collab::Connection> connection_;
  Way way_;
  std::uint64_t changes_ = 0, kept_changes_ = 0;  // of the world, and those of them that the copy has
  std::int64_t kept_at_ = 0;                      // ns
  bool keeps_again_ = false;
  std::unique_ptr<BackgroundTask<bool>> keeping_;
  std::set<world::ObjectId> held_;  // or asked for
  std::set<collab::Item> waited_;
  std::set<collab::Item> besides_;  // shapes and other things of the last actions
  std::set<std::uint32_t> here_;    // others, as the lines say
  std::deque<SharedLine> lines_;
  std::uint64_t lines_so_far_ = 0;
};

/// Writes what a conversation keeps; nothing to keep is well, too.
base::Result<void> write_copy(const collab::KeptDesign& kept, std::optional<collab::KeptCopy> copy);

}  // namespace icome::session
