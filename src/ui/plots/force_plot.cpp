#include "ui/plots/force_plot.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr std::int64_t kSpan = 5'000'000'000;                // ns that are shown
constexpr std::int64_t kGap = 250'000'000;                   // ns: samples further apart are not joined
constexpr std::size_t kMostSamples = std::size_t(1) << 15U;  // however many the session gives

/// The least of 1, 2 and 5 times a power of ten that is not below `force`.
double nice_above(double force) {
  const double power = std::pow(10.0, std::floor(std::log10(force)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (force <= step * power) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

ForcePlot::ForcePlot(QWidget* parent) : PlotPanel("Force", parent) {
  setToolTip(
      "The force on the hand (N) over the last five seconds. Shaded: something is touched. The dashed "
      "line is what the device can do at most.");
}

void ForcePlot::add(const std::vector<session::ForceSample>& samples, std::int64_t now, double reach) {
  const bool still = samples.empty() && samples_.empty() && reach == reach_;
  for (const session::ForceSample& sample : samples) {
    if (std::isfinite(sample.force)) samples_.push_back(sample);
  }
  while (!samples_.empty() && (samples_.front().time < now - kSpan || samples_.size() > kMostSamples))
    samples_.pop_front();
  now_ = now;
  reach_ = reach;
  const bool fresh = !samples_.empty() && samples_.back().time > now - kGap;
  set_figures(!fresh ? QString("–")
                     : QString("%1 N%2")
                           .arg(double(samples_.back().force), 0, 'f', 2)
                           .arg(samples_.back().touching ? "   touching" : ""));
  if (!still) update();
}

double ForcePlot::top() const {
  double highest = reach_;
  for (const session::ForceSample& sample : samples_) highest = std::max(highest, double(sample.force));
  return highest > 0.0 ? nice_above(highest * 1.02) : 1.0;
}

double ForcePlot::x_of(std::int64_t time, const QRectF& area) const {
  return area.right() - area.width() * double(now_ - time) / double(kSpan);
}

void ForcePlot::paint_plot(QPainter& painter, const QRectF& area) {
  paint_touches(painter, area);
  paint_scale(painter, area);
  paint_curve(painter, area.adjusted(0.0, 0.0, 0.0, -1.0));
}

void ForcePlot::paint_touches(QPainter& painter, const QRectF& area) const {
  QColor shade = colours().accent;
  shade.setAlphaF(0.16F);
  for (std::size_t i = 0; i < samples_.size();) {
    std::size_t end = i;
    while (end < samples_.size() && samples_[end].touching) ++end;
    if (end > i) {
      const double left = x_of(samples_[i].time, area), right = x_of(samples_[end - 1].time, area);
      painter.fillRect(QRectF(left, area.top(), std::max(1.0, right - left), area.height()), shade);
    }
    i = end + 1;
  }
}

void ForcePlot::paint_scale(QPainter& painter, const QRectF& area) const {
  const ThemeColours& theme = colours();
  painter.setPen(QPen(theme.grid, 1.0));
  for (int second = 1; second < 5; ++second) {
    const double x = area.right() - area.width() * second / 5.0;
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  }
  if (reach_ > 0.0) {
    const double y = area.bottom() - area.height() * reach_ / top();
    painter.setPen(QPen(theme.faint, 1.0, Qt::DashLine));
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  }
  painter.setFont(small(font()));
  painter.setPen(theme.faint);
  const QRectF words = area.adjusted(kGrid, 1.0, -kGrid, -1.0);
  painter.drawText(words, Qt::AlignLeft | Qt::AlignTop, QString("%1 N").arg(top()));
  painter.drawText(words, Qt::AlignLeft | Qt::AlignBottom, "5 s ago");
}

/// The largest of several samples within a pixel is drawn: a knock of a few milliseconds must show.
void ForcePlot::paint_curve(QPainter& painter, const QRectF& area) const {
  const double pixel = 1.0 / std::max(1.0, painter.device()->devicePixelRatioF());
  const double scale = area.height() / top();
  QPainterPath curve;
  std::int64_t last = 0;
  for (std::size_t i = 0; i < samples_.size();) {
    const double x = x_of(samples_[i].time, area);
    double force = 0.0;
    const std::int64_t time = samples_[i].time;
    for (; i < samples_.size() && x_of(samples_[i].time, area) <= x + pixel; ++i)
      force = std::max(force, double(samples_[i].force));
    const QPointF point(x, area.bottom() - scale * force);
    curve.elementCount() == 0 || time - last > kGap ? curve.moveTo(point) : curve.lineTo(point);
    last = time;
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colours().accent, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(curve);
}

}  // namespace icome::ui
