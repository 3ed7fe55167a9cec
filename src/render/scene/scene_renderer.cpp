#include "render/scene/scene_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/srgb.h"
#include "render/scene/scene_grid.h"
#include "render/scene/scene_markers.h"
#include "render/scene/scene_panels.h"
#include "render/scene/scene_pass.h"
#include "render/scene/stereo_pass.h"

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;

constexpr double kGroundReach = 3.0;  // times half the size of the scene that stands on it
constexpr double kCellAtOnce = 1.0;   // pixels: smaller cells may be left out
constexpr int kMostPasses = 256;
constexpr int kMeltingPasses = 8;  // from the picture that was drawn at once to the mean of passes

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

/// Each number once, in an order whose beginnings are spread over all: steps of about the golden section.
int spread_number(int number, int count) {
  int step = std::max(1, int(std::lround(0.6180339887 * count)));
  while (std::gcd(step, count) != 1) ++step;
  return number * step % count;
}

Eigen::Vector4f linear_with_alpha(const charts::Colour& colour) {
  return {float(base::linear_from_srgb(colour.red)), float(base::linear_from_srgb(colour.green)),
          float(base::linear_from_srgb(colour.blue)), float(colour.alpha)};
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

/// A picture that is asked for.
struct ScenePictureWish {
  const RenderScene& scene;
  const Camera& camera;  ///< of the whole picture
  const SceneLook& look;
  const SceneTarget& target;
  Camera part;  ///< of the target's window
  int passes;

  bool is_clear() const { return look.above.alpha < 1.0 || look.below.alpha < 1.0; }
};

/// The data that all passes of a picture share.
struct ScenePicture {
  const ScenePictureWish& wish;
  SceneLights lights;
  std::optional<ShadowRegion> shadows;
};

ScenePicture plan_picture(const ScenePictureWish& wish) {
  ScenePicture picture{wish, choose_lights(wish.scene, wish.camera, wish.look.lights), std::nullopt};
  // The region of the whole picture: its tiles have the same shadows.
  if (wish.look.shadows)
    picture.shadows = shadow_region(visible_bounds(wish.scene, wish.camera), wish.camera);
  return picture;
}

/// The values on which a background's look depends beside its size.
struct BackgroundKey {
  Eigen::Vector4f above = Eigen::Vector4f::Zero(), below = Eigen::Vector4f::Zero();
  Eigen::Vector2d window = Eigen::Vector2d::Zero();

  bool operator==(const BackgroundKey&) const = default;
};

/// Most triangles in a picture that must be there before the next one is due.
std::size_t drawn_at_once_at_most() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view driver = name ? name : "";
  const bool in_software = driver.find("llvmpipe") != driver.npos || driver.find("softpipe") != driver.npos;
  return in_software ? 250'000 : 5'000'000;
}

/// While this lives, colours drawn are light: the frame turns them into the colours of screens.
class ScreenColours {
 public:
  ScreenColours() { glEnable(GL_FRAMEBUFFER_SRGB); }
  ScreenColours(const ScreenColours&) = delete;
  ScreenColours& operator=(const ScreenColours&) = delete;
  ~ScreenColours() { glDisable(GL_FRAMEBUFFER_SRGB); }
};

void copy(const SceneCanvas& from, unsigned to, GLbitfield what) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.frame.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, from.width, from.height, 0, 0, from.width, from.height, what, GL_NEAREST);
}

void set_background(const GlObject& program, const ScenePictureWish& wish) {
  glUseProgram(program.name());
  const auto slot = [&](const char* uniform) { return glGetUniformLocation(program.name(), uniform); };
  glUniform4fv(slot("above"), 1, linear_with_alpha(wish.look.above).data());
  glUniform4fv(slot("below"), 1, linear_with_alpha(wish.look.below).data());
  const PictureWindow& window = wish.target.window;
  glUniform4f(slot("window"), float(window.left), float(window.bottom), float(window.width),
              float(window.height));
}

void bind_canvas(const SceneCanvas& canvas) {
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.frame.name());
  glViewport(0, 0, canvas.width, canvas.height);
}

}  // namespace

struct SceneRenderer::Parts {
  ScenePrograms programs;
  SceneBuffers buffers;
  SceneMarkers markers;
  ScenePanels panels;
  SceneGrid grid;
  SceneCanvas at_once;  // the picture in one pass, and its depths
  SceneCanvas pass, sum, mean;
  SceneCanvas shown;  // the picture with outlines and overlay
  SceneCanvas background, mask;
  BackgroundKey background_key;
  SceneShadowMaps steady_shadow;  // of pictures drawn at once: kept while things stay where they are
  SceneShadowMaps shadows;        // of one pass
  MeshView ground = make_ground_square();
  GlObject empty_arrays{GlObject::Kind::VertexArray};
  std::size_t most_triangles = drawn_at_once_at_most();
  int serial = 0;  // of passes
  int summed = 0;  // passes of the picture so far
  int begun = 0;   // passes that it is to have; 0: there is none

  base::Result<void> draw(const ScenePictureWish& wish, int passes, bool anew);
  base::Result<void> fit_canvases(const ScenePictureWish& wish, bool refined);
  base::Result<void> draw_at_once(ScenePicture picture);
  base::Result<void> refine(const ScenePicture& picture, int passes);
  base::Result<void> draw_scene(const ScenePicture& picture, const ScenePlan& plan, PassNumber number);
  base::Result<void> draw_shadows(const RenderScene& scene, ScenePass& stages, SceneShadowMaps& maps,
                                  const std::vector<Camera>& lenses, int side);
  base::Result<void> draw_whole(base::Result<SceneProgram*> program, const GlObject* source);
  base::Result<void> fill_background(const ScenePictureWish& wish);
  base::Result<void> add_to_sum();
  base::Result<void> make_mean(const ScenePictureWish& wish);
  void begin_overlay(const SceneCanvas& picture);
  base::Result<void> show(const ScenePictureWish& wish);
  base::Result<void> outline(const ScenePictureWish& wish, const SceneOutline& what);
  base::Result<void> draw_markers(const ScenePictureWish& wish);
};

base::Result<void> SceneRenderer::Parts::fit_canvases(const ScenePictureWish& wish, bool refined) {
  const int width = wish.target.width, height = wish.target.height;
  auto done = at_once.fit(width, height, GL_SRGB8_ALPHA8, GL_DEPTH24_STENCIL8);
  if (done && refined) done = pass.fit(width, height, GL_RGBA16F, GL_DEPTH24_STENCIL8);
  if (done && refined) done = sum.fit(width, height, GL_RGBA32F, 0);
  if (done && refined) done = mean.fit(width, height, GL_SRGB8_ALPHA8, 0);
  if (done) done = shown.fit(width, height, GL_SRGB8_ALPHA8, GL_DEPTH24_STENCIL8);
  if (done && !wish.look.outlines.empty()) done = mask.fit(width, height, GL_R8, 0);
  return done;
}

base::Result<void> SceneRenderer::Parts::draw_shadows(const RenderScene& scene, ScenePass& stages,
                                                      SceneShadowMaps& maps,
                                                      const std::vector<Camera>& lenses, int side) {
  auto done = maps.fit(int(lenses.size()), side);
  if (!done || maps.show(scene, lenses)) return done;
  done = stages.shadow_maps(scene, maps.canvas, side);
  maps.blocks = scene.blocks();
  maps.lenses = lenses;
  return done;
}

/// A picture of a single pass is drawn as it is shown; others are averaged first.
base::Result<void> SceneRenderer::Parts::draw_scene(const ScenePicture& picture, const ScenePlan& plan,
                                                    PassNumber number) {
  const ScenePictureWish& wish = picture.wish;
  const bool toned = number.count == 1;
  const int side = std::clamp(wish.look.shadow_side, 64, 4096);
  const ScenePassLights lights(picture.lights, wish.camera, picture.shadows, side, number, toned);
  ScenePass stages(programs, buffers, lights, pass_shift(number, wish.target), ++serial);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glActiveTexture(GL_TEXTURE0);
  SceneShadowMaps& maps = toned ? steady_shadow : shadows;
  base::Result<void> done;
  if (!lights.lenses().empty()) done = draw_shadows(wish.scene, stages, maps, lights.lenses(), side);
  if (!done) return done;
  bind_canvas(toned ? at_once : pass);
  if (toned) {
    done = fill_background(wish);
    if (!done) return done;
    glClear(GL_DEPTH_BUFFER_BIT);
  } else {
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  glBindTexture(GL_TEXTURE_2D, maps.canvas.depth.name());
  done = stages.opaque(plan.opaque);
  if (done && wish.look.grid)
    done = grid.draw(wish.look, wish.camera, wish.part, pass_shift(number, wish.target), programs);
  const Bounds& all = wish.scene.bounds();
  if (done && wish.look.ground && !lights.lenses().empty() && wish.camera.eye().y() > all.min().y()) {
    const double size = 0.5 * all.sizes().norm();
    const Vector3 middle(0.5 * (all.min().x() + all.max().x()), all.min().y() - 1e-4 * size,
                         0.5 * (all.min().z() + all.max().z()));
    done = stages.ground(ground, wish.part, middle, kGroundReach * size);
  }
  if (done) done = stages.blended(plan.blended);
  return done;
}

base::Result<void> SceneRenderer::Parts::draw_at_once(ScenePicture picture) {
  const ScreenColours light;
  // Uses shadow maps that stay the same while the view moves.
  if (picture.shadows) picture.shadows = steady_region(*picture.shadows, picture.wish.scene.bounds());
  const ScenePictureWish& wish = picture.wish;
  const SceneDetail detail{double(wish.target.height), kCellAtOnce, most_triangles};
  return draw_scene(picture, plan_scene(wish.scene, wish.part, detail), {0, 1});
}

base::Result<void> SceneRenderer::Parts::refine(const ScenePicture& picture, int passes) {
  if (summed == 0) {
    bind_canvas(sum);
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  const ScenePictureWish& wish = picture.wish;
  const ScenePlan plan = plan_scene(wish.scene, wish.part, {double(wish.target.height)});
  base::Result<void> done;
  for (; summed < passes && done; ++summed) {
    done = draw_scene(picture, plan, {spread_number(summed, wish.passes), wish.passes});
    if (done) done = add_to_sum();
  }
  return done ? make_mean(wish) : done;
}

/// Fills the frame that is bound, by a program with a picture as its source or without one.
base::Result<void> SceneRenderer::Parts::draw_whole(base::Result<SceneProgram*> program,
                                                    const GlObject* source) {
  if (!program) return tl::unexpected(program.error());
  glActiveTexture(GL_TEXTURE0);
  if (source) glBindTexture(GL_TEXTURE_2D, source->name());
  glUseProgram((*program)->program.name());
  set_uniform((*program)->program, "source", 0);
  glBindVertexArray(empty_arrays.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return {};
}

/// The background is the same from picture to picture: it is copied, not drawn.
base::Result<void> SceneRenderer::Parts::fill_background(const ScenePictureWish& wish) {
  const BackgroundKey key{linear_with_alpha(wish.look.above), linear_with_alpha(wish.look.below),
                          Eigen::Vector2d(wish.target.window.bottom, wish.target.window.height)};
  if (background.width != wish.target.width || background.height != wish.target.height ||
      !(key == background_key)) {
    auto done = background.fit(wish.target.width, wish.target.height, GL_SRGB8_ALPHA8, 0);
    const auto program = programs.background();
    if (!program) return tl::unexpected(program.error());
    if (!done) return done;
    set_background((*program)->program, wish);
    bind_canvas(background);
    glDisable(GL_DEPTH_TEST);
    done = draw_whole(program, nullptr);
    glEnable(GL_DEPTH_TEST);
    if (!done) return done;
    background_key = key;
  }
  copy(background, at_once.frame.name(), GL_COLOR_BUFFER_BIT);
  bind_canvas(at_once);
  return {};
}

base::Result<void> SceneRenderer::Parts::add_to_sum() {
  bind_canvas(sum);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  auto done = draw_whole(programs.sum(), &pass.colour);
  glDisable(GL_BLEND);
  return done;
}

base::Result<void> SceneRenderer::Parts::make_mean(const ScenePictureWish& wish) {
  const ScreenColours light;
  bind_canvas(mean);
  glDisable(GL_DEPTH_TEST);
  const auto program = programs.mean();
  if (!program) return tl::unexpected(program.error());
  const GlObject& name = (*program)->program;
  set_background(name, wish);
  set_uniform(name, "share", 1.0F / float(summed));
  const int melted = std::min(kMeltingPasses, wish.passes);
  set_uniform(name, "at_once_share", float(std::max(0, melted - summed)) / float(melted));
  set_uniform(name, "at_once", 1);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, at_once.colour.name());
  return draw_whole(program, &sum.colour);
}

base::Result<void> SceneRenderer::Parts::outline(const ScenePictureWish& wish, const SceneOutline& what) {
  std::vector<world::ObjectId> objects = what.objects;
  std::sort(objects.begin(), objects.end());
  std::vector<PlannedItem> items;
  wish.scene.for_each([&](const RenderItem& item) {
    if (std::binary_search(objects.begin(), objects.end(), item.object))
      items.push_back(plan_item(item, wish.part));
  });
  if (items.empty()) return {};
  const ScenePassLights dark({}, wish.camera, std::nullopt, 1, {}, true);
  ScenePass stage(programs, buffers, dark, Matrix4::Identity(), ++serial);
  bind_canvas(mask);
  glDisable(GL_DEPTH_TEST);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  auto done = stage.mask(items);
  const auto program = programs.outline();
  if (!program) return tl::unexpected(program.error());
  glUseProgram((*program)->program.name());
  const charts::Colour& line = what.colour;
  glUniform4f(glGetUniformLocation((*program)->program.name(), "colour"), float(line.red), float(line.green),
              float(line.blue), 1.0F);
  set_uniform((*program)->program, "reach", std::clamp(wish.look.outline_width, 1, 8));
  bind_canvas(shown);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (done) done = draw_whole(program, &mask.colour);
  glDisable(GL_BLEND);
  return done;
}

base::Result<void> SceneRenderer::Parts::draw_markers(const ScenePictureWish& wish) {
  const ScreenColours light;
  const ScenePassLights lights(choose_lights(wish.scene, wish.camera, wish.look.lights), wish.camera,
                               std::nullopt, 1, {}, true);
  ScenePass stages(programs, buffers, lights, Matrix4::Identity(), ++serial);
  bind_canvas(shown);
  glEnable(GL_DEPTH_TEST);
  return markers.draw(wish.look.overlay, wish.part, stages, programs, wish.target);
}

void SceneRenderer::Parts::begin_overlay(const SceneCanvas& picture) {
  const ScreenColours light;  // of all canvases: this makes it a mere copy
  copy(picture, shown.frame.name(), GL_COLOR_BUFFER_BIT);
  copy(at_once, shown.frame.name(), GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

/// Shows the picture as it is so far, with outlines and overlay.
base::Result<void> SceneRenderer::Parts::show(const ScenePictureWish& wish) {
  const SceneCanvas* canvas = summed > 0 ? &mean : &at_once;
  base::Result<void> done;
  if (!wish.look.outlines.empty() || !wish.look.overlay.empty()) {
    begin_overlay(*canvas);
    canvas = &shown;
    for (const SceneOutline& it : wish.look.outlines)
      if (done) done = outline(wish, it);
    bind_canvas(shown);
    if (done) done = panels.draw(wish.look.overlay, PanelLayer::InScene, wish.camera, wish.target, programs);
    if (done) done = draw_markers(wish);
    bind_canvas(shown);
    if (done) done = panels.draw(wish.look.overlay, PanelLayer::OverAll, wish.camera, wish.target, programs);
  }
  glDisable(GL_DEPTH_TEST);
  if (!done) return done;
  if (!wish.is_clear()) {
    copy(*canvas, wish.target.frame, GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_FRAMEBUFFER, wish.target.frame);
    return {};
  }
  glBindFramebuffer(GL_FRAMEBUFFER, wish.target.frame);
  glViewport(0, 0, wish.target.width, wish.target.height);
  return draw_whole(programs.clear(), &canvas->colour);
}

/// `passes`: the number that the picture has afterwards; 1 stands for the picture drawn at once.
base::Result<void> SceneRenderer::Parts::draw(const ScenePictureWish& wish, int passes, bool anew) {
  const bool fits = at_once.width == wish.target.width && at_once.height == wish.target.height;
  if (!fits || begun != wish.passes) anew = true;
  auto done = fit_canvases(wish, wish.passes > 1);
  if (!done) return done;
  buffers.solids().set_rule(wish.look.csg, double(wish.target.width) * wish.target.height);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  if (anew) begun = summed = 0;
  if (anew || (passes > 1 && summed < passes)) {
    buffers.drop_unused();
    const ScenePicture picture = plan_picture(wish);
    if (anew) done = draw_at_once(picture);
    if (done && passes > 1) done = refine(picture, passes);
    // A picture that failed begins anew next time.
    begun = done ? wish.passes : 0;
  }
  return done ? show(wish) : done;
}

SceneRenderer::SceneRenderer() : parts_(std::make_unique<Parts>()) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

base::Result<void> SceneRenderer::draw(const RenderScene& scene, const Camera& camera, const SceneLook& look,
                                       const SceneTarget& target) {
  if (auto good = check_target(target); !good) return good;
  const int passes = std::clamp(look.passes, 1, kMostPasses);
  return parts_->draw({scene, camera, look, target, windowed(camera, target.window), passes}, passes, true);
}

base::Result<void> SceneRenderer::draw_pass(const RenderScene& scene, const Camera& camera,
                                            const SceneLook& look, const SceneTarget& target, int number) {
  if (auto good = check_target(target); !good) return good;
  stereo_.reset();
  const int passes = std::clamp(look.passes, 1, kMostPasses);
  return parts_->draw({scene, camera, look, target, windowed(camera, target.window), passes},
                      std::clamp(number, 0, passes - 1) + 1, number <= 0);
}

base::Vector2 share_of_eye(StereoLayout layout) {
  return {layout == StereoLayout::SideBySide ? 0.5 : 1.0, layout == StereoLayout::TopBottom ? 0.5 : 1.0};
}

base::Result<void> SceneRenderer::draw_stereo_pass(const RenderScene& scene, const EyeCameras& eyes,
                                                   StereoLayout layout, const SceneLook& look,
                                                   const SceneTarget& target, int number) {
  if (auto good = check_target(target); !good) return good;
  const bool anew = !stereo_ || number <= 0;
  if (!stereo_) stereo_ = std::make_unique<StereoPass>();
  return stereo_->draw(scene, eyes, layout, look, target, anew ? 0 : number, parts_->programs);
}

}  // namespace icome::render
