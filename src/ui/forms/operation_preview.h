#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// Makes the result of an operation seen and felt at once: the operation is performed as an action on trial
/// (Session::try_out), and then kept or taken back. When anything else changes the world meanwhile, the
/// action has been built on and stays, unless that change was its undoing. The session outlives it.
class OperationPreview {
 public:
  enum class End : std::uint8_t {
    Kept,    // something else was done after it
    Undone,  // it alone was undone
    Gone,    // its design was replaced
  };
  /// `ended` is called when the preview ends without a call from here.
  OperationPreview(session::Session& session, std::function<void(End)> ended);
  /// Takes the preview back.
  ~OperationPreview();
  OperationPreview(const OperationPreview&) = delete;
  OperationPreview& operator=(const OperationPreview&) = delete;

  bool shown() const { return state_->shown.has_value(); }
  /// The world without the preview: operations are planned on it, and arguments refer to it.
  const world::World& world() const;
  /// Is the preview itself changing world or selection just now?
  bool busy() const { return state_->busy; }

  /// Shows the result of this operation in place of the present one, and returns its note. A refused
  /// operation changes nothing; at worst no preview is left.
  base::Result<std::string> show(const interaction::Operation& operation,
                                 const interaction::Value::Fields& fields);
  /// Puts world, history and selection (unless another was made) back as they were before the preview.
  void take_back();
  /// Turns the preview into an action like any other, and selects the objects that it made or changed.
  void keep();

 private:
  struct Shown {
    world::World without;  // the world before
    std::vector<world::ObjectId> selected_before = {}, selected_then = {};
    const interaction::Operation* operation = nullptr;  // null only until the operation has been tried
    interaction::Value::Fields fields = {};
    std::vector<world::ObjectId> objects = {};
    std::string note = {};
    bool is_stale = false;  // others have changed the world below it
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
