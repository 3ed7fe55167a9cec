#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <vector>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// A form with a row for each parameter of an operation. Objects follow the selection until others are named.
/// Operation and session outlive it.
class OperationForm final : public QWidget {
 public:
  OperationForm(const interaction::Operation& operation, session::Session& session, QWidget* parent);
  ~OperationForm() override;

  const interaction::Operation& operation() const { return operation_; }
  /// Calls `changed` when a field changes, also while it is still being typed in.
  void on_change(std::function<void()> changed) { changed_ = std::move(changed); }
  /// Checks the fields against this world instead of the session's.
  void plan_on(std::function<const world::World&()> world) { world_ = std::move(world); }
  /// The fields that differ from their defaults, as plan_operation() takes them. Fails for an entry that is
  /// no value of its parameter; missing values are for the operation to report.
  base::Result<interaction::Value::Fields> given() const;
  /// Returns given(), and marks each wrong field, with the reason beneath it.
  base::Result<interaction::Value::Fields> fields();
  /// Is a required field still empty?
  bool is_incomplete() const;
  /// Shows an operation's error beneath the field that it names; false: it names none.
  bool explain(const std::string& why);
  /// The first error that stands beneath a field; null where there is none.
  QWidget* first_explanation() const;
  /// Commits the text that is being typed.
  void finish_typing();
  /// Shows the selection in the object fields in which nothing is typed.
  void follow_selection();
  /// The first field to type in; null: the form has no fields.
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
