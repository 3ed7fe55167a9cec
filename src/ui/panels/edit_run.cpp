#include "ui/panels/edit_run.h"

namespace icome::ui {

EditRun::EditRun(session::Session& session) : session_(session) {
  const std::weak_ptr<State> kept = state_;  // the session may call after we are gone
  session.on_change([kept, &session](const world::Changes* changes) {
    const std::shared_ptr<State> state = kept.lock();
    const bool is_others = changes && session.follows_others();
    if (state && !state->busy && !is_others) state->control = nullptr;
  });
}

base::Result<void> EditRun::perform(const void* control, const world::Edit& edit, const std::string& name,
                                    bool more) {
  const bool goes_on = more && state_->control == control && session_.history().can_undo() &&
                       session_.history().undo_name() == name;
  state_->busy = true;
  const auto done = goes_on ? session_.history().extend(edit) : session_.history().perform(edit, name);
  state_->busy = false;
  state_->control = done ? control : nullptr;
  return done;
}

}  // namespace icome::ui
