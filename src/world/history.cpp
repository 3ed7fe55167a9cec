#include "world/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>

namespace icome::world {
namespace {

/// Those of a group, or the edit itself.
std::span<const Edit> steps_of(const Edit& edit) {
  const auto* group = std::get_if<EditGroup>(&edit.what);
  return group ? std::span(group->edits) : std::span(&edit, 1);
}

/// Does the older one of two inverses undo both, as in the steps of a drag of one object or many?
bool covers_both(const Edit& older, const Edit& newer) {
  const auto places_the_same = [](const Edit& a, const Edit& b) {
    const auto* one = std::get_if<PlaceObject>(&a.what);
    const auto* other = std::get_if<PlaceObject>(&b.what);
    return one && other && one->id == other->id;
  };
  return std::ranges::equal(steps_of(older), steps_of(newer), places_the_same);
}

}  // namespace

base::Result<void> History::perform(const EditSink& sink, const Edit& edit, const std::string& name) {
  auto inverse = sink(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  undone_.clear();
  done_.push_back({name, {std::move(*inverse)}});
  return {};
}

base::Result<void> History::extend(const EditSink& sink, const Edit& edit) {
  assert(can_undo() && !can_redo());
  auto inverse = sink(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  std::vector<Edit>& inverses = done_.back().inverses;
  if (!covers_both(inverses.back(), *inverse)) inverses.push_back(std::move(*inverse));
  return {};
}

base::Result<Edit> History::undo(const EditSink& sink) {
  return turn(sink, done_, undone_, "There is nothing to undo.");
}

base::Result<Edit> History::redo(const EditSink& sink) {
  return turn(sink, undone_, done_, "There is nothing to redo.");
}

base::Result<Edit> History::turn(const EditSink& sink, std::vector<Action>& from, std::vector<Action>& to,
                                 const char* nothing) {
  if (from.empty()) return base::fail(nothing);
  const Action& action = from.back();
  // A single edit is no group: groups would lie within groups after every undo and redo.
  Edit edit = action.inverses.size() == 1
                  ? action.inverses.front()
                  : Edit(EditGroup{{action.inverses.rbegin(), action.inverses.rend()}});
  auto inverse = sink(edit);
  if (!inverse) {
    return base::fail(fmt::format("\"{}\" stays as it is, as the design has changed since: {}", action.name,
                                  inverse.error().message));
  }
  to.push_back({action.name, {std::move(*inverse)}});
  from.pop_back();
  return edit;
}

}  // namespace icome::world
