#include "ui/tools/scene_input.h"

namespace icome::ui {
namespace {

using interaction::Eye;
using interaction::StereoKind;

/// Parts of the scene's width and height that the picture of an eye takes.
QSizeF eye_share(const interaction::StereoSettings& stereo) {
  return {stereo.kind == StereoKind::SideBySide ? 0.5 : 1.0,
          stereo.kind == StereoKind::TopBottom ? 0.5 : 1.0};
}

/// The eye in whose part of the scene the place is.
Eye eye_at(const QPointF& at, const QSizeF& scene, StereoKind kind) {
  const bool second =
      kind == StereoKind::SideBySide ? at.x() >= 0.5 * scene.width() : at.y() >= 0.5 * scene.height();
  return second ? Eye::Right : Eye::Left;
}

}  // namespace

QSizeF eye_size(const QSizeF& scene, const interaction::StereoSettings& stereo) {
  if (stereo.squeezed) return scene;
  const QSizeF share = eye_share(stereo);
  return {scene.width() * share.width(), scene.height() * share.height()};
}

SceneInput in_eye(const SceneInput& whole, const interaction::StereoSettings& stereo,
                  std::optional<Eye> held) {
  SceneInput input = whole;
  input.in_window = whole.at;
  if (stereo.kind != StereoKind::SideBySide && stereo.kind != StereoKind::TopBottom) return input;
  input.eye = held ? *held : eye_at(whole.at, whole.size, stereo.kind);
  const QSizeF share = eye_share(stereo);
  QPointF at = whole.at;
  if (input.eye == Eye::Right) {
    at.rx() -= (1.0 - share.width()) * whole.size.width();
    at.ry() -= (1.0 - share.height()) * whole.size.height();
  }
  input.size = eye_size(whole.size, stereo);
  input.at = {at.x() * input.size.width() / (share.width() * whole.size.width()),
              at.y() * input.size.height() / (share.height() * whole.size.height())};
  return input;
}

QPointF in_scene(const QPointF& at, const QSizeF& scene, const interaction::StereoSettings& stereo) {
  const QSizeF share = eye_share(stereo), picture = eye_size(scene, stereo);
  return {at.x() * share.width() * scene.width() / picture.width(),
          at.y() * share.height() * scene.height() / picture.height()};
}

}  // namespace icome::ui
