#include "ui/actions/operation_actions.h"

#include <map>
#include <utility>

#include "ui/actions/actions.h"
#include "ui/forms/operation_arguments.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using interaction::Operation;

namespace {

/// The text with a mnemonic: its first letter that is not taken yet, if there is one.
QString with_letter(QString text, QString& taken) {
  text.replace('&', "&&");
  for (qsizetype i = 0; i < text.size(); ++i) {
    const QChar letter = text[i].toLower();
    if (!letter.isLetter() || taken.contains(letter)) continue;
    taken += letter;
    return text.insert(i, '&');
  }
  return text;
}

}  // namespace

OperationActions::OperationActions(session::Session& session, Hooks hooks)
    : session_(session), hooks_(std::move(hooks)) {}

void OperationActions::fill(QMenu& menu, const QMenu& edit) {
  QString letters = "f";
  add_action(menu, "model.find", "&Find a Command…", QKeySequence("Ctrl+Shift+P"), [this] {
    hooks_.find();
  })->setIcon(icon(Icon::Search));
  menu.addSeparator();
  std::map<std::string, std::pair<QMenu*, QString>> groups;  // submenus, and the mnemonics taken in each
  for (const Operation& operation : interaction::operations()) {
    const QString twin = QString("edit.%1").arg(QString::fromStdString(operation.name));
    if (!operation.plan || edit.findChild<QAction*>(twin)) continue;
    auto& [group, taken] = groups[operation.group];
    if (!group) {
      group = menu.addMenu(with_letter(QString::fromStdString(operation.group), letters));
      group->setToolTipsVisible(true);
    }
    add(*group, operation, taken);
  }
}

void OperationActions::add(QMenu& group, const Operation& operation, QString& taken) {
  const bool asks = !asks_only_for_objects(operation);
  const QString title = with_letter(QString::fromStdString(operation.title), taken) + (asks ? "…" : "");
  const QString name = QString("model.%1").arg(QString::fromStdString(operation.name));
  QAction* action = add_action(group, qPrintable(name), title, {}, [this, &operation] { choose(operation); });
  const QString summary = QString::fromStdString(operation.summary);
  action->setToolTip(tip_of(summary));
  action->setStatusTip(summary);
}

void OperationActions::choose(const Operation& operation) {
  const auto fields = completed_fields(operation, {}, session_.selection());
  if (!asks_only_for_objects(operation) || !fields) return hooks_.ask(operation);
  if (!hooks_.begin()) return;
  const auto done = perform_operation(session_, operation, *fields);
  if (!done) return hooks_.refused(done.error().message);
  if (!done->empty()) hooks_.told(*done);
}

}  // namespace icome::ui
