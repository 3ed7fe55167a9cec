#pragma once
#include <QPointF>
#include <QSize>
#include <QTransform>

#include "animation/picture/stage_picture.h"

namespace icome::ui {

/// The part of a stage that is seen, and its size. Screen lengths are device-independent pixels, those of
/// the page px of the stage. A plain value.
class StageScale {
 public:
  /// Shows a page of this size whole in the middle of a widget.
  void fit(const animation::Vector2& page, QSize widget);
  /// The place under the pointer stays there.
  void zoom(QPointF about, double factor);
  void shift(QPointF by) { corner_ += by; }
  /// Screen pixels for one px of the page.
  double scale() const { return scale_; }
  animation::Affine2 screen_from_page() const;

  bool operator==(const StageScale&) const = default;

 private:
  QPointF corner_;
  double scale_ = 1;
};

/// A map as painters have it.
QTransform transform_of(const animation::Affine2& map);
QPointF point_of(const animation::Vector2& place);
animation::Vector2 place_of(QPointF point);

}  // namespace icome::ui
