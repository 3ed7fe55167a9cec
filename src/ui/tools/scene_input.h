#pragma once
#include <QPointF>
#include <QSizeF>
#include <Qt>
#include <algorithm>
#include <optional>

#include "interaction/navigation.h"
#include "interaction/screen_view.h"
#include "session/session_view.h"

namespace icome::ui {

/// The mouse or pen over the scene or, where each eye has its part of the window, over the picture of an eye.
struct SceneInput {
  QPointF at = {};              // device-independent pixels, from the picture's upper left corner
  QSizeF size = {1.0, 1.0};     // of the picture, in the same unit
  Qt::MouseButton button = {};  // the one pressed or released; none: it moved
  Qt::KeyboardModifiers modifiers = {};
  interaction::Eye eye = interaction::Eye::Middle;  // of the picture
  std::optional<QPointF> in_window = {};            // place in the scene's window; none: as `at`

  double aspect() const { return size.width() / size.height(); }
  double shorter_side() const { return std::min(size.width(), size.height()); }
  interaction::Ray ray(const interaction::View& view) const {
    return interaction::ray_through(view, 2.0 * at.x() / size.width() - 1.0,
                                    1.0 - 2.0 * at.y() / size.height(), aspect());
  }
  /// The ray from the eye of the picture, as it is drawn.
  interaction::Ray ray(const session::SessionView& view) const { return ray(view.drawn_view(eye)); }
};

/// The size of the picture of an eye in a scene of that size. Squeezed pictures count as they are stretched.
QSizeF eye_size(const QSizeF& scene, const interaction::StereoSettings& stereo);

/// Input over the whole scene as input over the picture of the eye that is there or, once a button is held,
/// of the eye where it was pressed. With one picture for both eyes, that of the middle between them.
SceneInput in_eye(const SceneInput& whole, const interaction::StereoSettings& stereo,
                  std::optional<interaction::Eye> held = std::nullopt);

/// A place in the picture of an eye, of eye_size(), as a place in a scene of that size; in the left eye's
/// picture where each has a part of the scene.
QPointF in_scene(const QPointF& at, const QSizeF& scene, const interaction::StereoSettings& stereo);

}  // namespace icome::ui
