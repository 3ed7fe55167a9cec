#include "ui/window/banner.h"

#include <QLabel>
#include <QLayout>
#include <QPlainTextEdit>
#include <QPushButton>

#include "ui/desktop_test.h"
#include "ui/window/banner_row.h"

namespace icome::ui {
namespace {

class BannerTest : public ::testing::Test {
 protected:
  BannerTest() : banner_((application(), nullptr)) {}

  /// What is seen, from top to bottom.
  QStringList texts() {
    QStringList seen;
    for (int i = 0; i < banner_.layout()->count(); ++i) {
      QWidget* row = banner_.layout()->itemAt(i)->widget();
      if (!row->isHidden()) seen << row->findChild<QLabel*>("banner.text")->text();
    }
    return seen;
  }
  void press(const char* name) {
    auto* button = banner_.findChild<QAbstractButton*>(name);
    ASSERT_TRUE(button) << name;
    button->click();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }

  Banner banner_;
};

TEST_F(BannerTest, IsThereOnlyWhenItHasSomethingToSay) {
  EXPECT_TRUE(banner_.isHidden());
  banner_.tell({.text = "One."});
  EXPECT_FALSE(banner_.isHidden());
  press("banner.close");
  EXPECT_TRUE(banner_.isHidden());
}

TEST_F(BannerTest, ShowsTheNewestFirstAndThreeAtMost) {
  for (const char* text : {"1", "2", "3", "4"}) banner_.tell({.text = text});
  EXPECT_EQ(texts(), (QStringList{"4", "3", "2"}));
  press("banner.close");  // of the first that was told
  banner_.tell({.text = "5"});
  EXPECT_EQ(texts(), (QStringList{"5", "4", "3"}));
}

TEST_F(BannerTest, ReplacesWhatWasSaidOfATopic) {
  banner_.tell({.text = "The device is lost.", .topic = "device"});
  banner_.tell({.text = "The disk is full.", .topic = "autosave"});
  banner_.tell({.text = "The device is back.", .topic = "device"});
  EXPECT_EQ(texts(), (QStringList{"The device is back.", "The disk is full."}));
  banner_.forget("autosave");
  EXPECT_EQ(texts(), QStringList("The device is back."));
}

TEST_F(BannerTest, OffersWhatCanBeDone) {
  std::vector<Note::Remedy> asked;
  banner_.on_remedy([&](const Note& note, Note::Remedy remedy) {
    EXPECT_EQ(note.text, "It failed.");
    asked.push_back(remedy);
  });
  banner_.tell({.text = "It failed.", .remedies = {Note::Remedy::SaveAgain, Note::Remedy::SaveAs}});
  press("banner.Try Again");
  EXPECT_EQ(asked, std::vector{Note::Remedy::SaveAgain});
  EXPECT_TRUE(banner_.isHidden());
}

TEST_F(BannerTest, GivesDetailsOnDemand) {
  banner_.tell({.text = "Opened.", .details = {"A <b>Script</b>.", "B."}});
  auto* list = banner_.findChild<QPlainTextEdit*>("banner.list");
  ASSERT_TRUE(list);
  EXPECT_TRUE(list->isHidden());
  press("banner.details");
  EXPECT_FALSE(list->isHidden());
  EXPECT_EQ(list->toPlainText(), "A <b>Script</b>.\nB.");
}

TEST_F(BannerTest, ShowsProgressAboveAllAndCancels) {
  int cancelled = 0;
  banner_.tell({.text = "A."});
  banner_.show_progress("Reading a.wrl\u2026", 0.25, [&] { ++cancelled; });
  banner_.tell({.text = "B."});
  EXPECT_EQ(texts(), (QStringList{"Reading a.wrl\u2026", "B.", "A."}));
  press("banner.cancel");
  EXPECT_EQ(cancelled, 1);
  banner_.hide_progress();
  EXPECT_EQ(texts(), (QStringList{"B.", "A."}));
}

TEST_F(BannerTest, OffersToCancelOnlyWhatCanBe) {
  int cancelled = 0;
  const auto shown = [this] { return banner_.findChildren<QWidget*>("banner.progress").size(); };
  banner_.show_progress("Saving a.wrl\u2026", std::nullopt, {});
  EXPECT_FALSE(banner_.findChild<QPushButton*>("banner.cancel"));
  banner_.show_progress("Reading b.wrl\u2026", 0.0, [&] { ++cancelled; });
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_EQ(shown(), 1);
  press("banner.cancel");
  EXPECT_EQ(cancelled, 1);
  banner_.show_progress("Saving a.wrl\u2026", std::nullopt, {});
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  EXPECT_EQ(shown(), 1);
  EXPECT_FALSE(banner_.findChild<QPushButton*>("banner.cancel"));
  EXPECT_EQ(texts(), QStringList("Saving a.wrl\u2026"));
}

}  // namespace
}  // namespace icome::ui
