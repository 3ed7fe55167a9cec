#include "render/scene/scene_targets.h"

#include <utility>

namespace icome::render {

base::Result<void> SceneCanvas::fit(int new_width, int new_height, unsigned colour_format,
                                    unsigned depth_format) {
  if (width == new_width && height == new_height) return {};
  width = height = 0;
  colour = colour_format ? make_target(colour_format, new_width, new_height) : GlObject();
  depth = depth_format ? make_target(depth_format, new_width, new_height) : GlObject();
  auto made = make_frame(colour_format ? &colour : nullptr, depth_format ? &depth : nullptr);
  if (!made) return tl::unexpected(made.error());
  frame = std::move(*made);
  width = new_width;
  height = new_height;
  return {};
}

}  // namespace icome::render
