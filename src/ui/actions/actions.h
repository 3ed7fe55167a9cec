#pragma once
#include <QAction>
#include <QMenu>
#include <functional>

namespace icome::ui {

/// Adds an entry to a menu. `name` is how tests and tools find it.
inline QAction* add_action(QMenu& menu, const char* name, const QString& text, const QKeySequence& keys,
                           const std::function<void()>& act) {
  QAction* action = menu.addAction(text);
  action->setObjectName(name);
  action->setShortcut(keys);
  QObject::connect(action, &QAction::triggered, action, [act] { act(); });
  return action;
}

}  // namespace icome::ui
