#pragma once
#include <deque>
#include <vector>

#include "session/hands/pointer_view.h"
#include "ui/plots/plot_panel.h"

namespace icome::ui {

/// A plot of the force on the hand over the last seconds; shaded while something is touched.
class ForcePlot final : public PlotPanel {
 public:
  explicit ForcePlot(QWidget* parent);

  /// Adds samples. `now` in ns on the steady clock; `reach` in N is the most that the device can do, and is
  /// always in sight; 0 for a device without force.
  void add(const std::vector<session::ForceSample>& samples, std::int64_t now, double reach);

 protected:
  void paint_plot(QPainter& painter, const QRectF& area) override;

 private:
  double top() const;
  void paint_touches(QPainter& painter, const QRectF& area) const;
  void paint_scale(QPainter& painter, const QRectF& area) const;
  void paint_curve(QPainter& painter, const QRectF& area) const;
  double x_of(std::int64_t time, const QRectF& area) const;

  std::deque<session::ForceSample> samples_;
  std::int64_t now_ = 0;  // ns
  double reach_ = 0.0;    // N
};

}  // namespace icome::ui
