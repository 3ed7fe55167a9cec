#include "render/scene_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/scene_markers.h"
#include "render/scene_pass.h"

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;

constexpr double kGroundReach = 3.0;  // times half the size of what stands on it

/// What the camera can see of the visible things: the shadow maps' texels are spent on that.
std::optional<ShadowRegion> shadow_region(const Bounds& visible, const Camera& camera) {
  if (visible.isEmpty()) return std::nullopt;
  Bounds seen;
  const Matrix4 world_from_clip = camera.clip_from_world().inverse();
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 at = camera.camera_from_world * visible.corner(static_cast<Bounds::CornerType>(corner));
    farthest = std::max(farthest, -at.z());
  }
  const Vector3 eye = camera.eye();
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector3 at = (world_from_clip * Eigen::Vector4d(x, y, 0.0, 1.0)).hnormalized();
      const double depth = -(camera.camera_from_world * at).z();
      seen.extend(eye + farthest / depth * (at - eye));
    }
  }
  seen.extend(eye);
  const Bounds region = visible.intersection(seen);
  const Bounds& used = region.isEmpty() || !region.sizes().allFinite() ? visible : region;
  const double radius = 0.5 * used.sizes().norm();
  if (!std::isfinite(radius) || !(radius > 0.0)) return std::nullopt;
  return ShadowRegion{0.5 * (used.min() + used.max()), radius};
}

/// A shift within the pixel, the same for each number (the R2 sequence, Roberts 2018).
Matrix4 pass_shift(PassNumber pass, const SceneTarget& target) {
  Matrix4 shift = Matrix4::Identity();
  if (pass.count <= 1) return shift;
  constexpr double kPlasticNumber = 1.32471795724474602596;
  const auto wrapped = [](double v) { return v - std::floor(v) - 0.5; };
  shift(0, 3) = 2.0 * wrapped((pass.index + 0.5) / kPlasticNumber) / target.width;
  shift(1, 3) = 2.0 * wrapped((pass.index + 0.5) / (kPlasticNumber * kPlasticNumber)) / target.height;
  return shift;
}

Eigen::Vector4f linear_with_alpha(const Colour& colour) {
  return {float(linear_from_srgb(colour.red)), float(linear_from_srgb(colour.green)),
          float(linear_from_srgb(colour.blue)), float(colour.alpha)};
}

MeshView make_ground_square() {
  geometry::TriangleMesh square;
  square.positions = {{-1.0, 0.0, -1.0}, {-1.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {1.0, 0.0, -1.0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return MeshView(make_shading_mesh(square, 0.0));
}

base::Result<void> check_target(const SceneTarget& target) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (target.width >= 1 && target.height >= 1 && target.width <= largest && target.height <= largest)
    return {};
  return base::fail(fmt::format("a picture of {}x{} cannot be drawn; sides go from 1 to {} pixels",
                                target.width, target.height, largest));
}

/// One picture on its way.
struct ScenePicture {
  const RenderScene& scene;
  const SceneLook& look;
  const SceneTarget& target;
  const Camera& camera;  ///< of the whole picture
  Camera part;           ///< of the target's window
  ScenePlan plan;        ///< of the window
  SceneLights lights;
  std::optional<ShadowRegion> shadows;
  int passes;
};

}  // namespace

struct SceneRenderer::Parts {
  ScenePrograms programs;
  SceneBuffers buffers;
  SceneMarkers markers;
  SceneCanvas pass, sum, shadow, mask;
  MeshView ground = make_ground_square();
  GlObject empty_arrays{GlObject::Kind::VertexArray};
  int serial = 0;  // of passes

  base::Result<void> fit_canvases(const SceneLook& look, const SceneTarget& target);
  base::Result<void> fit_shadow(int maps, int side);
  base::Result<void> draw_pass(const ScenePicture& picture, PassNumber number);
  base::Result<void> draw_whole(base::Result<SceneProgram*> program, const GlObject& source);
  base::Result<void> add_to_sum();
  base::Result<void> resolve(const ScenePicture& picture);
  base::Result<void> outline(const ScenePicture& picture);
};

base::Result<void> SceneRenderer::Parts::fit_canvases(const SceneLook& look, const SceneTarget& target) {
  auto done = pass.fit(target.width, target.height, GL_RGBA16F, GL_DEPTH24_STENCIL8);
  if (done && look.passes > 1) done = sum.fit(target.width, target.height, GL_RGBA32F, 0);
  if (done && !look.selected.empty()) done = mask.fit(target.width, target.height, GL_R8, 0);
  return done;
}

base::Result<void> SceneRenderer::Parts::fit_shadow(int maps, int side) {
  if (shadow.width == maps * side && shadow.height == side) return {};
  auto done = shadow.fit(maps * side, side, 0, GL_DEPTH24_STENCIL8);
  if (!done) return done;
  glBindTexture(GL_TEXTURE_2D, shadow.depth.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return done;
}

base::Result<void> SceneRenderer::Parts::draw_pass(const ScenePicture& picture, PassNumber number) {
  const int side = std::clamp(picture.look.shadow_side, 64, 4096);
  const ScenePassLights lights(picture.lights, picture.camera, picture.shadows, side, number);
  ScenePass stages(programs, buffers, lights, pass_shift(number, picture.target), ++serial);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glActiveTexture(GL_TEXTURE0);
  base::Result<void> done;
  if (!lights.lenses().empty()) {
    done = fit_shadow(int(lights.lenses().size()), side);
    if (done) done = stages.shadow_maps(picture.scene, shadow, side);
    if (!done) return done;
    glBindTexture(GL_TEXTURE_2D, shadow.depth.name());
  }
  glBindFramebuffer(GL_FRAMEBUFFER, pass.frame.name());
  glViewport(0, 0, picture.target.width, picture.target.height);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  done = stages.opaque(picture.plan.opaque);
  const Bounds& all = picture.scene.bounds();
  if (done && picture.look.ground && !lights.lenses().empty() && picture.camera.eye().y() > all.min().y()) {
    const double size = 0.5 * all.sizes().norm();
    const Vector3 middle(0.5 * (all.min().x() + all.max().x()), all.min().y() - 1e-4 * size,
                         0.5 * (all.min().z() + all.max().z()));
    done = stages.ground(ground, picture.part, middle, kGroundReach * size);
  }
  if (done) done = stages.blended(picture.plan.blended);
  if (done) done = markers.draw(picture.look.overlay, picture.part, stages, programs, picture.target);
  return done;
}

/// Fills the frame that is bound by what the program makes of a picture.
base::Result<void> SceneRenderer::Parts::draw_whole(base::Result<SceneProgram*> program,
                                                    const GlObject& source) {
  if (!program) return tl::unexpected(program.error());
  glDisable(GL_DEPTH_TEST);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, source.name());
  glUseProgram((*program)->program.name());
  set_uniform((*program)->program, "source", 0);
  glBindVertexArray(empty_arrays.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return {};
}

base::Result<void> SceneRenderer::Parts::add_to_sum() {
  glBindFramebuffer(GL_FRAMEBUFFER, sum.frame.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  auto done = draw_whole(programs.sum(), pass.colour);
  glDisable(GL_BLEND);
  return done;
}

base::Result<void> SceneRenderer::Parts::resolve(const ScenePicture& picture) {
  glBindFramebuffer(GL_FRAMEBUFFER, picture.target.frame);
  glViewport(0, 0, picture.target.width, picture.target.height);
  const auto program = programs.resolve();
  if (!program) return tl::unexpected(program.error());
  const GlObject& name = (*program)->program;
  glUseProgram(name.name());
  const auto slot = [&](const char* uniform) { return glGetUniformLocation(name.name(), uniform); };
  set_uniform(name, "share", 1.0F / float(picture.passes));
  glUniform4fv(slot("above"), 1, linear_with_alpha(picture.look.above).data());
  glUniform4fv(slot("below"), 1, linear_with_alpha(picture.look.below).data());
  const PictureWindow& window = picture.target.window;
  glUniform4f(slot("window"), float(window.left), float(window.bottom), float(window.width),
              float(window.height));
  return draw_whole(program, picture.passes > 1 ? sum.colour : pass.colour);
}

base::Result<void> SceneRenderer::Parts::outline(const ScenePicture& picture) {
  const auto& selected = picture.look.selected;
  std::vector<PlannedItem> items;
  picture.scene.for_each([&](const RenderItem& item) {
    if (std::find(selected.begin(), selected.end(), item.object) != selected.end())
      items.push_back(plan_item(item, picture.part));
  });
  if (items.empty()) return {};
  const ScenePassLights dark({}, picture.camera, std::nullopt, 1, {});
  ScenePass stage(programs, buffers, dark, Matrix4::Identity(), ++serial);
  glBindFramebuffer(GL_FRAMEBUFFER, mask.frame.name());
  glClear(GL_COLOR_BUFFER_BIT);
  auto done = stage.mask(items);
  const auto program = programs.outline();
  if (!program) return tl::unexpected(program.error());
  glUseProgram((*program)->program.name());
  const Colour& line = picture.look.selection;
  glUniform4f(glGetUniformLocation((*program)->program.name(), "colour"), float(line.red), float(line.green),
              float(line.blue), 1.0F);
  set_uniform((*program)->program, "reach", std::clamp(picture.look.selection_width, 1, 8));
  glBindFramebuffer(GL_FRAMEBUFFER, picture.target.frame);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (done) done = draw_whole(program, mask.colour);
  glDisable(GL_BLEND);
  return done;
}

SceneRenderer::SceneRenderer() : parts_(std::make_unique<Parts>()) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

base::Result<void> SceneRenderer::draw(const RenderScene& scene, const Camera& camera, const SceneLook& look,
                                       const SceneTarget& target) {
  auto done = check_target(target);
  if (done) done = parts_->fit_canvases(look, target);
  if (!done) return done;
  parts_->buffers.drop_unused();
  const Camera part = windowed(camera, target.window);
  ScenePicture picture{scene,
                       look,
                       target,
                       camera,
                       part,
                       plan_scene(scene, part),
                       choose_lights(scene, camera, look.lights),
                       std::nullopt,
                       std::clamp(look.passes, 1, 256)};
  // Of the whole picture: its tiles have the same shadows.
  if (look.shadows) picture.shadows = shadow_region(plan_scene(scene, camera).visible, camera);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  if (picture.passes > 1) {
    glBindFramebuffer(GL_FRAMEBUFFER, parts_->sum.frame.name());
    glClear(GL_COLOR_BUFFER_BIT);
  }
  for (int i = 0; i < picture.passes && done; ++i) {
    done = parts_->draw_pass(picture, {i, picture.passes});
    if (done && picture.passes > 1) done = parts_->add_to_sum();
  }
  if (done) done = parts_->resolve(picture);
  if (done && !look.selected.empty()) done = parts_->outline(picture);
  glDisable(GL_DEPTH_TEST);
  return done;
}

}  // namespace icome::render
