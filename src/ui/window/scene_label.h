#pragma once
#include <QString>
#include <optional>

#include "render/scene/scene_renderer.h"
#include "session/session.h"

namespace icome::ui {

/// A text as a picture for the scene, kept for as long as text and look are the same. Used on main only.
class SceneWords {
 public:
  /// The picture in the colours of the theme, sharp at this ratio of screen to device-independent pixels.
  const std::shared_ptr<const charts::Image>& picture(const QString& text, double pixel_ratio);

 private:
  struct Look {
    QString text;
    double pixel_ratio = 0.0;
    bool dark = false;
    bool operator==(const Look&) const = default;
  };
  Look drawn_ = {};
  std::shared_ptr<const charts::Image> picture_ = nullptr;  // of that look
};

/// A picture above an object in the scene; nothing for one that is gone or has no place.
std::optional<render::SceneOverlay::Panel> panel_above(const session::Session& session,
                                                       world::ObjectId object,
                                                       const std::shared_ptr<const charts::Image>& picture,
                                                       double pixel_ratio);

/// The name of an object, written above it in the scene, and who else holds it. Used on main only.
class SceneLabel {
 public:
  /// The panel for this object in its present state, sharp at this ratio of screen to device-independent
  /// pixels; nothing for an object that has no place or no name.
  std::optional<render::SceneOverlay::Panel> panel(const session::Session& session, world::ObjectId object,
                                                   double pixel_ratio);

 private:
  SceneWords words_ = {};
};

}  // namespace icome::ui
