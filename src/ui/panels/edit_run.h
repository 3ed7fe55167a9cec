#pragma once
#include <memory>
#include <string>

#include "session/session.h"

namespace icome::ui {

/// Makes one action to undo of a run of edits by one control, such as the steps of a value that is spun. A
/// run ends when anything else changes the world. The session outlives it.
class EditRun {
 public:
  explicit EditRun(session::Session& session);

  /// `more`: as more of the last action, if that was this control's.
  base::Result<void> perform(const void* control, const world::Edit& edit, const std::string& name,
                             bool more);

 private:
  struct State {
    const void* control = nullptr;  // whose run it is; null: nobody's
    bool busy = false;              // the change is ours
  };
  session::Session& session_;
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace icome::ui
