#pragma once
#include <optional>
#include <string>
#include <vector>

#include "world/edit/edit_sink.h"

namespace icome::world {

/// Does the older of two inverses take back what both were made by? It does for the steps of a drag of one
/// thing or many: whole shapes and places, whatever was done to them.
bool takes_back_both(const Edit& older, const Edit& newer);

/// The actions that a person did and can take back: one entry for each action, whatever edits it took. Owns
/// the inverses; knows the world, or whatever performs its edits, only during a call. When they take more
/// memory than allowed, the oldest actions can no longer be taken back; the last one always can.
class History {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{256}
                                            << 20U;  // of what can be undone, as memory_of counts

  History() = default;
  explicit History(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Performs the edit of an action called `name` ("Move leg"). Undone actions can then not be redone.
  base::Result<void> perform(const EditSink& sink, const Edit& edit, const std::string& name);
  /// Adds an edit to the last action, such as the next step of a drag; that must not be undone.
  base::Result<void> extend(const EditSink& sink, const Edit& edit);

  /// Performs an action that is only tried out: as long as nothing else is done, take_back() leaves no trace
  /// of it. Precondition: not trying().
  base::Result<void> try_out(const EditSink& sink, const Edit& edit, const std::string& name);
  /// Precondition: trying(). Fails, changing nothing, when somebody else's edits are in its way; it is then
  /// an ordinary action.
  base::Result<void> take_back(const EditSink& sink);
  /// Makes what is tried out an ordinary action. Any other action does so, too.
  void keep() { aside_.reset(); }
  bool trying() const { return aside_.has_value(); }

  bool can_undo() const { return !done_.empty(); }
  bool can_redo() const { return !undone_.empty(); }
  /// The names of the next actions to undo or redo; empty when there are none.
  std::string undo_name() const { return done_.empty() ? "" : done_.back().name; }
  std::string redo_name() const { return undone_.empty() ? "" : undone_.back().name; }

  /// Returns the edit that was performed. Fails, changing nothing, when
  /// there is nothing to take back or somebody else's edits are in its way.
  base::Result<Edit> undo(const EditSink& sink);
  base::Result<Edit> redo(const EditSink& sink);

 private:
  struct Action {
    std::string name;
    std::vector<Edit> inverses;  // in the order they were made: applied from the last
    std::size_t bytes = 0;
  };
  static Action action_of(const std::string& name, Edit inverse);
  void forget_oldest();
  static base::Result<Edit> turn(const EditSink& sink, std::vector<Action>& from, std::vector<Action>& to,
                                 const char* nothing);

  std::size_t most_bytes_ = kMostBytes;
  std::vector<Action> done_, undone_;
  std::optional<std::vector<Action>> aside_;  // redoable actions to bring back after take_back()
};

}  // namespace icome::world
