#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// All that an operation asks, a row for each parameter. Objects follow the selection until others are named.
/// Operation and session outlive it.
class OperationForm final : public QWidget {
 public:
  OperationForm(const interaction::Operation& operation, session::Session& session, QWidget* parent);
  ~OperationForm() override;

  const interaction::Operation& operation() const { return operation_; }
  /// Calls `changed` when something else is said, also when it is still being typed.
  void on_change(std::function<void()> changed) { changed_ = std::move(changed); }
  /// Holds what is said to another world than the session's.
  void plan_on(std::function<const world::World&()> world) { world_ = std::move(world); }
  /// What has been said, as plan_operation() takes it; what is said by itself is left out. Fails for what is
  /// no value of its parameter; what is missing is for the operation to tell.
  base::Result<interaction::Value::Fields> given() const;
  /// The same; fields that are wrong are marked, and why stands beneath them.
  base::Result<interaction::Value::Fields> fields();
  /// Is there nothing yet where something must be said?
  bool is_incomplete() const;
  /// Puts what an operation has refused beneath the field that it names; false: it names none.
  bool explain(const std::string& why);
  /// The first explanation that stands beneath a field; null where all is well.
  QWidget* first_explanation() const;
  /// Takes what is being typed as said.
  void finish_typing();
  /// Shows what is selected now where nothing else is named.
  void follow_selection();
  /// Where typing begins.
  QWidget* first_field() const;

 private:
  struct Row;

  void add_row(const interaction::Parameter& parameter, class PanelSection& section);
  void change(Row& row);
  base::Result<interaction::Value> value_of_row(const Row& row) const;
  static void explain_at(const Row& row, const std::string& why);
  std::string choice() const;
  void show_asked();

  const interaction::Operation& operation_;
  session::Session& session_;
  std::function<const world::World&()> world_;
  std::function<void()> changed_ = [] {};
  std::vector<std::unique_ptr<Row>> rows_;
};

}  // namespace icome::ui
