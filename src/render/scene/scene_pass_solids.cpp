// The part of a pass that draws CSG solids from images of their operands.
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/srgb.h"
#include "render/csg/csg_view.h"
#include "render/scene/scene_pass.h"

namespace icome::render {
namespace {

using base::Bounds;

std::array<GLint, 4> viewport() {
  std::array<GLint, 4> port{};
  glGetIntegerv(GL_VIEWPORT, port.data());
  return port;
}

GLuint bound_frame() {
  GLint frame = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &frame);
  return GLuint(frame);
}

Eigen::Vector3f operand_rgb(const charts::Colour& colour) {
  return {float(base::linear_from_srgb(colour.red)), float(base::linear_from_srgb(colour.green)),
          float(base::linear_from_srgb(colour.blue))};
}

Bounds buffer_bounds(const RenderShape& shape) {
  const auto to_buffer = [&](const base::Vector3& p) {
    return base::Vector3((p - shape.mesh.centre) / shape.mesh.radius);
  };
  return {to_buffer(shape.bounds.min()), to_buffer(shape.bounds.max())};
}

/// Drawing is confined to the pixels of a solid, and to a few around.
class SolidScissor {
 public:
  explicit SolidScissor(const PlannedItem& planned) {
    const Bounds box = device_box(buffer_bounds(*planned.item->shape), planned.clip_from_buffer);
    const auto port = viewport();
    constexpr double kSlack = 2.0;  // pixels: passes are shifted, and operands are a little larger
    const auto pixel = [](double device, int size, double slack) {
      return int(std::clamp((0.5 + 0.5 * device) * size + slack, 0.0, double(size)));
    };
    x = pixel(box.min().x(), port[2], -kSlack);
    y = pixel(box.min().y(), port[3], -kSlack);
    width = pixel(box.max().x(), port[2], kSlack) - x;
    height = pixel(box.max().y(), port[3], kSlack) - y;
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, width, height);
  }
  SolidScissor(const SolidScissor&) = delete;
  SolidScissor& operator=(const SolidScissor&) = delete;
  ~SolidScissor() { glDisable(GL_SCISSOR_TEST); }

  int x, y, width, height;
};

void draw_solid_depth(const PlannedSolid& solid, const Matrix4& clip) {
  glFrontFace(solid.item->mirrored ? GL_CW : GL_CCW);
  solid.view->draw_depth(clip);
}

void shade_solid(const SceneProgram& program, const PlannedSolid& solid, const Matrix4& clip) {
  const RenderMaterial& look = *solid.item->item->material;
  solid.view->shade(clip, [&](const CsgFaces& faces) {
    const Eigen::Vector3f own = faces.colour ? operand_rgb(*faces.colour) : look.diffuse;
    glUniform4f(program.diffuse, own.x(), own.y(), own.z(), look.alpha);
  });
}

}  // namespace

base::Result<void> ScenePass::solids(std::span<const PlannedSolid> solids) {
  if (solids.empty()) return {};
  for (const PlannedSolid& solid : solids)
    draw_solid_depth(solid, clip_shift_ * solid.item->clip_from_buffer);
  const auto program =
      use_lit(programs_.surface({.shiny = true, .blended = true, .built_in = true}, lights_.kinds()));
  if (!program) return tl::unexpected(program.error());
  for (const PlannedSolid& solid : solids) {
    set_look(**program, *solid.item);
    shade_solid(**program, solid, clip_shift_ * solid.item->clip_from_buffer);
  }
  return {};
}

/// Mixes only the nearest surface of the solid with the picture behind; depths are as before in the end.
base::Result<void> ScenePass::blended_solid(const PlannedSolid& solid) {
  SceneCanvas& kept = buffers_.solids().depths;
  const GLuint frame = bound_frame();
  const auto port = viewport();
  if (const auto fitted = kept.fit(port[2], port[3], 0, GL_DEPTH24_STENCIL8); !fitted) return fitted;
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  const SolidScissor box(*solid.item);
  if (box.width <= 0 || box.height <= 0) return {};
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, kept.depth.name());
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, box.x, box.y, box.x, box.y, box.width, box.height);
  glActiveTexture(GL_TEXTURE0);
  if (const auto drawn = solids({&solid, 1}); !drawn) return drawn;
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_ALWAYS);
  const auto restored = draw_depths(kept.depth, {0, 0}, 1.0, 0.0);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_FALSE);
  return restored;
}

/// Puts depths of another picture, brought to another scale, into the frame that is bound.
base::Result<void> ScenePass::draw_depths(const GlObject& depths, const std::array<int, 2>& corner,
                                          double scale, double shift) {
  const auto program = programs_.depth_copy();
  if (!program) return tl::unexpected(program.error());
  const GlObject& name = (*program)->program;
  glUseProgram(name.name());
  glUniform2f(glGetUniformLocation(name.name(), "scale"), float(scale), float(shift));
  glUniform2f(glGetUniformLocation(name.name(), "corner"), float(corner[0]), float(corner[1]));
  glPushAttrib(GL_COLOR_BUFFER_BIT | GL_ENABLE_BIT);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDisable(GL_CULL_FACE);
  draw_whole(name, depths);
  glPopAttrib();
  return {};
}

/// Runs the program in each pixel, with a picture as its source.
void ScenePass::draw_whole(const GlObject& program, const GlObject& source) {
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, source.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);
  set_uniform(program, "source", 2);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(buffers_.solids().no_arrays());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

base::Result<void> ScenePass::mask_solids(std::span<const PlannedSolid> solids) {
  if (solids.empty()) return {};
  SceneCanvas& seen = buffers_.solids().depths;
  const GLuint frame = bound_frame();
  const auto port = viewport();
  if (const auto fitted = seen.fit(port[2], port[3], 0, GL_DEPTH24_STENCIL8); !fitted) return fitted;
  glBindFramebuffer(GL_FRAMEBUFFER, seen.frame.name());
  glClear(GL_DEPTH_BUFFER_BIT);
  for (const PlannedSolid& solid : solids) draw_solid_depth(solid, solid.item->clip_from_buffer);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  const auto program = programs_.cover();
  if (!program) return tl::unexpected(program.error());
  glUseProgram((*program)->program.name());
  glUniform4f((*program)->diffuse, 1.0F, 1.0F, 1.0F, 1.0F);
  draw_whole((*program)->program, seen.depth);
  return {};
}

/// Solids whose triangles lack parts are drawn by themselves and put among the others: images of CSG are made
/// from pixel (0, 0) only, and of all that lies between the light and the view.
base::Result<void> ScenePass::cast_solids(std::span<const PlannedItem> casters, const SceneCanvas& maps,
                                          int map, int side) {
  std::vector<PlannedSolid> imaged;
  double nearest = -1.0, farthest = 1.0;  // device depths
  for (const PlannedItem& planned : casters) {
    const CsgView* view = buffers_.solids().shadow_images(planned);
    if (!view) continue;
    imaged.push_back({&planned, view});
    const Bounds box = device_box(buffer_bounds(*planned.item->shape), planned.clip_from_buffer);
    nearest = std::min(nearest, box.min().z());
    farthest = std::max(farthest, box.max().z());
  }
  if (imaged.empty()) return {};
  SceneCanvas& own = buffers_.solids().shadow;
  if (const auto fitted = own.fit(side, side, 0, GL_DEPTH24_STENCIL8); !fitted) return fitted;
  glBindFramebuffer(GL_FRAMEBUFFER, own.frame.name());
  glViewport(0, 0, side, side);
  glClear(GL_DEPTH_BUFFER_BIT);
  const double size = 0.5 * (farthest - nearest);
  Matrix4 widened = Matrix4::Identity();
  widened(2, 2) = 1.0 / size;
  widened(2, 3) = -0.5 * (nearest + farthest) / size;
  for (const PlannedSolid& solid : imaged) draw_solid_depth(solid, widened * solid.item->clip_from_buffer);
  glBindFramebuffer(GL_FRAMEBUFFER, maps.frame.name());
  glViewport(map * side, 0, side, side);
  // Depths are (device depth + 1) / 2.
  return draw_depths(own.depth, {map * side, 0}, size, 0.5 * (nearest + 1.0));
}

}  // namespace icome::render
