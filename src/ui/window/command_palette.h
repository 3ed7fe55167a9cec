#pragma once
#include <QAction>
#include <QDialog>
#include <QPointer>
#include <optional>
#include <vector>

class QLabel;
class QLineEdit;
class QMenuBar;
class QTreeWidget;
class QTreeWidgetItem;

namespace icome::ui {

/// An entry of a menu, as people search for it.
struct Command {
  QPointer<QAction> action;  // null: its menu has changed since
  QString title;             // "Move", as in the menu
  QString where;             // "Model › Arrange"
  QString name;              // "move", its name in scripts, or else in tests
  QString summary;           // a sentence, or nothing
};

/// All commands of the menus, in their order.
std::vector<Command> commands_of(const QMenuBar& bar);

/// Rank of a command for the words that somebody types, which must all be in title, name, place or summary; 0
/// is best. Nothing: it does not match.
std::optional<int> rank_of(const Command& command, const QString& typed);

/// A dialog that finds a command by a few letters of its title, its name or what it does, and performs it.
class CommandPalette final : public QDialog {
 public:
  CommandPalette(std::vector<Command> commands, QWidget* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void search(const QString& typed);
  void show_summary();
  void choose();

  std::vector<Command> commands_;
  QLineEdit* field_;
  QTreeWidget* list_;
  QLabel* summary_;
};

}  // namespace icome::ui
