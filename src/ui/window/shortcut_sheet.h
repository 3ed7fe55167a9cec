#pragma once
#include <QAction>
#include <QDialog>
#include <QList>
#include <QStringList>
#include <utility>
#include <vector>

namespace icome::ui {

/// A table of the uses of keys and mouse.
class ShortcutSheet final : public QDialog {
 public:
  /// A heading, and the rows under it: what is done, and by which keys.
  struct Part {
    QString heading;
    std::vector<std::pair<QString, QString>> rows;
  };

  ShortcutSheet(const std::vector<Part>& parts, QWidget* parent);

  /// The actions that have shortcuts, in their order.
  static Part of_actions(const QString& heading, const QList<QAction*>& actions);
};

}  // namespace icome::ui
