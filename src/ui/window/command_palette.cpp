#include "ui/window/command_palette.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <optional>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

/// Title of an action, without the marks of a mnemonic and of a dialog to come.
QString title_of(const QAction& action) {
  const QString kept("\x01");
  QString text = action.text();
  text.replace("&&", kept).remove('&').replace(kept, "&");
  while (text.endsWith("…")) text.chop(1);
  return text;
}

/// Short name of an action: "move" for "model.move".
QString name_of(const QAction& action) {
  const QString name = action.objectName();
  return name.mid(name.indexOf('.') + 1);
}

void collect_commands(const QMenu& menu, const QString& where, std::vector<Command>& commands) {
  for (QAction* action : menu.actions()) {
    if (action->isSeparator() || !action->isVisible()) continue;
    if (action->menu())
      collect_commands(*action->menu(), where + " › " + title_of(*action), commands);
    else if (action->objectName() != "model.find")
      commands.push_back({action, title_of(*action), where, name_of(*action), action->statusTip()});
  }
}

bool begins_a_word(const QString& text, const QString& part) {
  for (qsizetype at = text.indexOf(part, 0, Qt::CaseInsensitive); at >= 0;
       at = text.indexOf(part, at + 1, Qt::CaseInsensitive)) {
    if (at == 0 || !text[at - 1].isLetterOrNumber()) return true;
  }
  return false;
}

std::optional<int> rank_of_word(const Command& command, const QString& word) {
  if (command.title.startsWith(word, Qt::CaseInsensitive)) return 1;
  if (begins_a_word(command.title, word)) return 2;
  if (command.name.startsWith(word, Qt::CaseInsensitive)) return 3;
  if (command.title.contains(word, Qt::CaseInsensitive)) return 4;
  if (command.name.contains(word, Qt::CaseInsensitive)) return 5;
  if (begins_a_word(command.where, word)) return 6;
  if (begins_a_word(command.summary, word)) return 7;
  return command.summary.contains(word, Qt::CaseInsensitive) ? std::optional(8) : std::nullopt;
}

}  // namespace

std::vector<Command> commands_of(const QMenuBar& bar) {
  std::vector<Command> commands;
  for (const QAction* action : bar.actions()) {
    if (action->menu()) collect_commands(*action->menu(), title_of(*action), commands);
  }
  return commands;
}

std::optional<int> rank_of(const Command& command, const QString& typed) {
  // A title equal to the words comes before titles that only begin with them: there are several.
  if (command.title.compare(typed.simplified(), Qt::CaseInsensitive) == 0) return 0;
  int worst = 1;
  for (const QString& word : typed.split(' ', Qt::SkipEmptyParts)) {
    const auto rank = rank_of_word(command, word);
    if (!rank) return std::nullopt;
    worst = std::max(worst, *rank);
  }
  return worst;
}

CommandPalette::CommandPalette(std::vector<Command> commands, QWidget* parent)
    : QDialog(parent),
      commands_(std::move(commands)),
      field_(new QLineEdit(this)),
      list_(new QTreeWidget(this)),
      summary_(new QLabel(this)) {
  setWindowTitle("Find a Command");
  field_->setObjectName("palette.field");
  field_->setPlaceholderText("What do you want to do?");
  field_->setAccessibleName("Command to find, by its name or what it does");
  field_->addAction(icon(Icon::Search), QLineEdit::LeadingPosition);
  field_->installEventFilter(this);
  list_->setObjectName("palette.list");
  list_->setAccessibleName("Commands that were found");
  list_->setColumnCount(3);
  list_->setHeaderHidden(true);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  summary_->setTextFormat(Qt::PlainText);
  summary_->setWordWrap(true);
  summary_->setForegroundRole(QPalette::PlaceholderText);
  summary_->setMinimumHeight(2 * summary_->fontMetrics().lineSpacing());
  summary_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(3 * kGrid, 3 * kGrid, 3 * kGrid, 3 * kGrid);
  all->setSpacing(2 * kGrid);
  all->addWidget(field_);
  all->addWidget(list_, 1);
  all->addWidget(summary_);
  resize(130 * kGrid, 100 * kGrid);
  connect(field_, &QLineEdit::textChanged, this, [this](const QString& typed) { search(typed); });
  connect(field_, &QLineEdit::returnPressed, this, [this] { choose(); });
  connect(list_, &QTreeWidget::itemClicked, this, [this] { choose(); });
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] { show_summary(); });
  search({});
}

void CommandPalette::search(const QString& typed) {
  std::vector<std::pair<int, const Command*>> found;
  for (const Command& command : commands_) {
    const auto rank = command.action ? rank_of(command, typed) : std::nullopt;
    if (rank) found.emplace_back(*rank, &command);
  }
  std::ranges::stable_sort(found, {}, &std::pair<int, const Command*>::first);
  list_->clear();
  for (const auto& [rank, command] : found) {
    const QString keys = command->action->shortcut().toString(QKeySequence::NativeText);
    auto* item = new QTreeWidgetItem(list_, {command->title, command->where + "    ", keys});
    item->setIcon(0, command->action->icon());
    item->setForeground(1, palette().color(QPalette::PlaceholderText));
    item->setForeground(2, palette().color(QPalette::PlaceholderText));
    item->setData(0, Qt::UserRole, qulonglong(command - commands_.data()));
    item->setDisabled(!command->action->isEnabled());
  }
  list_->setCurrentItem(list_->topLevelItem(0));
  show_summary();
}

void CommandPalette::show_summary() {
  const QTreeWidgetItem* item = list_->currentItem();
  if (!item) return summary_->setText("Nothing is called so, and nothing does that.");
  summary_->setText(commands_[item->data(0, Qt::UserRole).toULongLong()].summary);
}

void CommandPalette::choose() {
  const QTreeWidgetItem* item = list_->currentItem();
  if (!item || item->isDisabled()) return;
  const QPointer<QAction> action = commands_[item->data(0, Qt::UserRole).toULongLong()].action;
  accept();
  if (action) action->trigger();
}

/// Keys that move through the list reach it from the field, which keeps the keyboard's focus.
bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == field_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_PageUp || key == Qt::Key_PageDown)
      return QCoreApplication::sendEvent(list_, event);
  }
  return QDialog::eventFilter(watched, event);
}

}  // namespace icome::ui
