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

/// The colours of a theme, for painting beside the palette. Text colours reach WCAG AA (4.5:1) on every
/// background that they are used on; marks and lines with a meaning reach 3:1.
struct ThemeColours {
  QColor window;                             // background of panels and bars
  QColor base;                               // of trees, fields and plots
  QColor raised;                             // of buttons
  QColor hover;                              // of anything under the mouse
  QColor line;                               // borders
  QColor grid;                               // lines of plots
  QColor text;                               // on all of these
  QColor faint;                              // less important text, on all of these
  QColor accent;                             // the selection's orange: marks, focus, switches that are on
  QColor accent_text;                        // words in the accent's colour, on window and base
  QColor selection;                          // background of selected rows and text
  QColor selection_text;                     // text on it
  QColor good, warning, bad;                 // marks
  QColor warning_text, bad_text, link_text;  // words, on window and base
};
const ThemeColours& colours_of_dark();
const ThemeColours& colours_of_light();

/// Colours of the theme that was applied last, and whether that is dark; before, the light theme's.
const ThemeColours& colours();
bool is_dark();

/// Applies the theme: style, palette and font. It may be called again at any time; widgets then get
/// QEvent::PaletteChange. System asks the desktop's colour scheme (XDG portal), else the platform's palette.
void apply_theme(QApplication& application, Theme theme);

/// Colours for the scene that suit the theme: the background at the top and at the bottom, the outline of
/// selected objects, and the lines of the ground's grid.
struct SceneColours {
  charts::Colour above, below, selection, grid, workspace;
};
SceneColours scene_colours();

/// Contrast of two colours: the ratio of WCAG 2.1, 1 to 21.
double contrast(const QColor& one, const QColor& other);

/// Unit of the grid that all distances on panels follow, in device-independent pixels.
inline constexpr int kGrid = 4;

}  // namespace icome::ui
