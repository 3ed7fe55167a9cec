#include <algorithm>
#include <unordered_set>
#include <utility>

#include "interaction/object_move.h"
#include "session/session_parts.h"
#include "world/edit/shared_edit.h"
#include "world/motion.h"

namespace icome::session {

using world::ObjectId;

/// Performs on main's world, and keeps the edit that is to be posted.
world::EditSink SessionParts::sink() {
  return world::EditSink([this](const world::Edit& edit) -> base::Result<world::Edit> {
    if (!queue.has_room())
      return base::fail("The program is too far behind with your edits: wait a moment, then do it again.");
    auto done = world::perform_shared(world, edit);
    if (!done) return tl::unexpected(done.error());
    performed.emplace();
    performed->edit = std::make_shared<const world::Edit>(edit);
    performed->for_replicas = std::make_shared<const world::Edit>(std::move(done->for_replicas));
    return std::move(done->inverse);
  });
}

/// Posts the edit that was performed, and tells of it.
base::Result<void> SessionParts::done(base::Result<void> result) {
  if (!result) return result;
  const std::shared_ptr<const world::Edit> edit = performed->edit;
  queue.post(std::move(*std::exchange(performed, std::nullopt)));
  const world::Changes changes = world::changes_of(*edit);
  tell_change(&changes);
  return {};
}

void SessionParts::tell_change(const world::Changes* changes) {
  surroundings.follow(changes);
  const std::size_t before = selection.size();
  std::erase_if(selection, [this](ObjectId id) { return !world.find(id); });
  if (selection.size() != before) parts_are_new = true;
  if (shown_scene && !world.find(shown_scene)) show({});
  if (!changes || !changes->objects.empty()) outline_is_new = true;
  notify_change(changes);
  if (selection.size() != before) notify_selection();
}

void SessionParts::notify_change(const world::Changes* changes) {
  if (technique) technique->changed(changes);
  const bool had_effects = !effects.empty();
  effects.follow(world, changes);
  if (had_effects || !effects.empty()) symbols_are_new = true;
  parts_are_new = parts_are_new || !selection.empty() || !part_outlines.empty();
  for (std::size_t i = 0; i < change_listeners.size(); ++i) change_listeners[i](changes);
}

void SessionParts::notify_selection() {
  hold_selection();
  for (std::size_t i = 0; i < selection_listeners.size(); ++i) selection_listeners[i]();
}

void SessionParts::show(world::SceneId scene) {
  if (shown_scene == scene) return;
  shown_scene = scene;
  symbols_are_new = parts_are_new = true;
  Edited edited;
  edited.shown = scene;
  queue.post(std::move(edited));
}

void SessionParts::open_world(world::World opened, const std::filesystem::path& design,
                              const std::shared_ptr<ClaimedWork>& recovered) {
  world = std::move(opened);
  history = {};
  leave_shared();
  integrator.cancel();
  (void)integrator.poll();
  ids = world::IdSource(0, world.next_number(0));
  revisions.restart();
  constexpr std::uint64_t kNever = 0;  // what was recovered is in no file
  saved_revision = recovered ? kNever : revisions.now();
  left_out.clear();
  told.clear();
  path = design;
  shown_scene = {};
  played_since.reset();
  Edited edited;
  edited.whole = std::make_shared<const world::World>(world);
  edited.saved = std::make_shared<const SavedWork>(
      SavedWork{.design = design, .number = queue.posted() + 1, .recovered = recovered});
  opened_number = queue.post(std::move(edited));
  const bool had_selection = !std::exchange(selection, {}).empty();
  marked_part.reset();
  outline_is_new = look_is_new = parts_are_new = true;
  surroundings.follow(nullptr);
  notify_change(nullptr);
  if (had_selection) notify_selection();
}

void Session::on_change(std::function<void(const world::Changes*)> listener) {
  if (listener) parts_->change_listeners.push_back(std::move(listener));
}

void Session::on_selection(std::function<void()> listener) {
  if (listener) parts_->selection_listeners.push_back(std::move(listener));
}

bool Session::follows_others() const { return parts_->follows_others; }

const world::World& Session::world() const { return parts_->world; }

world::IdSource& Session::ids() { return parts_->ids; }

const std::vector<ObjectId>& Session::selection() const { return parts_->selection; }

void Session::select(std::vector<ObjectId> objects) {
  std::unordered_set<ObjectId> met;
  std::erase_if(objects, [&](ObjectId id) { return !parts_->world.find(id) || !met.insert(id).second; });
  if (objects == parts_->selection) return;
  parts_->selection = std::move(objects);
  parts_->outline_is_new = parts_->parts_are_new = true;
  parts_->notify_selection();
}

}  // namespace icome::session
