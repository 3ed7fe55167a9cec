#include "ui/plots/plot_panel.h"

#include <QPainter>
#include <QPainterPath>

#include "ui/look/theme.h"

namespace icome::ui {

PlotPanel::PlotPanel(const QString& caption, QWidget* parent) : QWidget(parent), caption_(caption) {
  setAccessibleName(caption);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

QSize PlotPanel::sizeHint() const { return {80 * kGrid, fontMetrics().height() + 16 * kGrid}; }

QSize PlotPanel::minimumSizeHint() const { return {40 * kGrid, fontMetrics().height() + 9 * kGrid}; }

void PlotPanel::set_figures(const QString& figures) {
  if (figures_ != figures) setAccessibleDescription(figures);
  figures_ = figures;
}

QFont PlotPanel::small(const QFont& font) {
  QFont letters = font;
  letters.setPointSizeF(std::max(7.0, font.pointSizeF() * 0.8));
  return letters;
}

void PlotPanel::paintEvent(QPaintEvent* /*event*/) {
  const ThemeColours& theme = colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const int line = fontMetrics().height();
  const QRectF top(0.0, 0.0, width(), line);
  painter.setPen(theme.faint);
  painter.drawText(top, Qt::AlignLeft | Qt::AlignVCenter, caption_);
  const double taken = fontMetrics().horizontalAdvance(caption_) + 2.0 * kGrid;
  painter.setPen(theme.text);
  const QString figures = fontMetrics().elidedText(figures_, Qt::ElideLeft, int(width() - taken));
  painter.drawText(top.adjusted(taken, 0.0, 0.0, 0.0), Qt::AlignRight | Qt::AlignVCenter, figures);

  const QRectF area(0.5, line + kGrid + 0.5, width() - 1.0, height() - line - kGrid - 1.0);
  QPainterPath frame;
  frame.addRoundedRect(area, kGrid, kGrid);
  painter.fillPath(frame, theme.base);
  painter.save();
  painter.setClipPath(frame);
  paint_plot(painter, area);
  painter.restore();
  painter.setPen(QPen(theme.line, 1.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(frame);
}

}  // namespace icome::ui
