#include "render/scene/scene_buffers.h"

#include <epoxy/gl.h>

#include <cstring>

namespace icome::render {
namespace {

/// The rows of an image, bottom row first, as OpenGL counts.
std::vector<std::uint8_t> upside_down(const charts::Image& image) {
  std::vector<std::uint8_t> rows(image.rgba.size());
  const std::size_t row = 4 * std::size_t(image.width);
  for (std::size_t y = 0; y < std::size_t(image.height); ++y)
    std::memcpy(rows.data() + y * row, image.rgba.data() + (std::size_t(image.height) - 1 - y) * row, row);
  return rows;
}

GlObject upload_picture(const RenderPicture& picture) {
  GlObject texture(GlObject::Kind::Texture);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, picture.image.width, picture.image.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, upside_down(picture.image).data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, picture.repeats[0] ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, picture.repeats[1] ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

const MeshView& SceneBuffers::view(const RenderShapePointer& shape, int level) {
  ShapeEntry& found = shapes_[shape.get()];
  // Another shape may lie at the address of one that is gone.
  if (found.shape.lock() != shape) found = {shape, {}};
  found.views.resize(1 + shape->coarser.size());
  std::unique_ptr<MeshView>& view = found.views[std::size_t(level - kFullLevel)];
  if (view) return *view;
  if (level == kFullLevel) {
    view = std::make_unique<MeshView>(shape->mesh, shape->picture_places, shape->colours);
  } else {
    const ShapeLevel& coarser = shape->coarser[std::size_t(level)];
    view = std::make_unique<MeshView>(coarser.mesh, std::span<const Eigen::Vector2f>(), coarser.colours);
  }
  return *view;
}

unsigned SceneBuffers::picture(const std::shared_ptr<const RenderPicture>& picture) {
  PictureEntry& found = pictures_[picture.get()];
  if (found.picture.lock() != picture) found = {picture, upload_picture(*picture)};
  return found.texture.name();
}

void SceneBuffers::drop_unused() {
  std::erase_if(shapes_, [](const auto& it) { return it.second.shape.expired(); });
  solids_.drop_unused();
  std::erase_if(pictures_, [](const auto& it) { return it.second.picture.expired(); });
}

}  // namespace icome::render
