#include "ui/forms/colour_button.h"

#include <QColorDialog>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "ui/look/theme.h"

namespace icome::ui {

ColourButton::ColourButton(const QString& what, QWidget* parent) : QAbstractButton(parent), what_(what) {
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_Hover);
  setAccessibleName(what);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(this, &QAbstractButton::clicked, this, [this] { open_dialog(); });
}

QSize ColourButton::sizeHint() const {
  return {16 * kGrid, std::max(6 * kGrid, fontMetrics().height() + 2 * kGrid)};
}

void ColourButton::show_colour(std::optional<world::Colour> colour) {
  colour_ = colour;
  const QString words = colour ? screen_colour(*colour).name() : none_;
  setToolTip(words);
  setAccessibleDescription(words);
  update();
}

void ColourButton::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColours& theme = colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool marked = hasFocus() || underMouse();
  const double width = hasFocus() ? 1.5 : 1.0;
  QPainterPath swatch;
  swatch.addRoundedRect(QRectF(rect()).adjusted(width / 2, width / 2, -width / 2, -width / 2), kGrid, kGrid);
  painter.fillPath(swatch, colour_ ? screen_colour(*colour_) : theme.base);
  if (!colour_) {
    painter.setPen(theme.faint);
    painter.drawText(rect(), Qt::AlignCenter, none_);
  }
  painter.setPen(QPen(hasFocus() ? theme.accent : marked ? theme.faint : theme.line, width));
  painter.drawPath(swatch);
}

void ColourButton::open_dialog() {
  const QColor before = colour_ ? screen_colour(*colour_) : QColor(Qt::white);
  const QColor chosen = QColorDialog::getColor(before, this, what_);
  if (!chosen.isValid() || (colour_ && chosen == before) || !choose_) return;
  choose_(world_colour(chosen));
}

QColor screen_colour(const world::Colour& colour) {
  const auto channel = [](float part) { return std::clamp(part, 0.0F, 1.0F); };
  return QColor::fromRgbF(channel(colour[0]), channel(colour[1]), channel(colour[2]));
}

world::Colour world_colour(const QColor& colour) {
  return {float(colour.redF()), float(colour.greenF()), float(colour.blueF())};
}

}  // namespace icome::ui
