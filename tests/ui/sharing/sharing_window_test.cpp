// The window at work on a design of a server; another session is the colleague.
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDropEvent>
#include <QLabel>
#include <QListWidget>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <QUrl>

#include "collab/server/served_design.h"
#include "own_folder.h"
#include "ui/panels/wrapped_label.h"
#include "ui/sharing/conflict_dialog.h"
#include "ui/sharing/connect_dialog.h"
#include "ui/window_test.h"

namespace icome::ui {
namespace {

using collab::Role;

class SharingWindowTest : public WindowTest {
 protected:
  SharingWindowTest() : WindowTest({.kept_folder = own_folder("kept")}) {
    auto made = session::Session::create({});
    EXPECT_TRUE(made) << made.error().message;
    colleague_ = std::move(*made);
    colleague_->sharing().open(served_.link(Role::Edit), "Bob & <b>Co</b>");
    EXPECT_TRUE(both_until([&] { return colleague_->sharing().state().has_value(); }));
  }
  /// Leaves the design, as the server that ends would wait for the window to do.
  ~SharingWindowTest() override { session().files().make_new(); }
  template <typename Come>
  bool both_until(const Come& come) {
    return until([&] {
      (void)colleague_->update();
      return come();
    });
  }
  template <typename Widget>
  Widget& part(const char* name) {
    auto* const found = window_->findChild<Widget*>(name);
    if (found == nullptr) throw std::runtime_error(name);
    return *found;
  }
  /// As a person who pastes a link.
  void join() {
    action("file.open_address")->trigger();
    auto& dialog = part<QDialog>("connect");
    dialog.findChild<QLineEdit*>("connect.address")->setText(QString::fromStdString(served_.link(Role::Own)));
    dialog.findChild<QLineEdit*>("connect.name")->setText("Ann");
    dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
    ASSERT_TRUE(both_until([&] { return session().sharing().state().has_value(); }));
    ASSERT_TRUE(until_title("table - ICOME"));
  }
  bool same() {
    return both_until([&] {
      return session().sharing().state()->unsent == 0 && colleague_->sharing().state()->unsent == 0 &&
             hash(world()) == hash(colleague_->world());
    });
  }

  collab::ServedDesign served_;
  std::unique_ptr<session::Session> colleague_;
};

TEST_F(SharingWindowTest, SaysWhatIsWrongWithAnAddressWhileItIsTyped) {
  action("file.open_address")->trigger();
  auto& dialog = part<QDialog>("connect");
  auto& address = part<QLineEdit>("connect.address");
  QPushButton& open = *dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open);
  EXPECT_FALSE(open.isEnabled());
  address.setText("table.wrl");
  EXPECT_FALSE(open.isEnabled());
  EXPECT_FALSE(part<QLabel>("connect.remark").text().isEmpty());
  const QString link = QString::fromStdString(served_.link(Role::Own));
  address.setText("  " + link + "\n");
  EXPECT_TRUE(open.isEnabled());
  const QString token = link.mid(link.indexOf("token=") + 6, 20);
  EXPECT_FALSE(part<QLabel>("connect.remark").text().contains(token)) << "it is a secret";
}

TEST_F(SharingWindowTest, OpensALinkThatIsDroppedOnIt) {
  const QString link = QString::fromStdString(served_.link(Role::Edit));
  QMimeData text, url;
  text.setText(link + "\n");
  url.setUrls({QUrl(link)});  // as from a browser
  for (const QMimeData* data : {&text, &url}) {
    action("file.new")->trigger();
    ASSERT_FALSE(session().sharing().state());
    QDragEnterEvent entered({10, 10}, Qt::CopyAction, data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(window_.get(), &entered);
    EXPECT_TRUE(entered.isAccepted());
    QDropEvent drop({10.0, 10.0}, Qt::CopyAction, data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(window_.get(), &drop);
    ASSERT_TRUE(both_until([&] { return session().sharing().state().has_value(); }));
  }
}

TEST_F(SharingWindowTest, ShowsWhoIsHereWhatTheyHoldAndSay) {
  join();
  auto& people = part<QListWidget>("sharing.people");
  ASSERT_TRUE(both_until([&] { return people.count() == 2; }));
  EXPECT_EQ(people.item(0)->text(), "Ann (you)");
  EXPECT_EQ(people.item(1)->text(), "Bob & <b>Co</b>") << "as it is, without any markup";
  const world::ObjectId leg = add("leg");
  ASSERT_TRUE(same());
  colleague_->select({leg});
  ASSERT_TRUE(both_until([&] { return people.item(1)->text().endsWith(QString::fromUtf8("\u2013 leg")); }));
  EXPECT_TRUE(part<QLabel>("status.sharing").text().startsWith("table: 2 people"));
  auto& line = part<QLineEdit>("sharing.say");
  line.setText("Is the leg <i>yours</i>?");
  QTest::keyClick(&line, Qt::Key_Return);
  auto& words = part<QPlainTextEdit>("sharing.words");
  ASSERT_TRUE(both_until([&] { return words.toPlainText().contains("Ann: Is the leg <i>yours</i>?"); }));
  EXPECT_EQ(colleague_->sharing().lines().back().text, "Is the leg <i>yours</i>?");
  for (int i = 0; i < 30 && line.text().isEmpty(); ++i) {
    line.setText(QString("line %1").arg(i));
    QTest::keyClick(&line, Qt::Key_Return);
  }
  EXPECT_FALSE(line.text().isEmpty()) << "what cannot be said stays to be said";
}

TEST_F(SharingWindowTest, AsksWhereBothChangedTheSameWithoutAServer) {
  join();
  const world::ObjectId leg = add("leg"), lamp = add("lamp");
  ASSERT_TRUE(same());
  served_.stop();
  const auto away = [](const session::Session& it) {
    return it.sharing().state()->connection == collab::ConversationState::Away;
  };
  ASSERT_TRUE(both_until([&] { return away(session()) && away(*colleague_); }));
  for (const world::ObjectId id : {leg, lamp}) {
    perform(world::RenameObject{id, "of Ann"});
    ASSERT_TRUE(colleague_->history().perform(world::RenameObject{id, "of Bob"}, "Rename"));
  }
  served_.start();
  // Bob's come first: Ann's window does not look meanwhile.
  for (int i = 0; i < 3'000 && colleague_->sharing().state()->unsent > 0; ++i) {
    (void)colleague_->update();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(both_until([&] { return window_->findChild<QDialog*>("conflicts") != nullptr; }));
  auto& dialog = part<QDialog>("conflicts");
  const auto boxes = dialog.findChildren<QComboBox*>();
  ASSERT_EQ(boxes.size(), 2);
  EXPECT_EQ(boxes[0]->currentData().toInt(), int(collab::Choice::Both))
      << "nothing is lost where nobody looks";
  boxes[0]->setCurrentIndex(boxes[0]->findData(int(collab::Choice::Mine)));
  boxes[1]->setCurrentIndex(boxes[1]->findData(int(collab::Choice::Theirs)));
  dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->click();
  ASSERT_TRUE(same());
  EXPECT_EQ(world().find(leg)->name, "of Ann");
  EXPECT_EQ(world().find(lamp)->name, "of Bob");
}

TEST_F(SharingWindowTest, AsksBeforeWhatTheServerHasNotGotIsLeft) {
  join();
  served_.stop();
  ASSERT_TRUE(
      both_until([&] { return session().sharing().state()->connection == collab::ConversationState::Away; }));
  add("leg");
  action("file.new")->trigger();
  auto& box = part<QDialog>("save_changes");
  EXPECT_TRUE(session().sharing().state());
  box.reject();
  served_.start();
  ASSERT_TRUE(same());
  action("file.new")->trigger();
  EXPECT_FALSE(session().sharing().state()) << "all is on the server: nothing to ask";
}

TEST_F(SharingWindowTest, KeepsADesignForOfflineWorkUntilToldNotTo) {
  EXPECT_FALSE(action("file.keep")->isEnabled()) << "there is no design of a server";
  join();
  const world::ObjectId leg = add("leg");
  ASSERT_TRUE(same());
  const auto keep = [&] {
    QAction* const entry = action("file.keep");
    QMetaObject::invokeMethod(entry->associatedObjects().front(), "aboutToShow");
    return entry;
  };
  ASSERT_TRUE(keep()->isEnabled());
  EXPECT_FALSE(keep()->isChecked());
  keep()->trigger();
  EXPECT_TRUE(keep()->isChecked());
  action("file.new")->trigger();
  served_.stop();
  EXPECT_FALSE(keep()->isEnabled());
  join();
  EXPECT_EQ(session().sharing().state()->connection, collab::ConversationState::Away);
  EXPECT_EQ(world().find(leg)->name, "leg");
  EXPECT_TRUE(keep()->isChecked());
  keep()->trigger();
  EXPECT_FALSE(keep()->isChecked()) << "nothing of it is kept any more";
  const auto tells = [&](const char* words) {
    for (const QLabel* label : part<QWidget>("banner").findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains(words)) return true;
    return false;
  };
  EXPECT_TRUE(until([&] { return tells("the copy that was kept here"); }));
  action("file.new")->trigger();
  EXPECT_TRUE(until([&] { return !tells("the copy that was kept here"); })) << "it is not open any more";
}

}  // namespace
}  // namespace icome::ui
