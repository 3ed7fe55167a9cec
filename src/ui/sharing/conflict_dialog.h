#pragma once
#include <QDialog>
#include <functional>
#include <vector>

#include "session/session.h"

class QComboBox;

namespace icome::ui {

/// Lets a person choose what becomes of each thing that was changed both here, while there was no connection,
/// and by others. The session outlives it.
class ConflictDialog final : public QDialog {
 public:
  /// `chosen` hears how what was chosen went.
  ConflictDialog(session::Session& session, std::function<void(const base::Result<void>&)> chosen,
                 QWidget* parent);

 private:
  void choose_all(int choice);
  void finish();

  session::Session& session_;
  std::function<void(const base::Result<void>&)> chosen_;
  std::vector<QComboBox*> choices_;  // one for each conflict; their data: collab::Choice
};

}  // namespace icome::ui
