#include "ui/sketch/paper_view.h"

#include <algorithm>
#include <cmath>

namespace icome::ui {
namespace {

constexpr double kMmInMetre = 1000.0;
constexpr double kPaperMargin = 24.0;  // pixels around paper that is seen whole
constexpr double kLeastScale = 0.05;   // pixels for a mm
constexpr double kMostScale = 400.0;

}  // namespace

QTransform PaperView::screen_from_mm() const {
  return QTransform().translate(middle_.x(), middle_.y()).rotate(turn_).scale(scale_, scale_);
}

QPointF PaperView::to_screen(const base::Vector2& place) const {
  return screen_from_mm().map(QPointF(kMmInMetre * place.x(), kMmInMetre * place.y()));
}

base::Vector2 PaperView::to_paper(QPointF at) const {
  const QPointF mm = screen_from_mm().inverted().map(at);
  return {mm.x() / kMmInMetre, mm.y() / kMmInMetre};
}

void PaperView::fit(const base::Vector2& paper, QSize canvas) {
  const double width = std::max(1.0, canvas.width() - 2.0 * kPaperMargin);
  const double height = std::max(1.0, canvas.height() - 2.0 * kPaperMargin);
  const base::Vector2 mm = kMmInMetre * paper;
  turn_ = 0.0;
  scale_ = std::clamp(std::min(width / mm.x(), height / mm.y()), kLeastScale, kMostScale);
  middle_ = {0.5 * (canvas.width() - scale_ * mm.x()), 0.5 * (canvas.height() - scale_ * mm.y())};
}

void PaperView::zoom(QPointF about, double factor) {
  const double scale = std::clamp(scale_ * factor, kLeastScale, kMostScale);
  middle_ = about + (middle_ - about) * (scale / scale_);
  scale_ = scale;
}

void PaperView::turn(QPointF about, double degrees) {
  middle_ = about + QTransform().rotate(degrees).map(middle_ - about);
  turn_ = std::remainder(turn_ + degrees, 360.0);
}

}  // namespace icome::ui
