#pragma once
#include <QWidget>
#include <functional>

#include "sketch/pen/pressure_curve.h"

namespace icome::ui {

/// Shows how hard a pen draws for how hard it is pressed; three points are dragged up and down, or chosen by
/// Left and Right and moved by Up and Down.
class PressureEditor final : public QWidget {
 public:
  explicit PressureEditor(QWidget* parent);

  void show_curve(const sketch::PressureCurve& curve);
  void on_change(std::function<void(const sketch::PressureCurve&)> change) { change_ = std::move(change); }

  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QRectF field() const;
  QPointF shown(double pressure, double value) const;
  double value(int point) const;
  void move(int point, double value);
  void tell_words();

  sketch::PressureCurve curve_;
  int point_ = 1;  // that is chosen: 0 without pressure, 1 at half, 2 at full pressure
  std::function<void(const sketch::PressureCurve&)> change_ = [](const sketch::PressureCurve&) {};
};

}  // namespace icome::ui
