#include "render/scene/scene_panels.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace icome::render {
namespace {

using base::Vector2;

/// Has the panel's picture all its bytes, and a size that the driver takes?
bool can_be_drawn(const SceneOverlay::Panel& panel) {
  if (!panel.picture || !(panel.scale > 0.0) || !std::isfinite(panel.scale) || !(panel.alpha > 0.0))
    return false;
  const charts::Image& it = *panel.picture;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return it.width >= 1 && it.height >= 1 && it.width <= largest && it.height <= largest &&
         it.rgba.size() == 4 * std::size_t(it.width) * std::size_t(it.height);
}

/// The panel's place, pixels of the whole picture from its lower left; nothing when it is behind the eye.
std::optional<Vector2> place_of(const SceneOverlay::Panel& panel, const Camera& camera, const Vector2& size) {
  if (!panel.at) return Vector2(panel.in_window.cwiseProduct(size));
  const auto seen = project(camera, *panel.at);
  if (!seen) return std::nullopt;
  return Vector2(seen->x * size.x(), (1.0 - seen->y) * size.y());
}

/// Its lower, then its upper corners in the clip space of the target.
using Corners = Eigen::Matrix<float, 4, 4>;

Corners corners_behind(const SceneOverlay::Panel& panel, double behind, const Camera& camera,
                       const PictureWindow& window) {
  const Matrix4 clip_from_world = windowed(camera, window).clip_from_world();
  const auto& [right, up] = *panel.lying;
  const base::Vector3 middle = *panel.at - behind * right.cross(up).normalized();
  Corners corners;
  for (int i = 0; i < 4; ++i) {
    const base::Vector3 corner = middle + ((i & 1) != 0 ? right : -right) + ((i & 2) != 0 ? up : -up);
    corners.col(i) = (clip_from_world * corner.homogeneous()).cast<float>();
  }
  return corners;
}

Corners corners_of_lying(const SceneOverlay::Panel& panel, const Camera& camera,
                         const PictureWindow& window) {
  Corners corners = corners_behind(panel, 0.0, camera, window);
  corners.row(2).setZero();  // it may lie nearer to the eye than all else
  return corners;
}

/// The corners whose depth hides markers; nothing: none is hidden.
std::optional<Corners> corners_of_depth(const SceneOverlay::Panel& panel, const Camera& camera,
                                        const SceneTarget& target) {
  if (!panel.at || !panel.lying || !std::isfinite(panel.hides_beyond)) return std::nullopt;
  const Corners corners = corners_behind(panel, panel.hides_beyond, camera, target.window);
  return corners.allFinite() ? std::optional(corners) : std::nullopt;
}

/// Draws what the program in use draws there as depth alone, whatever was before it.
void draw_depth(unsigned program, const Corners& corners) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glEnable(GL_DEPTH_CLAMP);
  glUniform4fv(glGetUniformLocation(program, "corners"), 4, corners.data());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_DEPTH_CLAMP);
  glDepthFunc(GL_LESS);
  glDisable(GL_DEPTH_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/// Nothing when it is behind the eye.
std::optional<Corners> corners_of_facing(const SceneOverlay::Panel& panel, const Camera& camera,
                                         const SceneTarget& target) {
  const Vector2 part(target.width, target.height);
  const PictureWindow& window = target.window;
  const Vector2 whole = part.cwiseQuotient(Vector2(window.width, window.height));
  const Vector2 corner = whole.cwiseProduct(Vector2(window.left, window.bottom));
  const auto place = place_of(panel, camera, whole);
  if (!place) return std::nullopt;
  const Vector2 size = panel.scale * Vector2(panel.picture->width, panel.picture->height);
  // On whole pixels, so that letters stay sharp.
  const Vector2 low = (*place + panel.shift - panel.anchor.cwiseProduct(size)).array().round();
  Corners corners;
  for (int i = 0; i < 4; ++i) {
    const Vector2 at = low + Vector2((i & 1) != 0 ? size.x() : 0.0, (i & 2) != 0 ? size.y() : 0.0);
    const Vector2 device = (at - corner).cwiseQuotient(0.5 * part) - Vector2::Ones();
    corners.col(i) << device.cast<float>(), 0.0F, 1.0F;
  }
  return corners;
}

std::optional<Corners> corners_of(const SceneOverlay::Panel& panel, const Camera& camera,
                                  const SceneTarget& target) {
  if (panel.at && panel.lying) return corners_of_lying(panel, camera, target.window);
  return corners_of_facing(panel, camera, target);
}

}  // namespace

unsigned ScenePanels::texture(const std::shared_ptr<const charts::Image>& picture) {
  Entry& found = entries_[picture.get()];
  // Another picture may lie at the address of one that is gone.
  if (found.picture.lock() != picture) {
    found = {picture, GlObject(GlObject::Kind::Texture)};
    glBindTexture(GL_TEXTURE_2D, found.texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture->width, picture->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 picture->rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  return found.texture.name();
}

base::Result<void> ScenePanels::draw(const SceneOverlay& overlay, PanelLayer layer, const Camera& camera,
                                     const SceneTarget& target, ScenePrograms& programs) {
  std::erase_if(entries_, [](const auto& it) { return it.second.picture.expired(); });
  if (overlay.panels.empty()) return {};
  const auto program = programs.panel();
  if (!program) return tl::unexpected(program.error());
  const GlObject& name = (*program)->program;
  glUseProgram(name.name());
  set_uniform(name, "source", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(no_arrays_.name());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  for (const SceneOverlay::Panel& panel : overlay.panels) {
    const bool lies = panel.at && panel.lying;
    if (lies != (layer == PanelLayer::InScene) || !can_be_drawn(panel)) continue;
    const auto corners = corners_of(panel, camera, target);
    if (!corners || !corners->allFinite()) continue;
    glBindTexture(GL_TEXTURE_2D, texture(panel.picture));
    set_uniform(name, "alpha", float(std::min(panel.alpha, 1.0)));
    glUniform4fv(glGetUniformLocation(name.name(), "corners"), 4, corners->data());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    if (const auto depth = corners_of_depth(panel, camera, target)) draw_depth(name.name(), *depth);
  }
  glDisable(GL_BLEND);
  return {};
}

}  // namespace icome::render
