#pragma once
#include <QString>
#include <optional>

#include "render/scene/scene_renderer.h"
#include "session/session.h"

namespace icome::ui {

/// Words as a picture for the scene, kept for as long as they are the same. Main's.
class SceneWords {
 public:
  /// Sharp on a screen of that many pixels to a device-independent one, in the colours of the theme.
  const std::shared_ptr<const charts::Image>& picture(const QString& text, double pixel_ratio);

 private:
  struct Look {
    QString text;
    double pixel_ratio = 0.0;
    bool dark = false;
    bool operator==(const Look&) const = default;
  };
  Look drawn_ = {};
  std::shared_ptr<const charts::Image> picture_ = nullptr;  // of that
};

/// The name of an object, written above it in the scene. Main's.
class SceneLabel {
 public:
  /// The panel for this object as it is now, sharp on a screen of that many pixels to a device-independent
  /// one; nothing for an object that has no place or no name.
  std::optional<render::SceneOverlay::Panel> panel(const session::Session& session, world::ObjectId object,
                                                   double pixel_ratio);

 private:
  SceneWords words_ = {};
};

}  // namespace icome::ui
