#include "ui/actions/edit_actions.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <utility>

#include "interaction/object_edits.h"
#include "ui/actions/actions.h"
#include "ui/actions/object_menu.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using world::ObjectId;

void collect_shapes(const world::World& world, ObjectId root, std::vector<ObjectId>& found) {
  for (const ObjectId id : world::subtree(world, root)) {
    if (world.find(id)->geometry) found.push_back(id);
  }
}

/// The topmost objects of the scene that is shown.
std::vector<ObjectId> shown_roots(const session::Session& session) {
  const world::World& world = session.world();
  const world::Scene* const scene = world.find(session.stage().shown_scene());
  return scene ? scene->roots : world.roots();
}

/// Is there typing in the widget that can be undone or redone?
bool has_typing(const QObject& widget) {
  if (const auto* line = qobject_cast<const QLineEdit*>(&widget))
    return line->isUndoAvailable() || line->isRedoAvailable();
  if (const auto* text = qobject_cast<const QPlainTextEdit*>(&widget))
    return text->document()->isUndoAvailable() || text->document()->isRedoAvailable();
  const auto* spin = qobject_cast<const QAbstractSpinBox*>(&widget);
  const auto* line = spin ? spin->findChild<const QLineEdit*>() : nullptr;
  return line && has_typing(*line);
}

/// Leaves the keys of undo and redo to the design, unless the widget with the keyboard focus has typing of
/// its own to undo: fields would always claim these keys.
class UndoKeys final : public QObject {
 public:
  using QObject::QObject;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::ShortcutOverride || !watched->isWidgetType()) return false;
    const auto& key = *static_cast<QKeyEvent*>(event);
    if (!key.matches(QKeySequence::Undo) && !key.matches(QKeySequence::Redo)) return false;
    if (has_typing(*watched)) return false;
    event->ignore();
    return true;
  }
};

}  // namespace

void select_all(session::Session& session) {
  std::vector<ObjectId> all;
  for (const ObjectId root : shown_roots(session)) collect_shapes(session.world(), root, all);
  session.select(std::move(all));
}

EditActions::EditActions(session::Session& session, Hooks hooks)
    : session_(session), hooks_(std::move(hooks)) {}

void EditActions::perform(const std::function<base::Result<void>()>& act) {
  if (!hooks_.begin()) return;
  if (const auto done = act(); !done) hooks_.refused(done.error().message);
}

void EditActions::fill(QMenu& menu) {
  undo_ = add_action(menu, "edit.undo", "&Undo", QKeySequence("Ctrl+Z"),
                     [this] { perform([this] { return session_.history().undo(); }); });
  undo_->setIcon(icon(Icon::Undo));
  qApp->installEventFilter(new UndoKeys(&menu));
  redo_ = add_action(menu, "edit.redo", "&Redo", {},
                     [this] { perform([this] { return session_.history().redo(); }); });
  redo_->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
  redo_->setIcon(icon(Icon::Redo));
  menu.addSeparator();
  duplicate_ = add_action(menu, "edit.duplicate", "&Duplicate", QKeySequence("Ctrl+D"), [this] {
    perform([this] { return duplicate_selected(session_, duplicate_choices().front().how); });
  });
  duplicate_->setIcon(icon(Icon::Duplicate));
  duplicate_as_ = menu.addMenu("Duplicate &As");
  fill_duplicate_as();
  delete_ = add_action(menu, "edit.delete", "De&lete", QKeySequence::Delete,
                       [this] { perform([this] { return delete_selected(session_); }); });
  delete_->setIcon(icon(Icon::Delete));
  clear_ = add_action(menu, "edit.clear", "&Clear the Scene", {}, [this] {
    perform([this] {
      return session_.history().perform(interaction::delete_objects(session_.world(), shown_roots(session_)),
                                        "Clear the Scene");
    });
  });
  clear_->setStatusTip("Deletes all objects of the scene that is shown; undo brings them back");
  group_ = add_action(menu, "edit.group", "&Group", QKeySequence("Ctrl+G"),
                      [this] { perform([this] { return group_selected(session_); }); });
  group_->setIcon(icon(Icon::Group));
  rename_ = add_action(menu, "edit.rename", "Re&name", QKeySequence("F2"), [this] { hooks_.rename(); });
  rename_->setIcon(icon(Icon::Rename));
  menu.addSeparator();
  add_action(menu, "edit.select_all", "Select &All", QKeySequence::SelectAll,
             [this] { select_all(session_); });
  add_action(menu, "edit.select_none", "Select N&othing", QKeySequence("Ctrl+Shift+A"),
             [this] { session_.select({}); });
  add_action(menu, "edit.find", "&Find an Object\u2026", QKeySequence::Find, [this] {
    hooks_.search();
  })->setIcon(icon(Icon::Search));
  refresh();
}

void EditActions::fill_duplicate_as() {
  duplicate_as_->setToolTipsVisible(true);
  for (const DuplicateChoice& choice : duplicate_choices()) {
    QAction* action = add_action(
        *duplicate_as_, "edit.duplicate_as", choice.text, {},
        [this, how = choice.how] { perform([this, how] { return duplicate_selected(session_, how); }); });
    action->setToolTip(choice.tip);
    action->setStatusTip(choice.tip);
  }
}

void EditActions::refresh() {
  // Names of recovered actions come from a file and can be of any length.
  const auto name = [](QAction& action, const QString& what, const std::string& undone) {
    constexpr qsizetype kMost = 80;
    const QString line = shortened((what + ' ' + one_line(undone)).trimmed(), kMost);
    action.setText('&' + QString(line).replace('&', "&&"));
    action.setToolTip(tip_of(line));
  };
  const session::SessionHistory& history = session_.history();
  undo_->setEnabled(history.can_undo());
  name(*undo_, "Undo", history.undo_name());
  redo_->setEnabled(history.can_redo());
  name(*redo_, "Redo", history.redo_name());
  const std::size_t selected = session_.selection().size();
  for (QAction* action : {duplicate_, delete_, group_, duplicate_as_->menuAction()})
    action->setEnabled(selected > 0);
  rename_->setEnabled(selected == 1);
  clear_->setEnabled(!shown_roots(session_).empty());
}

}  // namespace icome::ui
