#include "ui/plots/load_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

/// Colour of a bar by its load: all is well, little room is left, or ticks come too late.
const QColor& bar_colour(std::size_t bin) {
  constexpr std::size_t kLittleRoom = 70, kTooMuch = 95;
  if (bin >= kTooMuch) return colours().bad;
  return bin >= kLittleRoom ? colours().warning : colours().accent;
}

QString percent(double load) {
  return load >= 100.0 ? QString("over 100 %") : QString("%1 %").arg(load, 0, 'f', 0);
}

}  // namespace

LoadPlot::LoadPlot(QWidget* parent) : PlotPanel("Haptic load", parent) {
  setToolTip(
      "Haptic load: the share of its time that the servo needs to feel the world, tick by tick, over "
      "the last ten seconds. Bars count ticks (logarithmic). Up to 70 % there is room to spare; at 100 % "
      "a tick takes as long as there is, and forces come late.\n"
      "Median: half of the ticks need no more. p99.9: all but one in a thousand need no more.");
}

void LoadPlot::show(const LoadWindow& window) {
  const auto median = window.quantile(0.5), p999 = window.quantile(0.999);
  if (window.recent() == counts_ && median == median_) return;
  counts_ = window.recent();
  median_ = median;
  p999_ = p999;
  set_figures(median ? QString("median %1   p99.9 %2").arg(percent(*median), percent(*p999))
                     : QString("no ticks"));
  update();
}

void LoadPlot::paint_plot(QPainter& painter, const QRectF& area) {
  const ThemeColours& theme = colours();
  const double bins = double(counts_.size());
  painter.setFont(small(font()));
  const double letters = painter.fontMetrics().height();
  const double foot = area.bottom() - letters;
  const auto x = [&](double load) { return area.left() + area.width() * load / bins; };
  for (const int mark : {25, 50, 75, 100}) {
    painter.setPen(QPen(theme.grid, 1.0));
    painter.drawLine(QPointF(x(mark), area.top()), QPointF(x(mark), foot));
    painter.setPen(theme.faint);
    const QRectF place(x(mark) - 40.0, foot, 38.0 + (mark == 100 ? 0.0 : 22.0), letters);
    painter.drawText(place, (mark == 100 ? Qt::AlignRight : Qt::AlignHCenter) | Qt::AlignVCenter,
                     QString::number(mark) + (mark == 100 ? " %" : ""));
  }
  const double highest = std::log1p(double(*std::max_element(counts_.begin(), counts_.end())));
  const double room = foot - area.top() - kGrid;
  painter.setPen(Qt::NoPen);
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    const double height = std::max(1.5, room * std::log1p(double(counts_[i])) / highest);
    painter.setBrush(bar_colour(i));
    painter.drawRect(QRectF(x(double(i)) + 0.25, foot - height, area.width() / bins - 0.5, height));
  }
  painter.setPen(QPen(theme.line, 1.0));
  painter.drawLine(QPointF(area.left(), foot), QPointF(area.right(), foot));
  if (!p999_) return;
  painter.setPen(QPen(theme.text, 1.0, Qt::DashLine));
  painter.drawLine(QPointF(x(*p999_ + 0.5), area.top()), QPointF(x(*p999_ + 0.5), foot));
}

}  // namespace icome::ui
