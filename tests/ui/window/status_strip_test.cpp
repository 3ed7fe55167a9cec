#include "ui/window/status_strip.h"

#include <QAction>
#include <QLabel>
#include <QTest>
#include <QTimer>

#include "ui/desktop_test.h"
#include "ui/look/theme.h"
#include "ui/plots/force_plot.h"
#include "ui/window/about_box.h"
#include "ui/window/shortcut_sheet.h"

namespace icome::ui {
namespace {

class StatusStripTest : public DesktopTest {};

TEST_F(StatusStripTest, WorksOnlyWhileItIsSeen) {
  StatusStrip strip(session(), nullptr);
  strip.setAttribute(Qt::WA_DontShowOnScreen);
  const QTimer* timer = strip.findChild<QTimer*>();
  EXPECT_FALSE(timer->isActive());
  strip.show();
  EXPECT_TRUE(timer->isActive());
  for (const char* name : {"Pointer device", "Servo rate", "Overruns", "Lateness"}) {
    bool found = false;
    for (const QLabel* label : strip.findChildren<QLabel*>())
      found = found || (label->accessibleName() == name && !label->text().isEmpty());
    EXPECT_TRUE(found) << name;
  }
  strip.hide();
  EXPECT_FALSE(timer->isActive());
}

TEST_F(StatusStripTest, TellsOfEffectsThatAreFeltSofterThanAskedFor) {
  StatusStrip strip(session(), nullptr);
  strip.setAttribute(Qt::WA_DontShowOnScreen);
  strip.show();
  const QLabel* told = nullptr;
  for (const QLabel* label : strip.findChildren<QLabel*>())
    if (label->accessibleName() == "Effects that are felt softer than asked for") told = label;
  ASSERT_NE(told, nullptr);
  EXPECT_FALSE(told->isVisibleTo(&strip));
  world::PhysicalObject object{.name = "honey"};
  object.fixture = std::make_shared<const world::Fixture>(world::ForceEffect{"viscous:500", true});
  perform(world::CreateObject{session().ids().next<world::ObjectId>(), 0, object});
  ASSERT_TRUE(QTest::qWaitFor([&] {
    session().update();
    return told->isVisibleTo(&strip);
  }));
  EXPECT_EQ(told->text(), "1 effect felt softly");
  EXPECT_TRUE(told->toolTip().contains("honey: damping 500 N s/m is felt as"))
      << told->toolTip().toStdString();
}

/// How many pixels have about this colour.
int count(const QImage& image, const QColor& colour) {
  int pixels = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor at = image.pixelColor(x, y);
      pixels += std::abs(at.red() - colour.red()) + std::abs(at.green() - colour.green()) +
                            std::abs(at.blue() - colour.blue()) <
                        12
                    ? 1
                    : 0;
    }
  }
  return pixels;
}

TEST(ForcePlot, ShadesWhereSomethingWasTouchedAndTakesNoNonsense) {
  apply_theme(application(), Theme::Dark);
  ForcePlot plot(nullptr);
  plot.resize(300, 90);
  const std::int64_t now = 10'000'000'000;
  const QImage empty = plot.grab().toImage();
  std::vector<session::ForceSample> samples;
  for (int i = 0; i < 1000; ++i)
    samples.push_back({now - (1000 - i) * 5'000'000LL, i < 500 ? 0.0F : 2.0F, i >= 500});
  samples.push_back({now, std::nanf(""), true});
  plot.add(samples, now, 3.3);
  const QImage drawn = plot.grab().toImage();
  EXPECT_EQ(plot.accessibleDescription(), "2.00 N   touching");
  const QColor base = colours().base;
  const QImage left = drawn.copy(10, 40, 130, 30), right = drawn.copy(160, 60, 130, 20);
  EXPECT_GT(count(left, base), 130 * 30 * 8 / 10);
  EXPECT_LT(count(right, base), 130 * 20 / 10);  // shaded
  plot.add({}, now + 60'000'000'000, 3.3);
  EXPECT_EQ(plot.accessibleDescription(), "–");
  EXPECT_EQ(count(empty, colours().accent), 0);
}

TEST(ShortcutSheet, ListsActionsThatHaveKeys) {
  application();
  QAction save("&Save && close…"), plain("Plain");
  save.setShortcuts({QKeySequence("Ctrl+S"), QKeySequence("F2")});
  const ShortcutSheet::Part part = ShortcutSheet::of_actions("File", {&save, &plain});
  ASSERT_EQ(part.rows.size(), 1U);
  EXPECT_EQ(part.rows[0].first, "Save & close");
  EXPECT_EQ(part.rows[0].second, "Ctrl+S  or  F2");
}

TEST(AboutBox, ShowsTheRendererAsPlainText) {
  application();
  const AboutBox box("<b>llvmpipe</b>", nullptr);
  bool found = false;
  for (const QLabel* label : box.findChildren<QLabel*>())
    found = found || label->text().contains("&lt;b&gt;llvmpipe");
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace icome::ui
