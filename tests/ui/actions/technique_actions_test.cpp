#include "ui/actions/technique_actions.h"

#include <QFile>
#include <QTemporaryDir>

#include "ui/actions/recent_files.h"
#include "ui/desktop_test.h"
#include "ui/tools/touch_tool.h"

namespace icome::ui {
namespace {

using interaction::Holding;
using interaction::Selecting;
using interaction::Travelling;

class TechniqueActionsTest : public DesktopTest {
 protected:
  TechniqueActionsTest() : settings_(folder_.filePath("icome.conf"), QSettings::IniFormat) { open_menu(); }

  void open_menu() {
    actions_ = std::make_unique<TechniqueActions>(session(), settings_, window_,
                                                  [this](const Note& note) { told_.push_back(note); });
    menu_ = std::make_unique<QMenu>();
    actions_->fill(*menu_);
  }
  QAction& action(const char* name) {
    auto* found = menu_->findChild<QAction*>(name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  const interaction::Technique* technique() {
    const session::TechniqueHand* hand = session().techniques().current();
    return hand ? &hand->technique() : nullptr;
  }

  QTemporaryDir folder_;
  QWidget window_;
  std::vector<Note> told_;
  QSettings settings_;
  std::unique_ptr<TechniqueActions> actions_;
  std::unique_ptr<QMenu> menu_;
};

TEST_F(TechniqueActionsTest, ChooseHowToSelectHoldAndTravel) {
  EXPECT_EQ(technique(), nullptr) << "by touch at first";
  EXPECT_TRUE(action("technique.touch").isChecked());
  action("technique.ray").trigger();
  ASSERT_NE(technique(), nullptr);
  EXPECT_EQ(technique()->selecting, Selecting::RayPointer);
  EXPECT_EQ(technique()->holding, Holding::AlongRay) << "as suits it";
  EXPECT_EQ(technique()->travelling, Travelling::None);
  action("technique.hold.two_hands").trigger();
  action("technique.travel.teleport").trigger();
  EXPECT_EQ(technique()->selecting, Selecting::RayPointer);
  EXPECT_EQ(technique()->holding, Holding::TwoHands);
  EXPECT_EQ(technique()->travelling, Travelling::Teleport);
  action("technique.hold.suited").trigger();
  action("technique.go_go").trigger();
  EXPECT_EQ(technique()->selecting, Selecting::GoGo);
  EXPECT_EQ(technique()->holding, Holding::GoGo);
  EXPECT_FALSE(action("technique.ray").isChecked());
  action("technique.touch").trigger();
  EXPECT_EQ(technique(), nullptr);
}

TEST_F(TechniqueActionsTest, AreRemembered) {
  action("technique.spotlight").trigger();
  action("technique.travel.fly").trigger();
  ASSERT_TRUE(session().techniques().set(std::nullopt));
  open_menu();
  EXPECT_TRUE(action("technique.spotlight").isChecked());
  EXPECT_TRUE(action("technique.travel.fly").isChecked());
  ASSERT_NE(technique(), nullptr);
  EXPECT_EQ(technique()->selecting, Selecting::Spotlight);
  EXPECT_EQ(technique()->travelling, Travelling::Fly);
  settings_.setValue("technique/selecting", "a wand");
  open_menu();
  EXPECT_TRUE(action("technique.touch").isChecked());
  EXPECT_EQ(technique(), nullptr);
}

TEST_F(TechniqueActionsTest, RecordIntoAFileUntilThatIsEndedOrAnotherIsChosen) {
  EXPECT_FALSE(action("technique.record").isEnabled()) << "by touch";
  action("technique.ray").trigger();
  EXPECT_TRUE(action("technique.record").isEnabled());
  const auto file = [&](const char* name) { return folder_.filePath(name); };
  actions_->begin_recording(path_of(file("one.recording")));
  EXPECT_EQ(action("technique.record").text(), "Stop &Recording");
  session().update();
  action("technique.record").trigger();
  EXPECT_NE(action("technique.record").text(), "Stop &Recording");
  ASSERT_EQ(told_.size(), 2U) << "that it records, and what was written";
  EXPECT_NE(told_.back().text.find("one.recording.icome"), std::string::npos) << told_.back().text;
  EXPECT_TRUE(QFile::exists(file("one.recording")) && QFile::exists(file("one.recording.icome")));
  actions_->end_recording();
  EXPECT_EQ(told_.size(), 2U) << "nothing is recorded";

  actions_->begin_recording(path_of(file("two.recording")));
  action("technique.touch").trigger();
  EXPECT_TRUE(QFile::exists(file("two.recording")));
  EXPECT_FALSE(action("technique.record").isEnabled());

  action("technique.ray").trigger();
  actions_->begin_recording(path_of(file("no/such/folder.recording")));
  actions_->end_recording();
  EXPECT_EQ(told_.back().weight, Note::Weight::Error);
}

TEST_F(TechniqueActionsTest, TheMouseHoldsTheHandsButtonWhileItPresses) {
  TouchTool tool(session());
  tool.enter({200.0, 100.0});
  action("technique.ray").trigger();
  const auto lives = [&](std::uint32_t buttons) {
    for (int i = 0; i < 2000; ++i) {
      tool.tick();
      session().update();
      if (session().hands().pointer(0).buttons == buttons) return true;
    }
    return false;
  };
  EXPECT_TRUE(lives(0));
  tool.press(TouchTool::kButton);
  EXPECT_TRUE(lives(1));
  SceneInput travelling{.at = {100.0, 50.0}, .size = {200.0, 100.0}, .modifiers = Qt::ControlModifier};
  tool.follow(travelling);
  EXPECT_TRUE(lives(2));
  tool.press(0.0);
  EXPECT_TRUE(lives(0));
  // Straight ahead, at 0.6 of the way to what is looked at.
  const interaction::View& view = session().view().now();
  const base::Vector3 there = view.world_from_eye * base::Vector3(0.0, 0.0, -0.6 * view.distance);
  bool arrived = false;
  for (int i = 0; i < 2000 && !arrived; ++i) {
    tool.tick();
    session().update();
    arrived = (session().hands().pointer(0).tip - there).norm() < 1e-6;
  }
  EXPECT_TRUE(arrived);
  action("technique.touch").trigger();
  tool.press(TouchTool::kButton);
  EXPECT_TRUE(lives(0)) << "by touch a press is only a press";
}

}  // namespace
}  // namespace icome::ui
