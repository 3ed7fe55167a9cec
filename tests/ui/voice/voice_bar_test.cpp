// Voice commands of the window, typed and spoken.
#include "ui/voice/voice_bar.h"

#include <QKeyEvent>
#include <QToolButton>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "places.h"
#include "ui/window_test.h"

namespace icome::ui {
namespace {

class VoiceBarTest : public WindowTest {
 protected:
  VoiceBarTest() { action("tool.voice")->trigger(); }

  void type(const QString& sentence) {
    auto* const field = window_->findChild<QLineEdit*>("voice.sentence");
    field->setText(sentence);
    emit field->returnPressed();
  }
  QString text(const char* name) { return window_->findChild<QLabel*>(name)->text(); }
  VoiceAgent::Mood mood() {
    return static_cast<VoiceAgent*>(window_->findChild<QWidget*>("voice.agent"))->mood();
  }
  std::vector<world::ObjectId> named(const std::string& name) {
    std::vector<world::ObjectId> found;
    for (const auto& [id, object] : world().objects())
      if (object.name.starts_with(name)) found.push_back(id);
    return found;
  }
};

TEST_F(VoiceBarTest, TypedSentencesMakeThingsAndAreUndone) {
  EXPECT_TRUE(window_->findChild<QWidget*>("voice")->isVisible());
  type("create a small red sphere");
  ASSERT_EQ(named("sphere").size(), 1U);
  EXPECT_EQ(text("voice.reply"), "Small red sphere.");
  EXPECT_TRUE(text("voice.heard").contains("create a small red sphere"));
  EXPECT_EQ(mood(), VoiceAgent::Mood::Understood);
  EXPECT_EQ(session().selection(), named("sphere"));
  type("make it blue");
  type("undo");
  type("undo that");
  EXPECT_TRUE(named("sphere").empty());
  type("a purple elephant");
  EXPECT_EQ(mood(), VoiceAgent::Mood::Puzzled);
  EXPECT_EQ(world().objects().size(), 0U);
}

TEST_F(VoiceBarTest, LeftAndRightAreThoseOfTheView) {
  type("a red box");
  // From behind, what stands left of it is at larger x.
  auto view = session().view().now();
  view.world_from_eye = base::Pose(Eigen::AngleAxisd(M_PI, base::Vector3::UnitY()));
  view.world_from_eye.translation() = base::Vector3(0.0, 0.1, -1.0);
  session().view().set(view);
  type("a blue cone left of the red box");
  const auto boxes = named("box"), cones = named("cone");
  ASSERT_EQ(boxes.size() + cones.size(), 2U);
  const auto x = [&](world::ObjectId id) { return world::bounds(world(), id).center().x(); };
  EXPECT_GT(x(cones[0]), x(boxes[0]) + 0.05);
}

TEST_F(VoiceBarTest, AQuestionNumbersItsCandidates) {
  type("two green cones");
  session().select({});
  type("select the green cone");
  EXPECT_EQ(mood(), VoiceAgent::Mood::Asking);
  EXPECT_TRUE(text("voice.reply").startsWith("Which one"));
  EXPECT_TRUE(session().selection().empty());
  type("the left one");
  EXPECT_EQ(session().selection().size(), 1U);
}

TEST_F(VoiceBarTest, MenusAreOpenedAndChosenFrom) {
  type("open the menu");
  ASSERT_NE(session().menu().use(), nullptr) << text("voice.reply").toStdString();
  type("close the menu");
  EXPECT_EQ(session().menu().use(), nullptr);
  type("open the shape menu");
  ASSERT_NE(session().menu().use(), nullptr) << text("voice.reply").toStdString();
  type("choose ball");
  EXPECT_TRUE(until([&] { return named("sphere").size() == 1; })) << text("voice.reply").toStdString();
}

TEST_F(VoiceBarTest, ListensOnlyWhileItIsShown) {
  auto* const microphone = window_->findChild<QToolButton*>("voice.microphone");
  EXPECT_EQ(mood(), VoiceAgent::Mood::Asleep);
  microphone->setChecked(true);
  EXPECT_TRUE(until([&] { return mood() != VoiceAgent::Mood::Asleep; }));
  action("tool.voice")->trigger();
  EXPECT_FALSE(microphone->isChecked());
  action("tool.voice")->trigger();
  EXPECT_TRUE(until([&] { return mood() == VoiceAgent::Mood::Asleep; }));
}

TEST_F(VoiceBarTest, WaysOfListeningAreKept) {
  auto* const microphone = window_->findChild<QToolButton*>("voice.microphone");
  action("voice.held")->trigger();
  microphone->setChecked(true);
  EXPECT_TRUE(text("voice.reply").contains("F9")) << text("voice.reply").toStdString();
  QKeyEvent press(QEvent::KeyPress, Qt::Key_F9, Qt::NoModifier),
      release(QEvent::KeyRelease, Qt::Key_F9, Qt::NoModifier);
  QApplication::sendEvent(window_.get(), &press);
  QApplication::sendEvent(window_.get(), &release);
  microphone->setChecked(false);
  action("voice.called")->trigger();
  auto* const word = window_->findChild<QLineEdit*>("voice.word");
  word->setText("my friend");
  emit word->editingFinished();
  word->setText("no. 5!");
  emit word->editingFinished();
  EXPECT_EQ(word->text(), "my friend");
  microphone->setChecked(true);
  EXPECT_TRUE(text("voice.reply").contains("my friend")) << text("voice.reply").toStdString();
  open_window();
  EXPECT_TRUE(action("voice.called")->isChecked());
  EXPECT_EQ(window_->findChild<QLineEdit*>("voice.word")->text(), "my friend");
}

/// Keeps what it was to play, and plays nothing.
class SilentPhones final : public speech::Loudspeaker {
 public:
  explicit SilentPhones(std::atomic<int>& played) : played_(played) {}
  void play(speech::SpokenSentence sentence) override { played_ += sentence.samples.empty() ? 0 : 1; }
  void stop() override {}
  bool is_playing() const override { return false; }

 private:
  std::atomic<int>& played_;
};

TEST_F(VoiceBarTest, RepliesAreSpokenWhereThatIsWished) {
  std::atomic<int> played = 0;
  session::Conversation conversation(
      session(), {.loudspeaker = [&](int) -> base::Result<std::unique_ptr<speech::Loudspeaker>> {
        return std::unique_ptr<speech::Loudspeaker>(std::make_unique<SilentPhones>(played));
      }});
  conversation.say("a red box");
  conversation.set_ways({.speaks = true});
  conversation.say("a blue box");
  EXPECT_TRUE(until([&] { return played == 1; }));
  conversation.set_ways({});
  conversation.say("undo");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(played, 1);
}

TEST_F(VoiceBarTest, AnotherDesignIsSpokenOfAnew) {
  type("a red box");
  session().files().make_new();
  ASSERT_TRUE(until([&] { return world().objects().empty(); }));
  type("make it blue");
  EXPECT_EQ(mood(), VoiceAgent::Mood::Puzzled);
  type("a blue box");
  EXPECT_EQ(named("box").size(), 1U);
}

TEST_F(VoiceBarTest, ListensToAPersonWhoSaysYesWhileAKeyIsHeld) {
  const auto file = places::shared_data() / "speech" / "speech_commands" / "yes_1.wav";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  session::Conversation conversation(session(), {});
  std::vector<session::Spoken> all;
  conversation.on_answer([&](const session::Spoken& spoken) { all.push_back(spoken); });
  conversation.set_ways({.attention = speech::Attention::WhileHeld});
  conversation.listen([file] { return speech::open_recording(file.string()); });
  EXPECT_TRUE(conversation.listens_while_held());
  conversation.hold(true);
  ASSERT_TRUE(until([&] {
    conversation.tick();
    return conversation.ear().doing == speech::EarState::Doing::Hearing;
  }));
  const double begun = speech::clock_of_ears();
  ASSERT_TRUE(until([&] {
    conversation.tick();
    conversation.hold(speech::clock_of_ears() < begun + 1.5);
    return !all.empty();
  })) << conversation.ear().problem;
  EXPECT_EQ(all.front().answer.heard, "yes");
}

TEST_F(VoiceBarTest, ListensToAPersonWhoSaysYes) {
  const auto file = places::shared_data() / "speech" / "speech_commands" / "yes_1.wav";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  session::Conversation conversation(session(), {});
  std::vector<session::Spoken> all;
  conversation.on_answer([&](const session::Spoken& spoken) { all.push_back(spoken); });
  conversation.listen([file] { return speech::open_recording(file.string()); });
  EXPECT_TRUE(conversation.listens());
  ASSERT_TRUE(until([&] {
    conversation.tick();
    return !all.empty();
  })) << conversation.ear().problem;
  EXPECT_EQ(all.front().answer.heard, "yes");
  EXPECT_TRUE(all.front().by_voice);
  EXPECT_LT(all.front().score, 0.0);
  conversation.listen(nullptr);
  EXPECT_FALSE(conversation.listens());
}

}  // namespace
}  // namespace icome::ui
