#include <algorithm>
#include <unordered_set>
#include <utility>

#include "interaction/object_move.h"
#include "session/session_parts.h"
#include "session/shared_edit.h"
#include "world/motion.h"

namespace icome::session {

using world::ObjectId;

namespace {

Edited one_after_the_other(const Edited& first, const Edited& then) {
  const auto both = [](const auto& one, const auto& other) {
    return std::make_shared<const world::Edit>(world::EditGroup{{*one, *other}});
  };
  Edited edited;
  edited.edit = both(first.edit, then.edit);
  edited.for_replicas = both(first.for_replicas, then.for_replicas);
  return edited;
}

}  // namespace

/// Performs on main's world, and keeps the edit that is to be posted.
world::EditSink Session::Parts::sink() {
  return world::EditSink([this](const world::Edit& edit) -> base::Result<world::Edit> {
    if (!queue.has_room())
      return base::fail("The program is too far behind with your edits: wait a moment, then do it again.");
    auto shared = perform_shared(world, edit);
    if (!shared) return tl::unexpected(shared.error());
    performed.emplace();
    performed->edit = std::make_shared<const world::Edit>(edit);
    performed->for_replicas = std::make_shared<const world::Edit>(std::move(shared->for_replicas));
    return std::move(shared->inverse);
  });
}

/// Posts the edit that was performed, and tells of it.
base::Result<void> Session::Parts::done(base::Result<void> result) {
  if (!result) return result;
  const std::shared_ptr<const world::Edit> edit = performed->edit;
  queue.post(std::move(*std::exchange(performed, std::nullopt)));
  const world::Changes changes = world::changes_of(*edit);
  tell_change(&changes);
  return {};
}

void Session::Parts::tell_change(const world::Changes* changes) {
  surroundings.follow(changes);
  const std::size_t before = selection.size();
  std::erase_if(selection, [this](ObjectId id) { return !world.find(id); });
  if (selection.size() != before) parts_are_new = true;
  if (shown_scene && !world.find(shown_scene)) show({});
  if (!changes || !changes->objects.empty()) outline_is_new = true;
  notify_change(changes);
  if (selection.size() != before) notify_selection();
}

void Session::Parts::notify_change(const world::Changes* changes) {
  if (technique) technique->changed(changes);
  const bool had_effects = !effects.empty();
  effects.follow(world, changes);
  if (had_effects || !effects.empty()) symbols_are_new = true;
  parts_are_new = parts_are_new || !selection.empty() || !part_outlines.empty();
  for (std::size_t i = 0; i < change_listeners.size(); ++i) change_listeners[i](changes);
}

void Session::Parts::notify_selection() const {
  for (std::size_t i = 0; i < selection_listeners.size(); ++i) selection_listeners[i]();
}

void Session::Parts::show(world::SceneId scene) {
  if (shown_scene == scene) return;
  shown_scene = scene;
  symbols_are_new = parts_are_new = true;
  Edited edited;
  edited.shown = scene;
  queue.post(std::move(edited));
}

void Session::Parts::open_world(world::World opened, const std::filesystem::path& design,
                                const std::shared_ptr<ClaimedWork>& recovered) {
  world = std::move(opened);
  history = {};
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

const world::World& Session::world() const { return parts_->world; }

world::IdSource& Session::ids() { return parts_->ids; }

const world::History& Session::history() const { return parts_->history; }

base::Result<void> Session::perform(const world::Edit& edit, const std::string& name) {
  const auto performed = parts_->history.perform(parts_->sink(), edit, name);
  if (performed) parts_->revisions.performed();
  return parts_->done(performed);
}

base::Result<void> Session::extend(const world::Edit& edit) {
  const world::History& history = parts_->history;
  if (!history.can_undo() || history.can_redo())
    return base::fail("The action is over, as it was undone or another design was opened: begin it anew.");
  const auto extended = parts_->history.extend(parts_->sink(), edit);
  if (extended) parts_->revisions.extended();
  return parts_->done(extended);
}

/// Takes back the tried action, without posting it yet.
base::Result<void> Session::Parts::take_back() {
  const auto taken = history.take_back(sink());
  if (taken) revisions.took_back();
  return taken;
}

base::Result<void> Session::take_back() {
  if (!parts_->history.trying()) return base::fail("There is nothing that is only tried out.");
  return parts_->done(parts_->take_back());
}

base::Result<void> Session::try_out(const world::Edit& edit, const std::string& name) {
  std::optional<Edited> before;
  if (parts_->history.trying()) {
    if (const auto taken = parts_->take_back(); !taken) return taken;
    before = std::exchange(parts_->performed, std::nullopt);
  }
  const auto tried = parts_->history.try_out(parts_->sink(), edit, name);
  if (tried) parts_->revisions.tried();
  if (!before) return parts_->done(tried);
  parts_->performed = tried ? one_after_the_other(*before, *parts_->performed) : std::move(before);
  (void)parts_->done({});
  return tried;
}

void Session::keep_tried() { parts_->history.keep(); }

base::Result<void> Session::undo() {
  const auto undone = parts_->history.undo(parts_->sink());
  if (!undone) return tl::unexpected(undone.error());
  parts_->revisions.undid();
  return parts_->done({});
}

base::Result<void> Session::redo() {
  const auto redone = parts_->history.redo(parts_->sink());
  if (!redone) return tl::unexpected(redone.error());
  parts_->revisions.redid();
  return parts_->done({});
}

void Session::show_scene(world::SceneId scene) {
  if (!scene || parts_->world.find(scene)) parts_->show(scene);
}

world::SceneId Session::shown_scene() const { return parts_->shown_scene; }

bool Session::has_motions() const { return !world::moving_objects(world()).empty(); }

bool Session::playing() const { return parts_->played_since.has_value(); }

void Session::play(bool on) {
  if (on == playing()) return;
  parts_->played_since = on ? std::optional<double>(session_seconds()) : std::nullopt;
  Edited edited;
  edited.play = Edited::Play{parts_->played_since};
  parts_->queue.post(std::move(edited));
}

const std::vector<ObjectId>& Session::selection() const { return parts_->selection; }

void Session::select(std::vector<ObjectId> objects) {
  std::unordered_set<ObjectId> met;
  std::erase_if(objects, [&](ObjectId id) { return !parts_->world.find(id) || !met.insert(id).second; });
  if (objects == parts_->selection) return;
  parts_->selection = std::move(objects);
  parts_->outline_is_new = parts_->parts_are_new = true;
  parts_->notify_selection();
}

base::Bounds Session::selection_bounds() const {
  const world::World& world = parts_->world;
  const world::Scene* scene = world.find(parts_->shown_scene);
  const auto& all = scene ? scene->roots : world.roots();
  base::Bounds bounds;
  for (const ObjectId id : parts_->selection.empty() ? all : interaction::topmost(world, parts_->selection))
    bounds.extend(world::bounds(world, id));
  return bounds;
}

}  // namespace icome::session
