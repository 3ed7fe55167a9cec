#pragma once
#include <string>

#include "base/result.h"
#include "charts/image.h"
#include "render/scene/scene_renderer.h"

namespace icome::render {

/// Draws a scene without a window or a display server: in a context of its own, in tiles where it is large.
/// Sides 1 ... 16384 pixels. Fails when OpenGL is missing, naming what to install, or the driver refuses.
base::Result<charts::Image> draw_picture(const RenderScene& scene, const Camera& camera,
                                         const SceneLook& look, int width, int height);

/// As many passes as look well in the time that a person waits: 20 for most scenes, down to 8 for heavy ones.
int still_passes(const RenderScene& scene);

}  // namespace icome::render
