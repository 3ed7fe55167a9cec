#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// What an operation would do, seen and felt at once: it is performed, as an action that is only tried out
/// (SessionHistory::try_out), and then kept or taken back. When anything else changes the world meanwhile, it
/// has been built on and stays, unless it is just this that was undone. The session outlives it.
class OperationPreview {
 public:
  enum class End : std::uint8_t {
    Kept,    // something else was done after it
    Undone,  // it was undone by itself
    Gone,    // with its design
  };
  /// `ended` hears of what nobody here has asked for.
  OperationPreview(session::Session& session, std::function<void(End)> ended);
  /// Takes back what is shown.
  ~OperationPreview();
  OperationPreview(const OperationPreview&) = delete;
  OperationPreview& operator=(const OperationPreview&) = delete;

  bool shown() const { return state_->shown.has_value(); }
  /// Without what is shown: what operations are planned on, and arguments mean.
  const world::World& world() const;
  /// Are world or selection being changed from here just now?
  bool busy() const { return state_->busy; }

  /// Shows this operation in place of what is shown, and gives its note. One that is refused changes nothing;
  /// at worst nothing is shown then.
  base::Result<std::string> show(const interaction::Operation& operation,
                                 const interaction::Value::Fields& fields);
  /// Leaves world, history and selection (unless another was made) as they were before it.
  void take_back();
  /// It is an action like any other from now on, and what it made or changed is selected.
  void keep();

 private:
  struct Shown {
    world::World without;  // the world before
    std::vector<world::ObjectId> selected_before = {}, selected_then = {};
    const interaction::Operation* operation = nullptr;  // never null when it is there
    interaction::Value::Fields fields = {};
    std::vector<world::ObjectId> objects = {};
    std::string note = {};
  };
  struct State {
    std::optional<Shown> shown = {};
    bool busy = false;
  };
  static void restore_selection(session::Session& session, const Shown& shown);

  session::Session& session_;
  std::shared_ptr<State> state_ = std::make_shared<State>();  // the session may call after we are gone
};

}  // namespace icome::ui
