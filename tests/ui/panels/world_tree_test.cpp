#include "ui/panels/world_tree.h"

#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <QTreeView>

#include "ui/actions/object_menu.h"
#include "ui/desktop_test.h"
#include "ui/panels/match_model.h"
#include "ui/panels/object_model.h"
#include "world/shape/solid_geometry.h"

namespace icome::ui {
namespace {

using world::ObjectId;

class WorldTreeTest : public DesktopTest {
 protected:
  ObjectId create(const std::string& name, ObjectId parent = {}) {
    const ObjectId id = session().ids().next<ObjectId>();
    const std::size_t last = parent ? world().find(parent)->children.size() : world().roots().size();
    perform(world::CreateObject{id, last, {.name = name, .parent = parent}});
    return id;
  }
  /// The view that is seen, of the tree or of what was found.
  static QTreeView& view(WorldTree& tree) {
    for (QTreeView* it : tree.findChildren<QTreeView*>()) {
      if (it->isVisibleTo(&tree)) return *it;
    }
    throw std::logic_error("no view");
  }
  static std::vector<ObjectId> selected(QTreeView& view) {
    std::vector<ObjectId> objects;
    for (const QModelIndex& index : view.selectionModel()->selectedRows())
      objects.push_back(ObjectModel::object(index));
    std::sort(objects.begin(), objects.end());
    return objects;
  }
  static QModelIndex find(QTreeView& view, ObjectId object) {
    return static_cast<ObjectModel*>(view.model())->index_of(object);
  }
};

TEST_F(WorldTreeTest, SelectsWhatTheSessionSelectsAndTheOtherWayRound) {
  const ObjectId table = create("table"), leg = create("leg", table), vase = create("vase");
  WorldTree tree(session(), nullptr);
  QTreeView& rows = view(tree);
  session().select({leg, vase});
  EXPECT_EQ(selected(rows), (std::vector{leg, vase}));
  rows.selectionModel()->select(find(rows, table), QItemSelectionModel::ClearAndSelect);
  EXPECT_EQ(session().selection(), std::vector{table});
  rows.selectionModel()->select(find(rows, vase), QItemSelectionModel::Select);
  EXPECT_EQ(session().selection(), (std::vector{table, vase}));
  perform(world::delete_subtree(world(), table));
  EXPECT_EQ(session().selection(), std::vector{vase});
  EXPECT_EQ(selected(rows), std::vector{vase});
}

TEST_F(WorldTreeTest, FindsByNameWhileTheWorldChanges) {
  const ObjectId table = create("Table"), leg = create("Table leg", table);
  create("Vase");
  WorldTree tree(session(), nullptr);
  QTest::keyClicks(tree.findChild<QLineEdit*>(), "tabl");
  QTreeView& found = view(tree);
  ASSERT_EQ(found.model()->rowCount(), 2);
  EXPECT_EQ(found.model()->index(1, 0).data(ObjectModel::PathRole).toString(), "Table");
  perform(world::RenameObject{leg, "Leg"});
  EXPECT_EQ(found.model()->rowCount(), 1);
  create("Second table");
  EXPECT_EQ(found.model()->rowCount(), 2);
  perform(world::delete_subtree(world(), table));
  EXPECT_EQ(found.model()->rowCount(), 1);
  tree.findChild<QLineEdit*>()->clear();
  EXPECT_EQ(view(tree).model()->rowCount(), 2);
}

TEST_F(WorldTreeTest, DeletesGroupsAndDuplicatesAsOneActionEach) {
  const ObjectId one = create("one"), two = create("two");
  create("below", two);
  session().select({one, two});
  ASSERT_TRUE(group_selected(session()));
  EXPECT_EQ(session().history().undo_name(), "Group 2 objects");
  const ObjectId group = session().selection().front();
  EXPECT_EQ(world().find(group)->children, (std::vector{one, two}));
  ASSERT_TRUE(duplicate_selected(session(), world::Duplicate::CopyObjectAndChildren));
  EXPECT_EQ(world().objects().size(), 8U);
  ASSERT_TRUE(delete_selected(session()));
  EXPECT_EQ(world().objects().size(), 4U);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(world().roots(), (std::vector{one, two}));
  session().select({});
  EXPECT_TRUE(delete_selected(session()));
  EXPECT_EQ(world().objects().size(), 3U);
}

TEST_F(WorldTreeTest, DuplicatesComeInTheOrderOfTheirModels) {
  session().select({create("one"), create("two"), create("three")});
  ASSERT_TRUE(duplicate_selected(session(), world::Duplicate::CloneObject));
  const std::vector<ObjectId> made(world().roots().begin() + 3, world().roots().end());
  EXPECT_EQ(session().selection(), made);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(world().find(made[i])->name, world().find(world().roots()[i])->name);
}

TEST_F(WorldTreeTest, OffersOnlyTheWaysToDuplicateThatDiffer) {
  const ObjectId table = create("table"), leg = create("leg", table);
  const auto ways = [this](ObjectId object) {
    session().select({object});
    QMenu menu;
    fill_object_menu(menu, session(), {});
    for (const QAction* action : menu.actions()) {
      if (action->menu()) return action->menu()->actions().size();
    }
    return qsizetype(0);
  };
  EXPECT_EQ(ways(table), 6);
  EXPECT_EQ(ways(leg), 2);
}

TEST_F(WorldTreeTest, ManyObjectsCostAnEditNoMoreThanTheirOwnRows) {
  world::EditGroup group;
  for (std::size_t i = 0; i < 100'000; ++i)
    group.edits.push_back(world::CreateObject{session().ids().next<ObjectId>(), i, {.name = "thing"}});
  perform(world::Edit(std::move(group)));
  WorldTree tree(session(), nullptr);
  QTreeView& rows = view(tree);
  QSignalSpy changed(rows.model(), &QAbstractItemModel::dataChanged);
  QSignalSpy reset(rows.model(), &QAbstractItemModel::modelReset);
  const std::vector<ObjectId> roots = world().roots();
  for (std::size_t i = 0; i < 20; ++i) perform(world::RenameObject{roots[i * 4999], "renamed"});
  EXPECT_EQ(changed.count(), 20);
  EXPECT_EQ(reset.count(), 0);
  session().select(roots);
  EXPECT_EQ(rows.selectionModel()->selection().size(), 1);  // one range
}

TEST_F(WorldTreeTest, FindsManyAndShowsWhichAreSelected) {
  world::EditGroup group;
  std::vector<ObjectId> all;
  for (std::size_t i = 0; i < 20'000; ++i) {
    all.push_back(session().ids().next<ObjectId>());
    group.edits.push_back(world::CreateObject{all.back(), i, {.name = i % 2 ? "odd" : "even"}});
  }
  perform(world::Edit(std::move(group)));
  WorldTree tree(session(), nullptr);
  QTest::keyClicks(tree.findChild<QLineEdit*>(), "odd");
  QTreeView& found = view(tree);
  session().select(all);
  EXPECT_EQ(selected(found).size(), 10'000U);
  EXPECT_EQ(session().selection().size(), 20'000U);
  // Rows keep their numbers straight when some go and others come.
  perform(world::RenameObject{all[1], "even now"});
  perform(world::RenameObject{all[2], "odd now"});
  EXPECT_FALSE(find(found, all[1]).isValid());
  EXPECT_EQ(find(found, all[3]).row(), 0);
  EXPECT_EQ(find(found, all[2]).row(), 9'999);
  for (const std::size_t i : {3U, 5U, 19'999U, 2U})
    EXPECT_EQ(ObjectModel::object(find(found, all[i])), all[i]) << i;
  EXPECT_EQ(selected(found).size(), 10'000U);
  // The tree was told nothing meanwhile; it is when it is seen again.
  session().select({all[7]});
  tree.findChild<QLineEdit*>()->clear();
  EXPECT_EQ(selected(view(tree)), std::vector{all[7]});
}

TEST_F(WorldTreeTest, OutlivesNothingThatTheSessionTellsLater) {
  create("one");
  { const WorldTree tree(session(), nullptr); }
  WorldTree later(session(), nullptr);
  const ObjectId two = create("two");
  session().select({two});
  EXPECT_EQ(view(later).model()->rowCount(), 2);
  EXPECT_EQ(selected(view(later)), std::vector{two});
}

}  // namespace
}  // namespace icome::ui
