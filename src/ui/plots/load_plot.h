#pragma once
#include "ui/plots/load_window.h"
#include "ui/plots/plot_panel.h"

namespace icome::ui {

/// A plot of the haptic load, the share of its time that the servo needs, as a histogram of its ticks.
class LoadPlot final : public PlotPanel {
 public:
  explicit LoadPlot(QWidget* parent);

  void show(const LoadWindow& window);

 protected:
  void paint_plot(QPainter& painter, const QRectF& area) override;

 private:
  LoadCounts counts_ = {};
  std::optional<double> median_ = {}, p999_ = {};  // percent
};

}  // namespace icome::ui
