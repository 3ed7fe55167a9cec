#include "ui/cutout/stage/stage_scale.h"

#include <algorithm>

namespace icome::ui {
namespace {

constexpr double kStageMargin = 24.0;  // pixels around a stage that is seen whole
constexpr double kSmallestScale = 0.02;
constexpr double kLargestScale = 64.0;

}  // namespace

void StageScale::fit(const animation::Vector2& page, QSize widget) {
  const double width = std::max(1.0, widget.width() - 2.0 * kStageMargin);
  const double height = std::max(1.0, widget.height() - 2.0 * kStageMargin);
  scale_ = std::clamp(std::min(width / page.x(), height / page.y()), kSmallestScale, kLargestScale);
  corner_ = {0.5 * (widget.width() - scale_ * page.x()), 0.5 * (widget.height() - scale_ * page.y())};
}

void StageScale::zoom(QPointF about, double factor) {
  const double scale = std::clamp(scale_ * factor, kSmallestScale, kLargestScale);
  corner_ = about + (corner_ - about) * (scale / scale_);
  scale_ = scale;
}

animation::Affine2 StageScale::screen_from_page() const {
  return animation::Affine2(Eigen::Translation2d(corner_.x(), corner_.y()) * Eigen::Scaling(scale_));
}

QTransform transform_of(const animation::Affine2& map) {
  const auto& m = map.matrix();
  return {m(0, 0), m(1, 0), m(0, 1), m(1, 1), m(0, 2), m(1, 2)};
}

QPointF point_of(const animation::Vector2& place) { return {place.x(), place.y()}; }

animation::Vector2 place_of(QPointF point) { return {point.x(), point.y()}; }

}  // namespace icome::ui
