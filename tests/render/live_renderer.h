#pragma once
#include <epoxy/gl.h>

#include <cstring>

#include "render/drawn_world.h"
#include "render/gl/offscreen.h"
#include "render/scene/scene_renderer.h"
#include "render/scene/scene_targets.h"

namespace icome::render {

/// A renderer that goes on from frame to frame, as in a window. One at a time: it has the thread's context.
class LiveRenderer {
 public:
  explicit LiveRenderer(int width = kSide, int height = kSide) : context_(Offscreen::create()) {
    resize(width, height);
  }

  void resize(int width, int height) { EXPECT_TRUE(canvas_.fit(width, height, GL_RGBA8, 0).has_value()); }

  SceneTarget target() const { return {canvas_.frame.name(), canvas_.width, canvas_.height, {}}; }
  SceneRenderer& renderer() { return renderer_; }

  charts::Image draw(const RenderScene& scene, const Camera& camera, const SceneLook& look) {
    return taken(renderer_.draw(scene, camera, look, target()));
  }
  charts::Image draw_pass(const RenderScene& scene, const Camera& camera, const SceneLook& look, int number) {
    return taken(renderer_.draw_pass(scene, camera, look, target(), number));
  }

 private:
  charts::Image taken(const base::Result<void>& done) const {
    EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
    charts::Image image{canvas_.width, canvas_.height, {}};
    const std::size_t row = 4 * std::size_t(image.width);
    std::vector<std::uint8_t> pixels(row * std::size_t(image.height));
    glBindFramebuffer(GL_FRAMEBUFFER, canvas_.frame.name());
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    image.rgba.resize(pixels.size());
    for (std::size_t y = 0; y < std::size_t(image.height); ++y)
      std::memcpy(&image.rgba[y * row], &pixels[pixels.size() - (y + 1) * row], row);
    return image;
  }

  base::Result<Offscreen> context_;
  SceneRenderer renderer_;
  SceneCanvas canvas_;
};

/// Mean over all of how far colours differ, in 255ths.
inline double mean_difference(const charts::Image& a, const charts::Image& b) {
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
  return sum / double(a.rgba.size());
}

}  // namespace icome::render
