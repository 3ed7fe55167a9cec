#include "ui/actions/object_menu.h"

#include <QAction>
#include <algorithm>
#include <ranges>

#include "interaction/object_edits.h"
#include "interaction/object_move.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using world::Duplicate;
using world::ObjectId;

namespace {

bool has_children(const session::Session& session) {
  for (const ObjectId id : session.selection()) {
    const world::PhysicalObject* object = session.world().find(id);
    if (object && !object->children.empty()) return true;
  }
  return false;
}

void add_duplicates(QMenu& menu, session::Session& session, const ObjectMenu& entries) {
  QMenu* ways = menu.addMenu(icon(Icon::Duplicate), "&Duplicate");
  ways->setToolTipsVisible(true);
  const bool all = has_children(session);
  for (const DuplicateChoice& choice : duplicate_choices()) {
    // Without children only two of the ways differ.
    const bool simple = choice.how == Duplicate::CopyObject || choice.how == Duplicate::CloneObject;
    if (!all && !simple) continue;
    QAction* action = ways->addAction(choice.text);
    action->setToolTip(choice.tip);
    QObject::connect(action, &QAction::triggered, &menu,
                     [&session, how = choice.how, refused = entries.refused] {
                       const auto done = duplicate_selected(session, how);
                       if (!done && refused) refused(done.error().message);
                     });
  }
}

/// Ways to get what another holds.
void add_floor(QMenu& menu, session::Session& session, const ObjectMenu& entries) {
  if (session.selection().size() != 1) return;
  const auto holder = session.sharing().holder_of(session.selection().front());
  const auto state = session.sharing().state();
  if (!holder || !state) return;
  const QString name = shortened(one_line(holder->name)).replace('&', "&&");
  menu.addAction(QString("&Wait until %1 Gives It Back").arg(name), &menu,
                 [&session, id = session.selection().front()] { session.sharing().wait_for(id); });
  if (state->role == collab::Role::Own)
    menu.addAction(QString("Take It &Away from %1").arg(name), &menu,
                   [&session, object = holder->object, refused = entries.refused] {
                     const auto done = session.sharing().take_away(object);
                     if (!done && refused) refused(done.error().message);
                   });
  menu.addSeparator();
}

}  // namespace

base::Result<void> delete_selected(session::Session& session) {
  const std::vector<ObjectId> objects = interaction::topmost(session.world(), session.selection());
  if (objects.empty()) return {};
  const std::string name = action_name("Delete", session.world(), objects);
  return session.history().perform(interaction::delete_objects(session.world(), objects), name);
}

base::Result<void> group_selected(session::Session& session) {
  const std::vector<ObjectId> objects = interaction::topmost(session.world(), session.selection());
  if (objects.empty()) return {};
  const auto grouping = interaction::group_objects(session.world(), objects, session.ids());
  if (!grouping) return tl::unexpected(grouping.error());
  const auto done = session.history().perform(grouping->edit, action_name("Group", session.world(), objects));
  if (done) session.select({grouping->group});
  return done;
}

base::Result<void> duplicate_selected(session::Session& session, Duplicate how) {
  const std::vector<ObjectId> models = interaction::topmost(session.world(), session.selection());
  if (models.empty()) return {};
  world::EditGroup group;
  std::vector<ObjectId> made;
  // Each is put at the present end of its parent's children; so the last comes first, to keep their order.
  for (const ObjectId model : models | std::views::reverse) {
    const ObjectId parent = session.world().find(model)->parent;
    auto duplication = world::duplicate(session.world(), model, how, parent, session.ids());
    if (!duplication) return tl::unexpected(duplication.error());
    group.edits.push_back(std::move(duplication->edit));
    made.push_back(duplication->object);
  }
  std::ranges::reverse(made);
  const auto done = session.history().perform(world::Edit(std::move(group)),
                                              action_name("Duplicate", session.world(), models));
  if (done) session.select(made);
  return done;
}

const std::vector<DuplicateChoice>& duplicate_choices() {
  static const std::vector<DuplicateChoice> kChoices{
      {Duplicate::CopyObjectAndChildren, "Copy with &all below", "Shapes of their own, all the way down"},
      {Duplicate::CloneObjectAndChildren, "Clone with all &below",
       "Shares all shapes with its model: change one, and all change"},
      {Duplicate::CopyObject, "&Copy alone", "A shape of its own; without what is below"},
      {Duplicate::CloneObject, "C&lone alone",
       "Shares its shape with its model: change one, and both change; without what is below"},
      {Duplicate::CopyObjectCloneChildren, "Copy, clone what is &under it",
       "A shape of its own; what is below shares the model's shapes"},
      {Duplicate::CloneObjectCopyChildren, "Clone, copy what is un&der it",
       "Shares its own shape; what is below gets shapes of its own"},
  };
  return kChoices;
}

void fill_object_menu(QMenu& menu, session::Session& session, const ObjectMenu& entries) {
  if (session.selection().empty()) return;
  const auto report = [refused = entries.refused](const base::Result<void>& done) {
    if (!done && refused) refused(done.error().message);
  };
  add_floor(menu, session, entries);
  if (entries.zoom) menu.addAction(icon(Icon::ZoomToSelection), "&Zoom to", &menu, entries.zoom);
  if (entries.rename) menu.addAction(icon(Icon::Rename), "&Rename", &menu, entries.rename);
  if (entries.draw) menu.addAction("Dra&w on It\u2026", &menu, entries.draw);
  if (entries.picture) menu.addAction("Put a &Picture On\u2026", &menu, entries.picture);
  menu.addSeparator();
  add_duplicates(menu, session, entries);
  menu.addAction(icon(Icon::Group), "&Group", &menu, [&session, report] { report(group_selected(session)); });
  menu.addSeparator();
  menu.addAction(icon(Icon::Delete), "De&lete", &menu,
                 [&session, report] { report(delete_selected(session)); });
}

}  // namespace icome::ui
