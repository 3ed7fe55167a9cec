#pragma once
#include <QString>
#include <QWidget>
#include <functional>
#include <memory>
#include <string>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// Where an operation is told what it asks, and performed: its summary, a form, and why it was refused. While
/// all that is said can be done, it is seen and felt at once (OperationPreview), and follows what is said; it
/// is done when it is applied, and taken back when the form is left. Changes go through the session, which
/// outlives it.
class OperationPanel final : public QWidget {
 public:
  struct Hooks {
    std::function<bool()> begin;   // before the world is touched from here; false: do not
    std::function<void()> closed;  // it is wanted no longer
  };
  OperationPanel(session::Session& session, Hooks hooks, QWidget* parent);
  ~OperationPanel() override;

  /// Asks for another operation. The keyboard is for who shows the panel to move.
  void ask(const interaction::Operation& operation);
  /// Where typing begins; null: nothing is asked.
  QWidget* first_field() const;
  /// What is to be known of what is shown, or was done last until anything else is done or selected; or
  /// empty.
  QString remark() const;
  /// Something else is gone on with: what was remarked on what is done already is over.
  void forget_remark();
  /// Performs what has been said, as one action; a failed one changes nothing and is told on the panel.
  void apply();
  /// What is shown is in a file now: it stays.
  void keep();
  /// Takes back what is only shown; nothing is shown until something else is said.
  void leave();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
