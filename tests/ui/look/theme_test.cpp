#include "ui/look/theme.h"

#include <QPalette>
#include <set>

#include "ui/desktop_test.h"
#include "ui/look/icons.h"

namespace icome::ui {
namespace {

TEST(Theme, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(Qt::black, Qt::white), 21.0, 1e-9);
  EXPECT_NEAR(contrast(QColor(0x77, 0x77, 0x77), Qt::white), 4.48,
              0.005);  // the usual example of a near miss
  EXPECT_DOUBLE_EQ(contrast(Qt::red, Qt::red), 1.0);
}

TEST(Theme, WordsAreReadableInBoth) {
  for (const ThemeColours& theme : {colours_of_dark(), colours_of_light()}) {
    for (const QColor& ground : {theme.window, theme.base, theme.raised, theme.hover}) {
      EXPECT_GE(contrast(theme.text, ground), 7.0) << ground.name().toStdString();
      EXPECT_GE(contrast(theme.faint, ground), 4.5) << ground.name().toStdString();
    }
    for (const QColor& words : {theme.accent_text, theme.warning_text, theme.bad_text, theme.link_text}) {
      EXPECT_GE(contrast(words, theme.window), 4.5) << words.name().toStdString();
      EXPECT_GE(contrast(words, theme.base), 4.5) << words.name().toStdString();
    }
    EXPECT_GE(contrast(theme.selection_text, theme.selection), 4.5);
    for (const QColor& mark : {theme.accent, theme.good, theme.warning, theme.bad}) {
      EXPECT_GE(contrast(mark, theme.window), 3.0) << mark.name().toStdString();
      EXPECT_GE(contrast(mark, theme.base), 3.0) << mark.name().toStdString();
    }
  }
}

TEST(Theme, ChangesWhileTheProgramRuns) {
  QApplication& it = application();
  apply_theme(it, Theme::Dark);
  EXPECT_TRUE(is_dark());
  EXPECT_EQ(QApplication::palette().color(QPalette::Window), colours_of_dark().window);
  apply_theme(it, Theme::Light);
  EXPECT_FALSE(is_dark());
  EXPECT_EQ(QApplication::palette().color(QPalette::Base), colours_of_light().base);
  EXPECT_GE(QApplication::font().pointSizeF(), 9.0);
  EXPECT_LE(QApplication::font().pointSizeF(), 10.0);
}

TEST(Theme, IsKnownByName) {
  for (const Theme theme : {Theme::System, Theme::Dark, Theme::Light})
    EXPECT_EQ(theme_of(name(theme)), theme);
  EXPECT_FALSE(theme_of("purple"));
}

TEST(Icons, AreAllDifferentAndFollowTheTheme) {
  apply_theme(application(), Theme::Light);
  std::set<QByteArray> pictures;
  const QIcon kept = icon(Icon::Box);
  const QImage light = kept.pixmap(QSize(20, 20), 1.0).toImage();
  for (int i = 0; i < int(Icon::Count); ++i) {
    const QImage image = icon(Icon(i)).pixmap(QSize(20, 20), 2.0).toImage();
    EXPECT_EQ(image.size(), QSize(40, 40));  // drawn for the screen's own pixels
    pictures.insert(QByteArray(reinterpret_cast<const char*>(image.constBits()), image.sizeInBytes()));
  }
  EXPECT_EQ(pictures.size(), std::size_t(Icon::Count));
  apply_theme(application(), Theme::Dark);
  EXPECT_NE(kept.pixmap(QSize(20, 20), 1.0).toImage(), light);
}

}  // namespace
}  // namespace icome::ui
