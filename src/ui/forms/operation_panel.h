#pragma once
#include <QString>
#include <QWidget>
#include <functional>
#include <memory>
#include <string>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// The panel in which an operation gets its arguments and is performed: its summary, a form, and the reason
/// for a refusal. While the arguments are valid, the result is seen and felt at once (OperationPreview), and
/// follows them; it becomes an action when it is applied, and is taken back when the form is left. Changes go
/// through the session, which outlives it.
class OperationPanel final : public QWidget {
 public:
  struct Hooks {
    std::function<bool()> begin;   // asked before the world is edited; false: do not
    std::function<void()> closed;  // called when a person closes the panel
  };
  OperationPanel(session::Session& session, Hooks hooks, QWidget* parent);
  ~OperationPanel() override;

  /// Shows the form of another operation. The caller moves the keyboard focus.
  void ask(const interaction::Operation& operation);
  /// The widget to take the focus; null: there is no form.
  QWidget* first_field() const;
  /// The remark on the preview, or on the operation that was applied last until anything else is done or
  /// selected; or empty.
  QString remark() const;
  /// Clears the remark on an applied operation, as the person goes on with something else.
  void forget_remark();
  /// Performs the operation, as one action; on failure nothing changes, and the panel tells why.
  void apply();
  /// Keeps the preview as an action, as it has been written to a file.
  void keep();
  /// Takes the preview back; there is none until a field changes.
  void leave();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
