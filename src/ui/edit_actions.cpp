#include "ui/edit_actions.h"

#include <algorithm>
#include <utility>

#include "interaction/object_move.h"
#include "ui/actions.h"
#include "ui/icons.h"

namespace icome::ui {
namespace {

using interaction::topmost;
using world::Duplicate;
using world::ObjectId;

struct WayToDuplicate {
  Duplicate how;
  const char* name;
  const char* text;
  const char* hint;
};
constexpr WayToDuplicate kWays[] = {
    {Duplicate::CopyObjectAndChildren, "edit.copy_all", "&Copy with Children",
     "Shapes of their own: changing one leaves the other"},
    {Duplicate::CloneObjectAndChildren, "edit.clone_all", "C&lone with Children",
     "Shared shapes: change one, and all change"},
    {Duplicate::CopyObject, "edit.copy", "Copy, &without Children", "A shape of its own"},
    {Duplicate::CloneObject, "edit.clone", "Clone, with&out Children", "A shared shape"},
    {Duplicate::CopyObjectCloneChildren, "edit.copy_clone", "Copy, Children Clone&d",
     "A shape of its own; those of the children are shared"},
    {Duplicate::CloneObjectCopyChildren, "edit.clone_copy", "Clone, Children Co&pied",
     "A shared shape; the children get their own"},
};

/// Performs the first edit as an action of that name and the others as more of it: each is made for the world
/// as the one before left it.
class OneAction {
 public:
  OneAction(session::Session& session, std::string name) : session_(session), name_(std::move(name)) {}
  base::Result<void> add(const world::Edit& edit) {
    const auto done = begun_ ? session_.extend(edit) : session_.perform(edit, name_);
    begun_ = begun_ || done;
    return done;
  }

 private:
  session::Session& session_;
  std::string name_;
  bool begun_ = false;
};

void collect_shapes(const world::World& world, ObjectId root, std::vector<ObjectId>& found) {
  for (const ObjectId id : world::subtree(world, root)) {
    if (world.find(id)->geometry) found.push_back(id);
  }
}

}  // namespace

base::Result<void> delete_selection(session::Session& session) {
  const std::vector<ObjectId> doomed = topmost(session.world(), session.selection());
  OneAction action(session, interaction::action_name("Delete", session.world(), doomed));
  for (const ObjectId id : doomed) {
    if (auto done = action.add(world::delete_subtree(session.world(), id)); !done) return done;
  }
  return {};
}

base::Result<void> duplicate_selection(session::Session& session, Duplicate how) {
  const std::vector<ObjectId> models = topmost(session.world(), session.selection());
  OneAction action(session, interaction::action_name("Duplicate", session.world(), models));
  std::vector<ObjectId> made;
  for (const ObjectId id : models) {
    const ObjectId parent = session.world().find(id)->parent;
    const auto twin = world::duplicate(session.world(), id, how, parent, session.ids());
    if (!twin) return tl::unexpected(twin.error());
    if (auto done = action.add(twin->edit); !done) return done;
    made.push_back(twin->object);
  }
  if (!made.empty()) session.select(std::move(made));
  return {};
}

void select_all(session::Session& session) {
  std::vector<ObjectId> all;
  const world::World& world = session.world();
  const world::Scene* scene = world.find(session.shown_scene());
  for (const ObjectId root : scene ? scene->roots : world.roots()) collect_shapes(world, root, all);
  session.select(std::move(all));
}

EditActions::EditActions(session::Session& session, Hooks hooks)
    : session_(session), hooks_(std::move(hooks)) {}

void EditActions::perform(const std::function<base::Result<void>()>& act) {
  hooks_.begin();
  if (const auto done = act(); !done) hooks_.refused(done.error().message);
}

void EditActions::fill(QMenu& menu) {
  undo_ = add_action(menu, "edit.undo", "&Undo", QKeySequence("Ctrl+Z"),
                     [this] { perform([this] { return session_.undo(); }); });
  undo_->setIcon(icon(Icon::Undo));
  redo_ = add_action(menu, "edit.redo", "&Redo", {}, [this] { perform([this] { return session_.redo(); }); });
  redo_->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
  redo_->setIcon(icon(Icon::Redo));
  menu.addSeparator();
  duplicate_ = add_action(menu, "edit.duplicate", "&Duplicate", QKeySequence("Ctrl+D"), [this] {
    perform([this] { return duplicate_selection(session_, Duplicate::CopyObjectAndChildren); });
  });
  duplicate_->setIcon(icon(Icon::Duplicate));
  duplicate_as_ = menu.addMenu("Duplicate &As");
  fill_duplicate_as();
  delete_ = add_action(menu, "edit.delete", "De&lete", QKeySequence::Delete,
                       [this] { perform([this] { return delete_selection(session_); }); });
  delete_->setIcon(icon(Icon::Delete));
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
  for (const WayToDuplicate& way : kWays) {
    QAction* action = add_action(*duplicate_as_, way.name, way.text, {}, [this, how = way.how] {
      perform([this, how] { return duplicate_selection(session_, how); });
    });
    action->setToolTip(way.hint);
    action->setStatusTip(way.hint);
  }
}

void EditActions::refresh() {
  const auto named = [](const char* what, std::string name) {
    const QString text = QString::fromStdString(name).replace('&', "&&");
    return text.isEmpty() ? QString(what) : QString("%1 %2").arg(what, text);
  };
  const world::History& history = session_.history();
  undo_->setEnabled(history.can_undo());
  undo_->setText(named("&Undo", history.undo_name()));
  redo_->setEnabled(history.can_redo());
  redo_->setText(named("&Redo", history.redo_name()));
  const std::size_t selected = session_.selection().size();
  for (QAction* action : {duplicate_, delete_, duplicate_as_->menuAction()}) action->setEnabled(selected > 0);
  rename_->setEnabled(selected == 1);
}

}  // namespace icome::ui
