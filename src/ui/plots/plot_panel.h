#pragma once
#include <QWidget>

namespace icome::ui {

/// A small plot with a caption and its figures in words above: what the plots of the strip have in common.
class PlotPanel : public QWidget {
 public:
  PlotPanel(const QString& caption, QWidget* parent);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  /// The figures beside the caption. Also what screen readers say.
  void set_figures(const QString& figures);
  /// Draws into the plot's own area, which is clipped to it.
  virtual void paint_plot(QPainter& painter, const QRectF& area) = 0;
  void paintEvent(QPaintEvent* event) override;

  /// Letters of axes.
  static QFont small(const QFont& font);

 private:
  QString caption_;
  QString figures_ = {};
};

}  // namespace icome::ui
