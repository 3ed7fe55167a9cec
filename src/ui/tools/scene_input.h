#pragma once
#include <QPointF>
#include <QSizeF>
#include <Qt>
#include <algorithm>

#include "interaction/navigation.h"

namespace icome::ui {

/// The mouse or pen over the scene.
struct SceneInput {
  QPointF at = {};              // device-independent pixels, from the scene's upper left corner
  QSizeF size = {1.0, 1.0};     // of the scene, in the same unit
  Qt::MouseButton button = {};  // the one pressed or released; none: it moved
  Qt::KeyboardModifiers modifiers = {};

  double aspect() const { return size.width() / size.height(); }
  double shorter_side() const { return std::min(size.width(), size.height()); }
  interaction::Ray ray(const interaction::View& view) const {
    return interaction::ray_through(view, 2.0 * at.x() / size.width() - 1.0,
                                    1.0 - 2.0 * at.y() / size.height(), aspect());
  }
};

}  // namespace icome::ui
