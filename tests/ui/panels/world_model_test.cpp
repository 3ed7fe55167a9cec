#include "ui/panels/world_model.h"

#include <QAbstractItemModelTester>
#include <QMimeData>
#include <QSignalSpy>
#include <QTextDocument>

#include "ui/desktop_test.h"
#include "ui/panels/object_look.h"
#include "world/random_edits.h"

namespace icome::ui {
namespace {

using world::ObjectId;

class WorldModelTest : public DesktopTest {
 protected:
  WorldModelTest() {
    session().on_change([this](const world::Changes* changes) { model_.follow(changes); });
  }

  ObjectId create(const std::string& name, ObjectId parent = {}) {
    const ObjectId id = session().ids().next<ObjectId>();
    world::PhysicalObject object{.name = name, .parent = parent};
    const std::size_t last = parent ? world().find(parent)->children.size() : world().roots().size();
    perform(world::CreateObject{id, last, object});
    return id;
  }
  void fetch_all(const QModelIndex& parent = {}) {
    while (model_.canFetchMore(parent)) model_.fetchMore(parent);
    for (int row = 0; row < model_.rowCount(parent); ++row) fetch_all(model_.index(row, 0, parent));
  }
  /// The rows are the world's objects, as far as they have been fetched.
  void expect_same(const QModelIndex& parent = {}) {
    const ObjectId id = ObjectModel::object(parent);
    const std::vector<ObjectId>& children = parent.isValid() ? world().find(id)->children : world().roots();
    ASSERT_EQ(model_.hasChildren(parent), !children.empty());
    if (model_.canFetchMore(parent)) return;
    ASSERT_EQ(std::size_t(model_.rowCount(parent)), children.size());
    for (int row = 0; row < model_.rowCount(parent); ++row) {
      const QModelIndex index = model_.index(row, 0, parent);
      ASSERT_EQ(ObjectModel::object(index), children[std::size_t(row)]);
      ASSERT_EQ(model_.parent(index), parent);
      expect_same(index);
    }
  }

  WorldModel model_{session(), nullptr};
};

TEST_F(WorldModelTest, FollowsEditsOfEveryKindWithRowsFetchedAndNot) {
  // Qt's own judge: it aborts when a row comes or goes in another way than the model said.
  const QAbstractItemModelTester judge(&model_, QAbstractItemModelTester::FailureReportingMode::Fatal);
  world::RandomEdits thinker(3);
  base::Random random(4);
  int done = 0;
  for (int i = 0; i < 1500; ++i) {
    // One edit, or several as one action: then things may move where nothing was before.
    world::EditGroup group;
    world::World preview = world();
    for (std::uint64_t edits = random.index(2) == 0 ? 1 : random.index(12); edits > 0; --edits) {
      world::Edit edit = thinker.next(preview);
      if (world::apply(preview, edit)) group.edits.push_back(std::move(edit));
    }
    done += session().history().perform(world::Edit(group), "Edit") ? 1 : 0;
    if (random.index(3) == 0) session().history().undo().has_value();
    if (random.index(6) == 0) session().history().redo().has_value();
    if (random.index(20) == 0 && model_.rowCount() > 0)
      fetch_all(model_.index(int(random.index(std::uint64_t(model_.rowCount()))), 0));
    expect_same();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(done, 1000);
}

TEST_F(WorldModelTest, MovingARowKeepsWhatIsBelowItOpen) {
  const ObjectId table = create("table"), desk = create("desk"), leg = create("leg", table);
  create("foot", leg);
  fetch_all();
  const QPersistentModelIndex foot = model_.index_of(world().find(leg)->children.front());
  QSignalSpy moved(&model_, &QAbstractItemModel::rowsMoved);
  QSignalSpy removed(&model_, &QAbstractItemModel::rowsRemoved);
  QSignalSpy reset(&model_, &QAbstractItemModel::modelReset);
  perform(world::MoveObject{leg, desk, 0, base::Affine3::Identity()});
  EXPECT_EQ(moved.count(), 1);
  EXPECT_EQ(removed.count() + reset.count(), 0);
  ASSERT_TRUE(foot.isValid());
  EXPECT_EQ(ObjectModel::object(foot.parent().parent()), desk);
}

TEST_F(WorldModelTest, RenamingTouchesOneRow) {
  create("one");
  const ObjectId two = create("two");
  QSignalSpy changed(&model_, &QAbstractItemModel::dataChanged);
  ASSERT_TRUE(model_.setData(model_.index_of(two), "  second\nname ", Qt::EditRole));
  EXPECT_EQ(world().find(two)->name, "second name");
  EXPECT_EQ(session().history().undo_name(), "Rename two");
  ASSERT_EQ(changed.count(), 1);
  EXPECT_EQ(changed.at(0).at(0).toModelIndex(), model_.index_of(two));
}

TEST_F(WorldModelTest, ShowsAKindAndNumberForWhatHasNoName) {
  const ObjectId id = session().ids().next<ObjectId>();
  perform(world::CreateObject{id, 0, {}});
  const QModelIndex index = model_.index_of(id);
  EXPECT_EQ(index.data().toString(), QString("Group %1").arg(id.value));
  EXPECT_EQ(index.data(Qt::EditRole).toString(), "");
}

TEST_F(WorldModelTest, DroppingKeepsThePlaceInTheWorld) {
  const ObjectId stretched = create("stretched"), thing = create("thing");
  base::Affine3 place = base::Affine3::Identity();
  place.translation() = base::Vector3(1.0, 2.0, 3.0);
  place.linear().diagonal() = base::Vector3(2.0, 1.0, 0.5);
  perform(world::PlaceObject{stretched, place});
  base::Affine3 own = base::Affine3::Identity();
  own.translation() = base::Vector3(0.1, 0.2, 0.3);
  perform(world::PlaceObject{thing, own});

  const std::unique_ptr<QMimeData> data(model_.mimeData({model_.index_of(thing)}));
  const QModelIndex target = model_.index_of(stretched);
  ASSERT_TRUE(model_.canDropMimeData(data.get(), Qt::MoveAction, -1, -1, target));
  ASSERT_TRUE(model_.dropMimeData(data.get(), Qt::MoveAction, -1, -1, target));
  EXPECT_EQ(world().find(thing)->parent, stretched);
  EXPECT_TRUE(world::world_from_object(world(), thing).isApprox(own, 1e-12));
  EXPECT_EQ(session().history().undo_name(), "Move thing under stretched");
}

TEST_F(WorldModelTest, NothingDropsUnderItself) {
  const ObjectId above = create("above"), below = create("below", above);
  const std::unique_ptr<QMimeData> data(model_.mimeData({model_.index_of(above)}));
  EXPECT_FALSE(model_.canDropMimeData(data.get(), Qt::MoveAction, -1, -1, model_.index_of(below)));
  EXPECT_FALSE(model_.canDropMimeData(data.get(), Qt::MoveAction, 0, 0, model_.index_of(above)));
  QMimeData strange;
  strange.setData("application/x-icome-objects", QByteArray("12345678123456"));
  EXPECT_FALSE(model_.canDropMimeData(&strange, Qt::MoveAction, 0, 0, {}));
}

TEST_F(WorldModelTest, ManyObjectsAreFetchedOnlyWhereLookedAt) {
  world::EditGroup group;
  const ObjectId root = session().ids().next<ObjectId>();
  group.edits.push_back(world::CreateObject{root, 0, {.name = "root"}});
  for (std::size_t i = 0; i < 20'000; ++i) {
    const ObjectId id = session().ids().next<ObjectId>();
    group.edits.push_back(world::CreateObject{id, i, {.name = "leaf", .parent = root}});
  }
  perform(world::Edit(std::move(group)));
  EXPECT_EQ(model_.rowCount(model_.index(0, 0)), 0);
  EXPECT_TRUE(model_.hasChildren(model_.index(0, 0)));
  const ObjectId last = world().find(root)->children.back();
  EXPECT_EQ(model_.index_of(last).row(), 19'999);
}

TEST(ObjectLook, PutsHostileNamesOnOneShortLine) {
  EXPECT_EQ(one_line("a\n\tb\x01 c"), "a b c");
  EXPECT_EQ(one_line(std::string(1'000'000, 'x')).size(), 200);
  EXPECT_EQ(one_line("\xff\xfe"), QString::fromUtf8("\xff\xfe"));
}

TEST(ObjectLook, ShortensWithoutHalvingLetters) {
  EXPECT_EQ(shortened("table leg", 9), "table leg");
  EXPECT_EQ(shortened("table leg", 6), QString::fromUtf8("table…"));
  const QString faces = QString::fromUtf8("ab😀😀😀");
  EXPECT_EQ(shortened(faces, 4), QString::fromUtf8("ab…"));
  EXPECT_EQ(shortened(faces, 5), QString::fromUtf8("ab😀…"));
}

TEST(ObjectLook, NamesActionsAfterOneOrTheNumberOfMany) {
  world::World world;
  world::IdSource ids;
  const auto make = [&](const std::string& name) {
    const auto id = ids.next<ObjectId>();
    EXPECT_TRUE(world::apply(world, world::CreateObject{id, 0, {.name = name}}));
    return id;
  };
  const ObjectId leg = make("leg"), unnamed = make(""), hostile = make("a\n<h1>" + std::string(2000, 'x'));
  EXPECT_EQ(action_name("Move", world, std::vector{leg}), "Move leg");
  EXPECT_EQ(action_name("Move", world, std::vector{unnamed}),
            "Move " + shown_name(world, unnamed).toStdString());
  EXPECT_EQ(action_name("Delete", world, std::vector{leg, unnamed}), "Delete 2 objects");
  const QString named = QString::fromStdString(action_name("Delete", world, std::vector{hostile}));
  EXPECT_TRUE(named.startsWith("Delete a <h1>xxx")) << named.toStdString();
  EXPECT_EQ(named.size(), 7 + 40);
}

TEST(ObjectLook, TipsShowMarkupAsItIs) {
  QTextDocument page;
  page.setHtml(tip_of("<h1>Box</h1> & \"co\"\nsecond line"));
  EXPECT_EQ(page.toPlainText(), "<h1>Box</h1> & \"co\"\nsecond line");
}

}  // namespace
}  // namespace icome::ui
