#pragma once
#include <deque>
#include <vector>

#include "session/hands/pointer_view.h"
#include "ui/plots/plot_panel.h"

namespace icome::ui {

/// The force on the hand over the last seconds; where something is touched, the ground is shaded.
class ForcePlot final : public PlotPanel {
 public:
  explicit ForcePlot(QWidget* parent);

  /// `now` in ns on the steady clock; `reach` in N: what the device can do, which is always in sight; 0 for
  /// one without force.
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
