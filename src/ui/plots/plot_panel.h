#pragma once
#include <QWidget>

namespace icome::ui {

/// A small plot with a caption and its figures in words above it: the base of the plots of the strip.
class PlotPanel : public QWidget {
 public:
  PlotPanel(const QString& caption, QWidget* parent);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  /// Sets the figures beside the caption, which screen readers say, too.
  void set_figures(const QString& figures);
  /// Draws the plot into `area`, to which it is clipped.
  virtual void paint_plot(QPainter& painter, const QRectF& area) = 0;
  void paintEvent(QPaintEvent* event) override;

  /// The font of axis labels.
  static QFont small(const QFont& font);

 private:
  QString caption_;
  QString figures_ = {};
};

}  // namespace icome::ui
