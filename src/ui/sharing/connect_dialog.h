#pragma once
#include <QDialog>
#include <functional>

#include "session/session.h"

class QLineEdit;
class QListWidget;
class QPushButton;
class QSettings;

namespace icome::ui {

class WrappedLabel;

/// Asks for the address of a design on a server and for the name by which the others know the person; the
/// addresses that were joined before are a list to choose from. Session and settings outlive it.
class ConnectDialog final : public QDialog {
 public:
  /// `chosen` gets the address; the name is kept in the settings.
  ConnectDialog(session::Session& session, QSettings& settings, std::function<void(const QString&)> chosen,
                QWidget* parent);

 private:
  void fill_recent();
  void choose_recent(int row);
  void forget_recent();
  void check();
  void finish();

  session::Session& session_;
  QSettings& settings_;
  std::function<void(const QString&)> chosen_;
  QLineEdit* address_ = nullptr;
  QLineEdit* name_ = nullptr;
  QListWidget* recent_ = nullptr;
  QPushButton* forget_ = nullptr;
  QPushButton* open_ = nullptr;
  WrappedLabel* remark_ = nullptr;
};

/// The name by which others know the person; empty: as the system does.
QString person_name(const QSettings& settings);

}  // namespace icome::ui
