#include "ui/forms/operation_preview.h"

#include <utility>

#include "interaction/operations/operation_runner.h"
#include "ui/forms/operation_arguments.h"

namespace icome::ui {

using interaction::Operation;
using interaction::Value;

namespace {

/// Sets a flag for as long as it lives.
class Busy {
 public:
  explicit Busy(bool& busy) : busy_(busy) { busy_ = true; }
  ~Busy() { busy_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  bool& busy_;
};

}  // namespace

OperationPreview::OperationPreview(session::Session& session, std::function<void(End)> ended)
    : session_(session) {
  const std::weak_ptr<State> kept = state_;
  session.on_change([kept, &session, ended = std::move(ended)](const world::Changes* changes) {
    const std::shared_ptr<State> state = kept.lock();
    if (!state || state->busy || !state->shown) return;
    if (changes && session.history().trying()) {  // others have changed a shared design below it
      state->shown->without = session.sharing().design();
      state->shown->is_stale = true;
      return;
    }
    const Shown shown = *std::exchange(state->shown, std::nullopt);
    // Redo is possible only right after an undo.
    const bool undone = changes && session.history().can_redo();
    if (undone) restore_selection(session, shown);
    ended(!changes ? End::Gone : undone ? End::Undone : End::Kept);
  });
}

OperationPreview::~OperationPreview() { take_back(); }

const world::World& OperationPreview::world() const {
  return state_->shown ? state_->shown->without : session_.world();
}

base::Result<std::string> OperationPreview::show(const Operation& operation, const Value::Fields& fields) {
  const std::shared_ptr<State> state = state_;
  std::optional<Shown>& shown = state->shown;
  if (shown && !shown->is_stale && shown->operation == &operation && shown->fields == fields)
    return shown->note;
  auto plan =
      interaction::plan_operation(operation, fields, world(), session_.ids(), picture_reader(session_));
  if (!plan) return tl::unexpected(plan.error());
  const Busy busy(state->busy);
  if (!shown) shown.emplace(Shown{session_.world(), session_.selection()});
  if (shown->operation && session_.selection() != shown->selected_then)
    shown->selected_before = session_.selection();
  if (const auto tried = session_.history().try_out(plan->edit, operation.title); !tried) {
    restore_selection(session_, *std::exchange(shown, std::nullopt));
    return tl::unexpected(tried.error());
  }
  shown->operation = &operation;
  shown->is_stale = false;
  shown->fields = fields;
  shown->objects = std::move(plan->objects);
  shown->note = std::move(plan->note);
  shown->selected_then = session_.selection();
  return shown->note;
}

/// Selects again what was selected before, unless something else was selected meanwhile.
void OperationPreview::restore_selection(session::Session& session, const Shown& shown) {
  if (session.selection() == shown.selected_then) session.select(shown.selected_before);
}

void OperationPreview::take_back() {
  const std::shared_ptr<State> state = state_;
  if (!shown()) return;
  const Busy busy(state->busy);
  const Shown shown = *std::exchange(state->shown, std::nullopt);
  if (session_.history().take_back()) restore_selection(session_, shown);
}

void OperationPreview::keep() {
  const std::shared_ptr<State> state = state_;
  if (!shown()) return;
  // Others may have changed the world below it since it was made.
  if (state->shown->is_stale && state->shown->operation != nullptr)
    (void)show(*state->shown->operation, interaction::Value::Fields(state->shown->fields));
  if (!shown()) return;
  const Busy busy(state->busy);
  const Shown shown = *std::exchange(state->shown, std::nullopt);
  session_.history().keep_tried();
  session_.select(shown.objects);
}

}  // namespace icome::ui
