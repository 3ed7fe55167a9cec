#pragma once
#include "base/result.h"
#include "render/gl/gl_objects.h"

namespace icome::render {

/// Textures to draw into with their frame; made anew when another size is asked for.
struct SceneCanvas {
  GlObject colour, depth, frame;
  int width = 0, height = 0;

  /// Formats as for make_target; 0 for none. Fails when the driver refuses.
  base::Result<void> fit(int new_width, int new_height, unsigned colour_format, unsigned depth_format);
};

}  // namespace icome::render
