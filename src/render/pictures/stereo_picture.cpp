#include "render/pictures/stereo_picture.h"

#include <cassert>
#include <cstring>

namespace icome::render {
namespace {

constexpr std::size_t kChannels = 4;

/// Red of the left eye; green, blue and opacity of the right one.
charts::Image laid_over(const charts::Image& left, const charts::Image& right) {
  charts::Image both = right;
  for (std::size_t i = 0; i < both.rgba.size(); i += kChannels) both.rgba[i] = left.rgba[i];
  return both;
}

charts::Image laid_beside(const charts::Image& left, const charts::Image& right) {
  charts::Image both{2 * left.width, left.height, {}};
  both.rgba.resize(2 * left.rgba.size());
  const std::size_t row = kChannels * std::size_t(left.width);
  for (std::size_t y = 0; y < std::size_t(left.height); ++y) {
    std::memcpy(both.rgba.data() + 2 * y * row, left.rgba.data() + y * row, row);
    std::memcpy(both.rgba.data() + (2 * y + 1) * row, right.rgba.data() + y * row, row);
  }
  return both;
}

charts::Image laid_above(const charts::Image& left, const charts::Image& right) {
  charts::Image both{left.width, 2 * left.height, left.rgba};
  both.rgba.insert(both.rgba.end(), right.rgba.begin(), right.rgba.end());
  return both;
}

}  // namespace

charts::Image stereo_picture(const charts::Image& left, const charts::Image& right, StereoLayout layout) {
  assert(left.width == right.width && left.height == right.height);
  if (layout == StereoLayout::SideBySide) return laid_beside(left, right);
  if (layout == StereoLayout::TopBottom) return laid_above(left, right);
  return laid_over(left, right);
}

base::Result<charts::Image> draw_stereo_picture(const RenderScene& scene, const EyeCameras& eyes,
                                                StereoLayout layout, const SceneLook& look, int width,
                                                int height) {
  const auto left = draw_picture(scene, eyes.left, look, width, height);
  if (!left) return left;
  const auto right = draw_picture(scene, eyes.right, look, width, height);
  if (!right) return right;
  return stereo_picture(*left, *right, layout);
}

}  // namespace icome::render
