#include "render/scene/stereo_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace icome::render {
namespace {

/// Pixels along a side of the picture of an eye.
int eye_side(int side, double share) { return std::max(1, int(std::floor(side * share))); }

}  // namespace

base::Result<void> StereoPass::draw(const RenderScene& scene, const EyeCameras& eyes, StereoLayout layout,
                                    const SceneLook& look, const SceneTarget& target, int number,
                                    ScenePrograms& programs) {
  const base::Vector2 share = share_of_eye(layout);
  SceneTarget eye{0, eye_side(target.width, share.x()), eye_side(target.height, share.y()), {}};
  auto done = left_picture_.fit(eye.width, eye.height, GL_RGBA8, 0);
  if (done) done = right_picture_.fit(eye.width, eye.height, GL_RGBA8, 0);
  eye.frame = left_picture_.frame.name();
  if (done) done = left_.draw_pass(scene, eyes.left, look, eye, number);
  eye.frame = right_picture_.frame.name();
  if (done) done = right_.draw_pass(scene, eyes.right, look, eye, number);
  if (!done) return done;
  if (layout == StereoLayout::Anaglyph) return lay_over(target, programs);
  lay_beside(layout, target);
  return {};
}

/// Each eye's channels are copied bit by bit: a blit would pass over the mask of channels.
base::Result<void> StereoPass::lay_over(const SceneTarget& target, ScenePrograms& programs) {
  const auto program = programs.sum();  // copies
  if (!program) return tl::unexpected(program.error());
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
  glViewport(0, 0, target.width, target.height);
  glUseProgram((*program)->program.name());
  set_uniform((*program)->program, "source", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(no_arrays_.name());
  glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_FALSE);
  glBindTexture(GL_TEXTURE_2D, left_picture_.colour.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glColorMask(GL_FALSE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindTexture(GL_TEXTURE_2D, right_picture_.colour.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  return {};
}

/// Left beside right, or left above right; with an odd side a line between them stays black.
void StereoPass::lay_beside(StereoLayout layout, const SceneTarget& target) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  const bool aside = layout == StereoLayout::SideBySide;
  const auto lay = [&](const SceneCanvas& picture, int x, int y) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.frame.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.frame);
    glBlitFramebuffer(0, 0, picture.width, picture.height, x, y, x + picture.width, y + picture.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  };
  lay(left_picture_, 0, aside ? 0 : target.height - left_picture_.height);
  lay(right_picture_, aside ? target.width - right_picture_.width : 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
}

}  // namespace icome::render
