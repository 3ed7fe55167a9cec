#pragma once
#include <memory>
#include <string>

#include "session/session.h"

namespace icome::ui {

/// Joins a run of edits by one control, such as the steps of a value that is spun, into one action to undo. A
/// run ends when anything else changes the world. The session outlives it.
class EditRun {
 public:
  explicit EditRun(session::Session& session);

  /// With `more`, the edit joins the last action, if that was this control's and has the same name.
  base::Result<void> perform(const void* control, const world::Edit& edit, const std::string& name,
                             bool more);

 private:
  struct State {
    const void* control = nullptr;  // the control whose run it is; null: none
    bool busy = false;              // the present change is ours
  };
  session::Session& session_;
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace icome::ui
