#pragma once
#include <QApplication>
#include <QColor>
#include <optional>
#include <string_view>

#include "charts/colour.h"

namespace icome::ui {

enum class Theme : std::uint8_t { System, Dark, Light };

/// "system", "dark" or "light", as on the command line and in settings.
std::optional<Theme> theme_of(std::string_view name);
std::string_view name(Theme theme);

/// What the desktop's own painting uses beside the palette. Text colours reach WCAG AA (4.5:1) on every
/// ground that they stand on, marks and lines of meaning 3:1.
struct ThemeColours {
  QColor window;                             // ground of panels and bars
  QColor base;                               // of trees, fields and plots
  QColor raised;                             // of buttons
  QColor hover;                              // of what the mouse is over
  QColor line;                               // borders
  QColor grid;                               // lines of plots
  QColor text;                               // on all of these
  QColor faint;                              // less important text, on all of these
  QColor accent;                             // the selection's orange: marks, focus, what is switched on
  QColor accent_text;                        // words in the accent's colour, on window and base
  QColor selection;                          // ground of selected rows and text
  QColor selection_text;                     // on it
  QColor good, warning, bad;                 // marks
  QColor warning_text, bad_text, link_text;  // words, on window and base
};
const ThemeColours& colours_of_dark();
const ThemeColours& colours_of_light();

/// Of the theme that was applied last; light before.
const ThemeColours& colours();
bool is_dark();

/// Puts the theme on: style, palette, font. It may be called again at any time; widgets hear of it by
/// QEvent::PaletteChange. System asks the desktop's colour scheme (XDG portal), else the platform's palette.
void apply_theme(QApplication& application, Theme theme);

/// Colours for the scene that suit the theme: the background at the top and at the bottom, the line around
/// what is selected, and the lines of the ground's grid.
struct SceneColours {
  charts::Colour above, below, selection, grid;
};
SceneColours scene_colours();

/// How well one colour can be told from another: the ratio of WCAG 2.1, 1 to 21.
double contrast(const QColor& one, const QColor& other);

/// The grid that all distances between things on panels follow, in device-independent pixels.
inline constexpr int kGrid = 4;

}  // namespace icome::ui
