#include "render/pictures/picture_of_scene.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/gl/offscreen.h"
#include "render/scene/scene_targets.h"

namespace icome::render {
namespace {

constexpr int kMostSide = 16384;  // pixels
constexpr int kTileSide = 2048;   // pixels: what is drawn at once takes 36 bytes a pixel

/// Copies the bound frame into the picture; `x`, `y` are of the lower left corner.
void read_tile(const SceneTarget& tile, int x, int y, charts::Image& image) {
  const std::size_t row = 4 * std::size_t(tile.width);
  std::vector<std::uint8_t> pixels(row * std::size_t(tile.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (int line = 0; line < tile.height; ++line) {
    const std::size_t from_top = std::size_t(image.height - 1 - (y + line));
    std::memcpy(image.rgba.data() + 4 * (from_top * std::size_t(image.width) + std::size_t(x)),
                pixels.data() + std::size_t(line) * row, row);
  }
}

/// Number of equal parts of at most kTileSide pixels along a side.
int tiles_along(int side) { return (side + kTileSide - 1) / kTileSide; }

}  // namespace

int still_passes(const RenderScene& scene) {
  const double work = double(scene.triangle_count()) + 300.0 * double(scene.object_count());
  return int(std::clamp(20.0 * 2e5 / std::max(work, 1.0), 8.0, 20.0));
}

base::Result<charts::Image> draw_picture(const RenderScene& scene, const Camera& camera,
                                         const SceneLook& look, int width, int height) {
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide) {
    return base::fail(fmt::format("a picture of {}x{} cannot be drawn; sides go from 1 to {} pixels", width,
                                  height, kMostSide));
  }
  const auto context = Offscreen::create();
  if (!context) return tl::unexpected(context.error());
  SceneRenderer renderer;
  SceneCanvas canvas;
  charts::Image image{width, height, std::vector<std::uint8_t>(4 * std::size_t(width) * std::size_t(height))};
  const int columns = tiles_along(width), rows = tiles_along(height);
  for (int i = 0; i < columns * rows; ++i) {
    const int left = width * (i % columns) / columns, right = width * (i % columns + 1) / columns;
    const int bottom = height * (i / columns) / rows, top = height * (i / columns + 1) / rows;
    SceneTarget tile{0, right - left, top - bottom, {}};
    tile.window = {double(left) / width, double(bottom) / height, double(tile.width) / width,
                   double(tile.height) / height};
    if (const auto fitted = canvas.fit(tile.width, tile.height, GL_RGBA8, 0); !fitted)
      return tl::unexpected(fitted.error());
    tile.frame = canvas.frame.name();
    if (const auto drawn = renderer.draw(scene, camera, look, tile); !drawn)
      return tl::unexpected(drawn.error());
    read_tile(tile, left, bottom, image);
  }
  return image;
}

}  // namespace icome::render
