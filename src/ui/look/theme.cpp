#include "ui/look/theme.h"

#include <unistd.h>

#include <QDBusConnection>
#include <QDBusInterface>
#include <QDBusReply>
#include <QDBusVariant>
#include <QFile>
#include <QFontDatabase>
#include <QPalette>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "ui/look/style.h"

namespace icome::ui {
namespace {

const ThemeColours* applied = &colours_of_light();

/// Is there a session bus? Asking without one would start a program to make one.
bool has_session_bus() {
  return qEnvironmentVariableIsSet("DBUS_SESSION_BUS_ADDRESS") ||
         QFile::exists(QString("/run/user/%1/bus").arg(getuid()));
}

/// Does the desktop prefer dark colours? Nothing where it has no preference.
std::optional<bool> desktop_prefers_dark() {
  if (!has_session_bus()) return std::nullopt;
  QDBusInterface portal("org.freedesktop.portal.Desktop", "/org/freedesktop/portal/desktop",
                        "org.freedesktop.portal.Settings", QDBusConnection::sessionBus());
  if (!portal.isValid()) return std::nullopt;
  portal.setTimeout(250);  // ms: a window that comes late is worse than one of the other theme
  const QDBusReply<QVariant> reply = portal.call("Read", "org.freedesktop.appearance", "color-scheme");
  if (!reply.isValid()) return std::nullopt;
  QVariant value = reply.value();
  while (value.canConvert<QDBusVariant>()) value = value.value<QDBusVariant>().variant();
  const uint scheme = value.toUInt();  // 0 no preference, 1 dark, 2 light
  if (scheme == 1) return true;
  if (scheme == 2) return false;
  return std::nullopt;
}

bool palette_is_dark(const QPalette& palette) {
  return palette.color(QPalette::WindowText).lightness() > palette.color(QPalette::Window).lightness();
}

/// The platform's palette, as it was before a theme was applied.
const QPalette& platform_palette() {
  static const QPalette kPalette = QApplication::palette();
  return kPalette;
}

bool wants_dark(Theme theme) {
  if (theme != Theme::System) return theme == Theme::Dark;
  return desktop_prefers_dark().value_or(palette_is_dark(platform_palette()));
}

QColor mixed(const QColor& one, const QColor& other, double share) {
  const auto channel = [&](int a, int b) { return int(std::lround(a + (b - a) * share)); };
  return {channel(one.red(), other.red()), channel(one.green(), other.green()),
          channel(one.blue(), other.blue())};
}

QPalette palette_of(const ThemeColours& it) {
  QPalette palette(it.text, it.raised, it.line.lighter(130), it.line.darker(140), it.line, it.text, it.text,
                   it.base, it.window);
  palette.setColor(QPalette::AlternateBase, mixed(it.base, it.window, 0.5));
  palette.setColor(QPalette::Highlight, it.selection);
  palette.setColor(QPalette::HighlightedText, it.selection_text);
  palette.setColor(QPalette::PlaceholderText, it.faint);
  palette.setColor(QPalette::ToolTipBase, it.base);
  palette.setColor(QPalette::ToolTipText, it.text);
  palette.setColor(QPalette::Link, it.link_text);
  palette.setColor(QPalette::LinkVisited, it.link_text);
  palette.setColor(QPalette::Shadow, mixed(it.window, Qt::black, 0.6));
  const QColor resting = mixed(it.window, it.text, 0.45);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, resting);
  palette.setColor(QPalette::Disabled, QPalette::Base, it.window);
  return palette;
}

/// The system's font, 9 to 10 points high.
QFont panel_font() {
  static const QFont kSystem = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
  QFont font = kSystem;
  const double size = font.pointSizeF();
  font.setPointSizeF(size > 0.0 ? std::clamp(size, 9.0, 10.0) : 9.5);
  return font;
}

/// Relative luminance of a colour (WCAG 2.1).
double luminance(const QColor& colour) {
  return 0.2126 * base::linear_from_srgb(colour.redF()) + 0.7152 * base::linear_from_srgb(colour.greenF()) +
         0.0722 * base::linear_from_srgb(colour.blueF());
}

}  // namespace

std::optional<Theme> theme_of(std::string_view name) {
  for (const Theme theme : {Theme::System, Theme::Dark, Theme::Light}) {
    if (ui::name(theme) == name) return theme;
  }
  return std::nullopt;
}

std::string_view name(Theme theme) {
  switch (theme) {
    case Theme::System:
      return "system";
    case Theme::Dark:
      return "dark";
    case Theme::Light:
      break;
  }
  return "light";
}

const ThemeColours& colours_of_dark() {
  static const ThemeColours kColours{
      .window = QColor(0x25, 0x28, 0x2d),
      .base = QColor(0x1c, 0x1f, 0x23),
      .raised = QColor(0x33, 0x38, 0x3f),
      .hover = QColor(0x3d, 0x43, 0x4b),
      .line = QColor(0x41, 0x47, 0x50),
      .grid = QColor(0x33, 0x38, 0x3f),
      .text = QColor(0xe8, 0xea, 0xed),
      .faint = QColor(0xb0, 0xb7, 0xc0),
      .accent = QColor(0xff, 0x96, 0x2b),
      .accent_text = QColor(0xff, 0xab, 0x55),
      .selection = QColor(0x6b, 0x43, 0x15),
      .selection_text = QColor(0xff, 0xff, 0xff),
      .good = QColor(0x53, 0xc2, 0x77),
      .warning = QColor(0xf2, 0xc1, 0x4b),
      .bad = QColor(0xff, 0x6b, 0x61),
      .warning_text = QColor(0xf2, 0xc1, 0x4b),
      .bad_text = QColor(0xff, 0x8d, 0x85),
      .link_text = QColor(0xff, 0xab, 0x55),
  };
  return kColours;
}

const ThemeColours& colours_of_light() {
  static const ThemeColours kColours{
      .window = QColor(0xf1, 0xf2, 0xf4),
      .base = QColor(0xff, 0xff, 0xff),
      .raised = QColor(0xfd, 0xfd, 0xfe),
      .hover = QColor(0xe3, 0xe6, 0xea),
      .line = QColor(0xc6, 0xcb, 0xd2),
      .grid = QColor(0xe1, 0xe4, 0xe8),
      .text = QColor(0x1c, 0x20, 0x25),
      .faint = QColor(0x55, 0x5d, 0x68),
      .accent = QColor(0xd9, 0x6a, 0x00),
      .accent_text = QColor(0x94, 0x48, 0x00),
      .selection = QColor(0xff, 0xd8, 0xa8),
      .selection_text = QColor(0x1c, 0x20, 0x25),
      .good = QColor(0x1e, 0x8a, 0x46),
      .warning = QColor(0xb0, 0x78, 0x00),
      .bad = QColor(0xd1, 0x2f, 0x2a),
      .warning_text = QColor(0x7d, 0x55, 0x00),
      .bad_text = QColor(0xb3, 0x22, 0x1e),
      .link_text = QColor(0x94, 0x48, 0x00),
  };
  return kColours;
}

const ThemeColours& colours() { return *applied; }

bool is_dark() { return applied == &colours_of_dark(); }

void apply_theme(QApplication& /*the one there is*/, Theme theme) {
  platform_palette();
  applied = wants_dark(theme) ? &colours_of_dark() : &colours_of_light();
  static bool dressed = false;
  if (!dressed) QApplication::setStyle(new DesktopStyle);  // the application owns it
  dressed = true;
  QApplication::setFont(panel_font());
  QApplication::setPalette(palette_of(*applied));
  QToolTip::setPalette(palette_of(*applied));
}

SceneColours scene_colours() {
  if (is_dark())
    return {{0.140, 0.155, 0.175},
            {0.300, 0.320, 0.345},
            {1.0, 0.55, 0.10},
            {0.62, 0.66, 0.72, 0.35},
            {0.45, 0.70, 1.0, 0.6}};
  return {{0.80, 0.84, 0.88},
          {0.96, 0.96, 0.95},
          {1.0, 0.55, 0.10},
          {0.35, 0.39, 0.45, 0.35},
          {0.10, 0.35, 0.80, 0.6}};
}

double contrast(const QColor& one, const QColor& other) {
  const auto [darker, lighter] = std::minmax({luminance(one), luminance(other)});
  return (lighter + 0.05) / (darker + 0.05);
}

}  // namespace icome::ui
