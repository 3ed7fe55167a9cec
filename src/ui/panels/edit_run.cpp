#include "ui/panels/edit_run.h"

namespace icome::ui {

EditRun::EditRun(session::Session& session) : session_(session) {
  const std::weak_ptr<State> kept = state_;  // the session may call after we are gone
  session.on_change([kept](const world::Changes*) {
    const std::shared_ptr<State> state = kept.lock();
    if (state && !state->busy) state->control = nullptr;
  });
}

base::Result<void> EditRun::perform(const void* control, const world::Edit& edit, const std::string& name,
                                    bool more) {
  const bool goes_on = more && state_->control == control && session_.history().actions().can_undo() &&
                       session_.history().actions().undo_name() == name;
  state_->busy = true;
  const auto done = goes_on ? session_.history().extend(edit) : session_.history().perform(edit, name);
  state_->busy = false;
  state_->control = done ? control : nullptr;
  return done;
}

}  // namespace icome::ui
