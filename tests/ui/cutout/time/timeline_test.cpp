#include "ui/cutout/time/timeline.h"

#include <QKeyEvent>

#include "ui/cutout/cutout_stage.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

class TimelineTest : public CutoutStage {
 protected:
  TimelineTest() {
    add_cell("boat");
    add_cell("sea", 400, 100, Qt::blue);
    set("boat", Channel::X, {{0, 640}, {10, 700}, {20, 800}});
    set("boat", Channel::Angle, {{10, 0.5}});
    document().select({});
  }

  void set(const char* name, Channel channel, const animation::Track& track) {
    ASSERT_TRUE(document().perform(
        animation::ProjectEdit{animation::ChangeKeys{cell(name).id, channel, 0, 1000, track}}));
  }
  const animation::Track& track(const char* name, Channel channel) {
    return cell(name).tracks[std::size_t(channel)];
  }
  Timeline& timeline() { return window_->timeline(); }
  QWidget& port() { return *timeline().viewport(); }
  const TimeRow& row(const char* name) {
    for (const TimeRow& row : timeline().rows())
      if (row.kind == TimeRow::Kind::Cell && row.cell == cell(name).id) return row;
    throw std::runtime_error("there is no such row");
  }
  QPointF key_place(const char* name, int frame) { return timeline().place_of(row(name), frame); }
  void key(QWidget& to, int code, const QString& text = {}) {
    QKeyEvent event(QEvent::KeyPress, code, Qt::NoModifier, text);
    QCoreApplication::sendEvent(&to, &event);
  }
};

TEST_F(TimelineTest, RowsStandFromTheFrontWithTheCameraLast) {
  std::vector<QString> names;
  for (const TimeRow& row : timeline().rows()) names.push_back(row.name);
  EXPECT_EQ(names, (std::vector<QString>{"Marks", "layer 1", "sea", "boat", "Camera"}));
  int below = 0;
  for (const TimeRow& row : timeline().rows()) {
    EXPECT_EQ(row.top, below);
    below += row.height;
    EXPECT_EQ(row_at(timeline().rows(), row.top), &row);
    EXPECT_EQ(row_at(timeline().rows(), below - 1), &row);
  }
  EXPECT_EQ(height_of(timeline().rows()), below);
}

TEST_F(TimelineTest, TheRulerScrubs) {
  drag_on(port(), timeline().ruler_place(3), timeline().ruler_place(17));
  EXPECT_EQ(document().frame(), 17);
}

TEST_F(TimelineTest, AFrameIsFoundWhereItStandsAtEachZoom) {
  for (const double factor : {0.5, 1.0, 3.0}) {
    timeline().zoom(factor);
    for (const int frame : {0, 5, 11}) {
      const QPointF at = timeline().ruler_place(frame);
      if (at.x() < 180 || at.x() > port().width()) continue;
      drag_on(port(), at, at);
      EXPECT_EQ(document().frame(), frame) << factor;
    }
  }
}

TEST_F(TimelineTest, AKeyIsDraggedWithAllChannelsOfItsFrame) {
  drag_on(port(), key_place("boat", 10), key_place("boat", 14));
  EXPECT_EQ(track("boat", Channel::X), (animation::Track{{0, 640}, {14, 700}, {20, 800}}));
  EXPECT_EQ(track("boat", Channel::Angle), (animation::Track{{14, 0.5}}));
  EXPECT_EQ(document().keys().size(), 2U);
  document().undo();
  EXPECT_EQ(track("boat", Channel::X)[1].frame, 10);
}

TEST_F(TimelineTest, KeysAreSelectedWithinAFrameAndDeleted) {
  drag_on(port(), key_place("boat", 8) - QPointF(0, 9), key_place("boat", 22) + QPointF(0, 9));
  EXPECT_EQ(document().keys().size(), 3U);
  action("key.delete")->trigger();
  EXPECT_EQ(track("boat", Channel::X), (animation::Track{{0, 640}}));
  EXPECT_TRUE(track("boat", Channel::Angle).empty());
}

TEST_F(TimelineTest, ChosenKeysGetAnEase) {
  drag_on(port(), key_place("boat", 0), key_place("boat", 0));
  action("key.ease_eased")->trigger();
  EXPECT_EQ(track("boat", Channel::X)[0].ease, animation::Ease::Eased);
  EXPECT_EQ(track("boat", Channel::X)[1].ease, animation::Ease::Straight);
}

TEST_F(TimelineTest, KeysAreCopiedAndPastedAtThePresentFrame) {
  drag_on(port(), key_place("boat", 10), key_place("boat", 10));
  action("edit.copy")->trigger();
  document().go_to(30);
  action("edit.paste")->trigger();
  ASSERT_EQ(track("boat", Channel::X).size(), 4U);
  EXPECT_EQ(track("boat", Channel::X)[3], (animation::Key{30, 700}));
  EXPECT_EQ(track("boat", Channel::Angle).size(), 2U);
}

TEST_F(TimelineTest, AClickOnTheMarkBeforeACellShowsItsChannels) {
  const std::size_t before = timeline().rows().size();
  const QPointF mark(5.0 * kGrid + 6.0, key_place("boat", 0).y());
  drag_on(port(), mark, mark);
  EXPECT_EQ(timeline().rows().size(), before + animation::kChannels);
}

TEST_F(TimelineTest, TheSheetExposesPicturesByNumber) {
  const std::string other = paper("other.png", 100, 60, Qt::green);
  document().perform(cutout_command("add-picture", {{"cell", "boat"}, {"pictures", command_texts({other})}}));
  ExposureSheet& sheet = window_->sheet();
  action("view.sheet")->trigger();
  QCoreApplication::processEvents();
  ASSERT_EQ(sheet.columns().size(), 2U);
  EXPECT_EQ(sheet.columns()[1].name, "boat");
  const QPointF box = sheet.place_of(1, 4);
  drag_on(*sheet.viewport(), box, box);
  EXPECT_EQ(document().frame(), 4);
  EXPECT_TRUE(document().is_selected(cell("boat").id));
  key(sheet, Qt::Key_2, "2");
  key(sheet, Qt::Key_Return);
  EXPECT_EQ(track("boat", Channel::Picture).size(), 1U);
  EXPECT_EQ(shown("boat").picture, 1);
  document().go_to(9);
  key(sheet, Qt::Key_0, "0");
  key(sheet, Qt::Key_Down);
  EXPECT_EQ(document().frame(), 10);
  EXPECT_EQ(shown("boat").picture, -1);
  key(sheet, Qt::Key_7, "7");  // there is none
  key(sheet, Qt::Key_Return);
  EXPECT_EQ(track("boat", Channel::Picture).size(), 2U);
}

TEST(FrameScaleTest, NumbersOfTheRulerDoNotTouch) {
  for (const double rate : {12.0, 24.0, 25.0, 30.0})
    for (double width = 1.5; width < 60.0; width *= 1.3) {
      FrameScale scale;
      scale.frame_width = width;
      const int step = scale.number_step(rate);
      EXPECT_GE(step * width, 52.0);
      EXPECT_TRUE(step % int(rate) == 0 || step < rate);
    }
}

TEST(FrameScaleTest, TheFrameUnderAPlaceStaysThereWhenZoomed) {
  FrameScale scale;
  scale.scroll = 500.0;
  const double about = 200.0;
  const double before = (about + scale.scroll) / scale.frame_width;
  scale.zoom(about, 1.7);
  EXPECT_NEAR((about + scale.scroll) / scale.frame_width, before, 1e-9);
}

TEST(SoundShapeTest, SpansHaveLeastAndGreatest) {
  SoundShape shape{.rate = 10, .least = {-0.1F, -0.5F, -0.2F}, .greatest = {0.3F, 0.1F, 0.9F}};
  EXPECT_EQ(shape.within(0.0, 0.2), std::pair(-0.5F, 0.3F));
  EXPECT_EQ(shape.within(0.21, 0.22), std::pair(-0.2F, 0.9F));
  EXPECT_EQ(shape.within(-3.0, -2.0), std::pair(0.0F, 0.0F));
  EXPECT_EQ(shape.within(5.0, 6.0), std::pair(0.0F, 0.0F));
}

}  // namespace
}  // namespace icome::ui
