#include <utility>

#include "session/session_parts.h"

namespace icome::session {
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

/// Takes back the tried action, without posting it yet.
base::Result<void> SessionParts::take_back() {
  const auto taken = history.take_back(sink());
  if (taken) revisions.took_back();
  return taken;
}

bool SessionHistory::can_undo() const {
  return parts_.history.can_undo() || (parts_.shared && parts_.shared->talk().replica().can_undo());
}

bool SessionHistory::can_redo() const {
  if (!parts_.shared || parts_.history.trying()) return parts_.history.can_redo();
  return parts_.shared->talk().replica().can_redo();
}

std::string SessionHistory::undo_name() const {
  if (!parts_.shared || parts_.history.trying()) return parts_.history.undo_name();
  return parts_.shared->talk().replica().undo_name();
}

std::string SessionHistory::redo_name() const {
  if (!parts_.shared || parts_.history.trying()) return parts_.history.redo_name();
  return parts_.shared->talk().replica().redo_name();
}

bool SessionHistory::trying() const { return parts_.history.trying(); }

base::Result<void> SessionHistory::perform(const world::Edit& edit, const std::string& name) {
  if (parts_.shared) return parts_.perform_for_all(edit, name, false);
  const auto performed = parts_.history.perform(parts_.sink(), edit, name);
  if (performed) parts_.revisions.performed();
  return parts_.done(performed);
}

base::Result<void> SessionHistory::extend(const world::Edit& edit) {
  const world::History& history = parts_.history;
  const bool is_over = parts_.shared ? !parts_.shared->goes_on : !history.can_undo() || history.can_redo();
  if (is_over)
    return base::fail("The action is over, as it was undone or another design was opened: begin it anew.");
  if (parts_.shared) return parts_.perform_for_all(edit, undo_name(), true);
  const auto extended = parts_.history.extend(parts_.sink(), edit);
  if (extended) parts_.revisions.extended();
  return parts_.done(extended);
}

base::Result<void> SessionHistory::take_back() {
  if (!parts_.history.trying()) return base::fail("There is nothing that is only tried out.");
  if (parts_.shared) parts_.shared->tried.reset();
  return parts_.done(parts_.take_back());
}

base::Result<void> SessionHistory::try_out(const world::Edit& edit, const std::string& name) {
  if (parts_.shared)
    if (const auto why = parts_.shared->talk().refusal(edit)) return base::fail(*why);
  std::optional<Edited> before;
  if (parts_.history.trying()) {
    if (const auto taken = parts_.take_back(); !taken) return taken;
    before = std::exchange(parts_.performed, std::nullopt);
  }
  const auto tried = parts_.history.try_out(parts_.sink(), edit, name);
  if (tried) parts_.revisions.tried();
  if (parts_.shared) parts_.shared->tried.reset();
  if (parts_.shared && tried) parts_.shared->tried.emplace(SharedDesign::Tried{edit, name});
  if (!before) return parts_.done(tried);
  parts_.performed = tried ? one_after_the_other(*before, *parts_.performed) : std::move(before);
  (void)parts_.done({});
  return tried;
}

void SessionHistory::keep_tried() {
  if (!parts_.shared) return parts_.history.keep();
  if (const auto kept = parts_.submit_tried(); !kept)
    parts_.tell(SessionEvent::Kind::Notice, kept.error().message);
}

base::Result<void> SessionHistory::undo() {
  if (parts_.shared) return parts_.turn_for_all(true);
  const auto undone = parts_.history.undo(parts_.sink());
  if (!undone) return tl::unexpected(undone.error());
  parts_.revisions.undid();
  return parts_.done({});
}

base::Result<void> SessionHistory::redo() {
  if (parts_.shared) return parts_.turn_for_all(false);
  const auto redone = parts_.history.redo(parts_.sink());
  if (!redone) return tl::unexpected(redone.error());
  parts_.revisions.redid();
  return parts_.done({});
}

}  // namespace icome::session
