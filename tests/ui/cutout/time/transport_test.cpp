#include "ui/cutout/time/transport.h"

#include <QTest>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/clock.h"
#include "ui/cutout/cutout_stage.h"

namespace icome::ui {
namespace {

/// An output that is heard in real time, and keeps what it was given.
class HeardOutput final : public SoundOutput {
 public:
  struct Heard {
    std::mutex lock;
    std::vector<std::int16_t> values;
    std::atomic<bool> is_gone = false;
  };
  HeardOutput(int rate, int channels, std::shared_ptr<Heard> heard)
      : rate_(rate), channels_(channels), heard_(std::move(heard)) {}

  int rate() const override { return rate_; }
  int channels() const override { return channels_; }
  bool write(std::span<const std::int16_t> values) override {
    if (heard_->is_gone) return false;
    const std::int64_t now = base::steady_nanoseconds();
    if (began_ == 0) began_ = now;
    {
      const std::lock_guard hold(heard_->lock);
      heard_->values.insert(heard_->values.end(), values.begin(), values.end());
    }
    written_ += double(values.size()) / channels_ / rate_;
    while (delay() > kHolds) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return true;
  }
  double delay() override {
    return began_ == 0 ? 0.0 : std::max(0.0, written_ - 1e-9 * double(base::steady_nanoseconds() - began_));
  }
  void drop() override { began_ = 0, written_ = 0.0; }

 private:
  static constexpr double kHolds = 0.08;  // s
  int rate_, channels_;
  std::shared_ptr<Heard> heard_;
  std::int64_t began_ = 0;  // ns
  double written_ = 0.0;    // s
};

class TransportTest : public CutoutStage {
 protected:
  TransportTest() {
    add_cell("boat");
    transport().use_clock([this] { return time_; });
    transport().use_outputs([this](int rate, int channels) -> base::Result<std::unique_ptr<SoundOutput>> {
      if (!has_output_) return base::fail("There is no output.");
      return std::make_unique<HeardOutput>(rate, channels, heard_);
    });
  }
  Transport& transport() { return window_->transport(); }
  void set_length(int frames, double rate = 25) {
    document().perform(cutout_command("stage", {{"length", frames}, {"rate", rate}}));
  }
  void pass(double seconds) {
    time_ += seconds;
    transport().tick();
  }

  double time_ = 100.0;  // s
  bool has_output_ = false;
  std::shared_ptr<HeardOutput::Heard> heard_ = std::make_shared<HeardOutput::Heard>();
};

TEST_F(TransportTest, FramesFollowTheClockAndLateOnesAreLeftOut) {
  set_length(50);
  transport().play();
  pass(0.0);
  EXPECT_EQ(document().frame(), 0);
  pass(0.041);
  EXPECT_EQ(document().frame(), 1);
  pass(0.2);
  EXPECT_EQ(document().frame(), 6);
  EXPECT_EQ(transport().due(), 7);
  EXPECT_EQ(transport().shown(), 3);
  pass(10.0);
  EXPECT_TRUE(transport().is_still());
  EXPECT_EQ(document().frame(), 6);
}

TEST_F(TransportTest, PlayingAgainBeginsAnew) {
  set_length(10);
  transport().play_again(true);
  transport().play();
  pass(0.41);
  EXPECT_EQ(document().frame(), 0);
  pass(0.4 * 7 + 0.04);
  EXPECT_EQ(document().frame(), 1);
  transport().stop();
  EXPECT_TRUE(transport().is_still());
}

TEST_F(TransportTest, WhatIsMovedAfterTheCountInIsRecordedAsOneStep) {
  set_length(100);
  const CellId boat = cell("boat").id;
  const auto hold_at = [&](double x) {
    animation::Hold hold{.cell = boat, .wish = document().keyed().at(boat)};
    hold.wish.place.x() = x;
    document().try_out({hold});
  };
  transport().set_count_in(4);
  transport().record(std::nullopt);
  EXPECT_EQ(transport().state(), Transport::State::CountIn);
  EXPECT_EQ(transport().beats(), 4);
  pass(1.1);
  EXPECT_EQ(transport().beats(), 2);
  EXPECT_EQ(document().frame(), 0);
  pass(0.9 + 1e-6);
  EXPECT_EQ(transport().state(), Transport::State::Recording);
  // A bent way, as a straight one is two keys.
  const auto way = [](int frame) { return 640.0 + 0.5 * frame * frame; };
  for (int frame = 0; frame <= 20; ++frame) {
    ASSERT_EQ(document().frame(), frame);
    hold_at(way(frame));
    pass(0.04);
  }
  transport().stop();
  for (int frame = 0; frame <= 20; ++frame)
    EXPECT_NEAR(animation::state_at(cell("boat"), frame).place.x(), way(frame), 0.3) << frame;
  document().undo();
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
}

/// Whatever ends the program in the middle of a recording takes no more than the last second of it.
TEST_F(TransportTest, ARecordingThatGoesOnIsOnTheDisk) {
  set_length(200);
  ASSERT_TRUE(document().save(file("r.cutout")));
  const auto on_disk = [&] {
    const auto read = animation::read_project_file(file("r.cutout"));
    EXPECT_TRUE(read && read->note.empty());
    return *read->project.find("boat");
  };
  transport().set_count_in(0);
  transport().record(std::nullopt);
  pass(0.001);
  const auto way = [](int frame) { return 640.0 + 0.5 * frame * frame; };
  for (int frame = 0; frame < 60; ++frame) {
    animation::Hold hold{.cell = cell("boat").id, .wish = shown("boat")};
    hold.wish.place.x() = way(frame);
    document().try_out({hold});
    pass(0.04);
  }
  for (int frame = 0; frame <= 50; ++frame)
    ASSERT_NEAR(animation::state_at(on_disk(), frame).place.x(), way(frame), 1e-9) << frame;
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty()) << "it goes on";
  transport().stop();
  EXPECT_EQ(on_disk(), cell("boat"));
  document().undo();
  EXPECT_EQ(on_disk(), cell("boat"));
}

TEST_F(TransportTest, OnlyTheChosenLayerIsRecorded) {
  document().perform(cutout_command("add-layer", {{"name", "front"}}));
  add_cell("bird");
  const CellId boat = cell("boat").id, bird = cell("bird").id;
  ASSERT_NE(project().layer_of(boat), project().layer_of(bird));
  document().select({bird});
  transport().set_count_in(0);
  action("frame.record_layer")->trigger();
  std::vector<animation::Hold> holds;
  for (const CellId id : {boat, bird}) {
    animation::Hold hold{.cell = id, .wish = document().keyed().at(id)};
    hold.wish.place.x() = 900;
    holds.push_back(hold);
  }
  pass(0.001);
  document().try_out(holds);
  transport().stop();
  EXPECT_TRUE(cell("boat").tracks[std::size_t(Channel::X)].empty());
  EXPECT_FALSE(cell("bird").tracks[std::size_t(Channel::X)].empty());
}

TEST_F(TransportTest, ADragGoesOnFromFrameToFrameWhileItIsRecorded) {
  set_length(100);
  transport().set_count_in(0);
  transport().record(std::nullopt);
  pass(0.001);
  send_mouse(stage(), QEvent::MouseButtonPress, on_screen({640, 360}));
  for (int frame = 0; frame <= 10; ++frame) {
    send_mouse(stage(), QEvent::MouseMove, on_screen({640.0 + 10 * (frame + 1), 360}));
    pass(0.04);
  }
  send_mouse(stage(), QEvent::MouseButtonRelease, on_screen({750, 360}));
  transport().stop();
  EXPECT_NEAR(animation::state_at(cell("boat"), 10).place.x(), 750, 1.0);
  EXPECT_NEAR(animation::state_at(cell("boat"), 5).place.x(), 700, 6.0);
}

/// Its old keys do not draw it along below the hand.
TEST_F(TransportTest, ACellThatIsHeldStillWhileItIsRecordedStays) {
  set_length(100);
  const CellId boat = cell("boat").id;
  for (const int frame : {0, 50})
    ASSERT_TRUE(document().perform(one_key(project(), boat, Channel::X, frame, 600.0 + 10 * frame)));
  transport().set_count_in(0);
  transport().record(std::nullopt);
  pass(0.001);
  for (int frame = 0; frame < 4; ++frame) pass(0.04);
  ASSERT_EQ(document().frame(), 4);
  send_mouse(stage(), QEvent::MouseButtonPress, on_screen({640, 360}));
  for (int frame = 4; frame < 10; ++frame) {
    pass(0.04);
    EXPECT_NEAR(shown("boat").place.x(), 640, 1e-6) << document().frame();
  }
  send_mouse(stage(), QEvent::MouseButtonRelease, on_screen({640, 360}));
  pass(0.04);
  transport().stop();
  for (int frame = 4; frame <= 10; ++frame)
    EXPECT_NEAR(animation::state_at(cell("boat"), frame).place.x(), 640, 0.3) << frame;
  EXPECT_NEAR(animation::state_at(cell("boat"), 2).place.x(), 620, 1e-6);
  EXPECT_NEAR(animation::state_at(cell("boat"), 12).place.x(), 720, 1e-6);
}

TEST_F(TransportTest, ACellThatIsHeldBeforeTheRecordingBeginsIsHeldFromItsFirstFrame) {
  set_length(100);
  const CellId boat = cell("boat").id;
  for (const int frame : {0, 50})
    ASSERT_TRUE(document().perform(one_key(project(), boat, Channel::X, frame, 600.0 + 10 * frame)));
  send_mouse(stage(), QEvent::MouseButtonPress, on_screen({600, 360}));
  transport().set_count_in(0);
  transport().record(std::nullopt);
  pass(0.001);
  for (int frame = 0; frame < 5; ++frame) pass(0.04);
  action("frame.stop")->trigger();
  EXPECT_TRUE(transport().is_still());
  send_mouse(stage(), QEvent::MouseButtonRelease, on_screen({600, 360}));
  for (int frame = 0; frame <= 5; ++frame)
    EXPECT_NEAR(animation::state_at(cell("boat"), frame).place.x(), 600, 0.3) << frame;
  EXPECT_NEAR(animation::state_at(cell("boat"), 7).place.x(), 670, 1e-6);
}

TEST_F(TransportTest, EscapeStopsPlayingAndRecording) {
  set_length(100);
  EXPECT_EQ(action("frame.stop")->shortcut(), QKeySequence("Esc"));
  EXPECT_FALSE(action("frame.stop")->isEnabled()) << "else Esc backs out";
  const auto stops = [&] {
    pass(0.05);
    QTest::keyClick(&stage(), Qt::Key_Escape);
    return transport().is_still();
  };
  document().select({cell("boat").id});
  transport().play();
  EXPECT_TRUE(stops());
  transport().set_count_in(4);
  transport().record(std::nullopt);
  EXPECT_TRUE(stops());
  EXPECT_FALSE(document().is_recording());
  EXPECT_FALSE(document().selection().empty()) << "nothing else was backed out of";
}

TEST_F(TransportTest, ThePictureFollowsWhatIsHeard) {
  set_length(50);
  transport().use_clock([] { return 1e-9 * double(base::steady_nanoseconds()); });
  has_output_ = true;
  sound::Samples samples{.rate = 8000, .channels = 1, .values = {}};
  for (int i = 0; i < 16000; ++i) samples.values.push_back(float(std::sin(0.05 * i)));
  ASSERT_TRUE(
      document().perform(animation::ProjectEdit{animation::ChangeSound{animation::Sound{.file = "a.wav"}}}));
  transport().use_samples(std::make_shared<const sound::Samples>(samples));
  transport().play();
  // The window is busy for a while: pictures are left out, and the sound goes on.
  ASSERT_TRUE(until([&] { return document().frame() >= 5; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  ASSERT_TRUE(until([&] { return document().frame() >= 20; }));
  transport().stop();
  EXPECT_GT(transport().due(), transport().shown());
  const std::lock_guard hold(heard_->lock);
  ASSERT_GT(heard_->values.size(), 5000U);
  for (std::size_t i = 0; i < 5000; ++i)
    ASSERT_NEAR(heard_->values[i], 32767.0 * samples.values[i], 1.0) << i;
}

TEST_F(TransportTest, AnOutputThatGoesAwayDoesNotStopTheFilm) {
  set_length(200);
  transport().use_clock([] { return 1e-9 * double(base::steady_nanoseconds()); });
  has_output_ = true;
  document().perform(animation::ProjectEdit{animation::ChangeSound{animation::Sound{.file = "a.wav"}}});
  transport().use_samples(std::make_shared<const sound::Samples>(
      sound::Samples{.rate = 8000, .channels = 1, .values = std::vector<float>(80000)}));
  transport().play();
  ASSERT_TRUE(until([&] { return document().frame() >= 3; }));
  heard_->is_gone = true;
  EXPECT_TRUE(until([&] { return document().frame() >= 40; }));
  transport().stop();
}

TEST(Click, IsHeardAndEndsWithoutAStep) {
  double loudest = 0;
  for (int i = 0; i < 4800; ++i) loudest = std::max(loudest, double(std::abs(click_at(i / 48000.0, true))));
  EXPECT_GT(loudest, 0.2);
  EXPECT_LT(std::abs(click_at(0.0, false)), 0.01);
  EXPECT_LT(std::abs(click_at(0.0499, false)), 0.05);
  EXPECT_EQ(click_at(0.06, false), 0.0F);
}

}  // namespace
}  // namespace icome::ui
