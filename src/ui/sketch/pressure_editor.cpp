#include "ui/sketch/pressure_editor.h"

#include <QAccessible>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kCurvePoints = 3;
constexpr double kAroundField = 7.0;  // pixels
constexpr double kKeyStep = 0.05;
constexpr const char* kPointNames[kCurvePoints] = {"no", "half", "full"};

}  // namespace

PressureEditor::PressureEditor(QWidget* parent) : QWidget(parent) {
  setObjectName("pressure");
  setAccessibleName("Pressure curve");
  setToolTip("How wide the line is (up) for how hard the pen is pressed (to the right): drag its points");
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::SizeVerCursor);
  tell_words();
}

QSize PressureEditor::sizeHint() const { return {30 * kGrid, 22 * kGrid}; }

QRectF PressureEditor::field() const {
  return QRectF(rect()).adjusted(kAroundField, kAroundField, -kAroundField, -kAroundField);
}

QPointF PressureEditor::shown(double pressure, double value) const {
  const QRectF at = field();
  return {at.left() + pressure * at.width(), at.bottom() - value * at.height()};
}

double PressureEditor::value(int point) const {
  return point == 0 ? curve_.lightest : point == 1 ? curve_.middle : curve_.hardest;
}

void PressureEditor::show_curve(const sketch::PressureCurve& curve) {
  curve_ = curve;
  tell_words();
  update();
}

/// The other points give way, so that the curve never goes back.
void PressureEditor::move(int point, double value) {
  double values[kCurvePoints] = {curve_.lightest, curve_.middle, curve_.hardest};
  values[point] = std::clamp(value, 0.0, 1.0);
  for (int i = 0; i < point; ++i) values[i] = std::min(values[i], values[point]);
  for (int i = point + 1; i < kCurvePoints; ++i) values[i] = std::max(values[i], values[point]);
  show_curve({values[0], values[1], values[2]});
  change_(curve_);
}

void PressureEditor::tell_words() {
  setAccessibleDescription(
      QString("%1 % for %2 pressure").arg(std::lround(100.0 * value(point_))).arg(kPointNames[point_]));
}

void PressureEditor::mousePressEvent(QMouseEvent* event) {
  const double at = (event->position().x() - field().left()) / field().width();
  point_ = std::clamp(int(std::lround(2.0 * at)), 0, kCurvePoints - 1);
  mouseMoveEvent(event);
}

void PressureEditor::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton)
    move(point_, (field().bottom() - event->position().y()) / field().height());
}

void PressureEditor::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Up) return move(point_, value(point_) + kKeyStep);
  if (event->key() == Qt::Key_Down) return move(point_, value(point_) - kKeyStep);
  if (event->key() != Qt::Key_Left && event->key() != Qt::Key_Right) return QWidget::keyPressEvent(event);
  point_ = std::clamp(point_ + (event->key() == Qt::Key_Right ? 1 : -1), 0, kCurvePoints - 1);
  tell_words();
  update();
}

void PressureEditor::paintEvent(QPaintEvent* /*event*/) {
  constexpr int kDrawnSteps = 40;
  constexpr double kPoint = 3.5;
  const ThemeColours& theme = colours();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(hasFocus() ? theme.accent : theme.line, hasFocus() ? 1.5 : 1.0));
  painter.setBrush(theme.base);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.75, 0.75, -0.75, -0.75), kGrid, kGrid);
  painter.setPen(QPen(theme.grid, 1.0));
  painter.drawLine(shown(0.5, 0.0), shown(0.5, 1.0));
  painter.drawLine(shown(0.0, 0.5), shown(1.0, 0.5));
  QPolygonF line;
  for (int i = 0; i <= kDrawnSteps; ++i)
    line << shown(double(i) / kDrawnSteps, curve_(double(i) / kDrawnSteps));
  painter.setPen(QPen(theme.text, 1.5));
  painter.drawPolyline(line);
  for (int i = 0; i < kCurvePoints; ++i) {
    painter.setPen(QPen(theme.accent, 1.5));
    painter.setBrush(hasFocus() && i == point_ ? theme.accent : theme.base);
    painter.drawEllipse(shown(0.5 * i, value(i)), kPoint, kPoint);
  }
}

}  // namespace icome::ui
