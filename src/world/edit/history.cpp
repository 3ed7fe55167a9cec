#include "world/edit/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "world/edit/edit_memory.h"

namespace icome::world {
namespace {

/// The edits of a group, or the edit itself.
std::span<const Edit> steps_of(const Edit& edit) {
  const auto* group = std::get_if<EditGroup>(&edit.what);
  return group ? std::span(group->edits) : std::span(&edit, 1);
}

/// Does the older one of two inverses undo both? Whole shapes and places do, whatever was done to them.
bool covers(const Edit& older, const Edit& newer) {
  if (const auto* place = std::get_if<PlaceObject>(&older.what)) {
    const auto* other = std::get_if<PlaceObject>(&newer.what);
    return other && other->id == place->id;
  }
  const auto* moved = std::get_if<MoveVertices>(&newer.what);
  if (const auto* shape = std::get_if<ReplaceGeometry>(&older.what)) {
    const auto* other = std::get_if<ReplaceGeometry>(&newer.what);
    const auto* amended = std::get_if<AmendGeometry>(&newer.what);
    return (other && other->id == shape->id) || (moved && moved->id == shape->id) ||
           (amended && amended->id == shape->id);
  }
  const auto* vertices = std::get_if<MoveVertices>(&older.what);
  return vertices && moved && vertices->id == moved->id && vertices->vertices == moved->vertices;
}

}  // namespace

bool takes_back_both(const Edit& older, const Edit& newer) {
  return std::ranges::equal(steps_of(older), steps_of(newer), covers);
}

History::Action History::action_of(const std::string& name, Edit inverse) {
  const std::size_t bytes = memory_of(inverse);
  Action action{name, {}, bytes};
  action.inverses.push_back(std::move(inverse));
  return action;
}

void History::forget_oldest() {
  std::size_t bytes = 0;
  std::size_t kept = 0;
  while (kept < done_.size()) {
    bytes += done_[done_.size() - 1 - kept].bytes;
    if (kept > 0 && bytes > most_bytes_) break;
    ++kept;
  }
  done_.erase(done_.begin(), done_.end() - std::ptrdiff_t(kept));
}

base::Result<void> History::perform(const EditSink& sink, const Edit& edit, const std::string& name) {
  auto inverse = sink(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  keep();
  undone_.clear();
  done_.push_back(action_of(name, std::move(*inverse)));
  forget_oldest();
  return {};
}

base::Result<void> History::try_out(const EditSink& sink, const Edit& edit, const std::string& name) {
  assert(!trying());
  auto inverse = sink(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  aside_ = std::exchange(undone_, {});
  done_.push_back(action_of(name, std::move(*inverse)));
  forget_oldest();
  return {};
}

base::Result<void> History::take_back(const EditSink& sink) {
  assert(trying());
  std::vector<Action> redoable = *std::exchange(aside_, std::nullopt);
  const auto undone = undo(sink);
  if (!undone) return tl::unexpected(undone.error());
  undone_ = std::move(redoable);
  return {};
}

base::Result<void> History::extend(const EditSink& sink, const Edit& edit) {
  assert(can_undo() && !can_redo());
  auto inverse = sink(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  keep();
  Action& action = done_.back();
  if (takes_back_both(action.inverses.back(), *inverse)) return {};
  action.bytes += memory_of(*inverse);
  action.inverses.push_back(std::move(*inverse));
  forget_oldest();
  return {};
}

base::Result<Edit> History::undo(const EditSink& sink) {
  keep();
  return turn(sink, done_, undone_, "There is nothing to undo.");
}

base::Result<Edit> History::redo(const EditSink& sink) {
  return turn(sink, undone_, done_, "There is nothing to redo.");
}

base::Result<Edit> History::turn(const EditSink& sink, std::vector<Action>& from, std::vector<Action>& to,
                                 const char* nothing) {
  if (from.empty()) return base::fail(nothing);
  const Action& action = from.back();
  // A single edit is kept without a group: else every undo and redo would nest the groups deeper.
  Edit edit = action.inverses.size() == 1
                  ? action.inverses.front()
                  : Edit(EditGroup{{action.inverses.rbegin(), action.inverses.rend()}});
  auto inverse = sink(edit);
  if (!inverse) {
    return base::fail(fmt::format("\"{}\" stays as it is, as the design has changed since: {}", action.name,
                                  inverse.error().message));
  }
  to.push_back(action_of(action.name, std::move(*inverse)));
  from.pop_back();
  return edit;
}

}  // namespace icome::world
