#include "render/pictures/studio.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "base/decompositions.h"
#include "base/srgb.h"
#include "render/csg/csg_view.h"
#include "render/gl/gl_objects.h"
#include "render/gl/mesh_view.h"
#include "render/model/shading_mesh.h"
#include "render/pictures/studio_meshes.h"

namespace icome::render {
namespace {

using base::Pose;
using base::Vector3;

constexpr int kFloorSide = 512;      // texels of the floor's shadow
constexpr double kFloorReach = 2.4;  // half the side of the floor, in the studio's unit
constexpr int kLightsAPass = 4;

// All drawing is done in the studio frame, where the ball around the bodies has radius 1 and sits at the
// origin: a model of any unit then meets the same numbers.

constexpr char kVertexShader[] = R"(
#ifdef SOLID
#define position gl_Vertex.xyz
#define normal gl_Normal
#else
in vec3 position;
in vec3 normal;
uniform mat4 clip_from_studio;
#endif
uniform mat4 studio_from_buffer;
#ifndef DEPTH_ONLY
uniform mat4 direction_from_buffer;
out vec3 studio_position;
out vec3 studio_normal;
#endif
void main() {
  vec4 studio = studio_from_buffer * vec4(position, 1.0);
#ifndef DEPTH_ONLY
  studio_position = studio.xyz;
  studio_normal = mat3(direction_from_buffer) * normal;
#endif
#ifdef SOLID
  gl_Position = ftransform();
#else
  gl_Position = clip_from_studio * studio;
#endif
}
)";

// A pass has LIGHTS lights; their shadow maps lie side by side in one texture. The lookup is shifted by a
// little noise, so that the edges of few hard shadows melt into one another when the passes are averaged.
// BODY: a lit surface. SOLID: likewise, of an operand of CSG. FLOOR: how much light the floor misses.
// DEPTH_ONLY: none of these.
constexpr char kFragmentShader[] = R"(
#ifdef DEPTH_ONLY
void main() {}
#else
in vec3 studio_position;
in vec3 studio_normal;
out vec4 result;
uniform mat4 shadow_from_studio[LIGHTS];
uniform vec3 to_light[LIGHTS];
uniform vec3 light[LIGHTS];
uniform float gloss[LIGHTS];
uniform sampler2DShadow shadow_map;
uniform vec3 albedo;
uniform vec3 eye;
uniform float share;
uniform float pass_number;
uniform float facing_out;

vec3 noise(vec2 pixel) {
  vec3 seed = fract(vec3(pixel.xyx) * vec3(0.1031, 0.1030, 0.0973) + 0.137 * pass_number);
  seed += dot(seed, seed.yxz + 33.33);
  return fract((seed.xxy + seed.yzz) * seed.zyx) - 0.5;
}

float lit(int which, vec3 p) {
  vec3 at = (shadow_from_studio[which] * vec4(p, 1.0)).xyz * 0.5 + 0.5;
  at.x = (clamp(at.x, 0.0, 1.0) + float(which)) / float(LIGHTS);
  return texture(shadow_map, at - vec3(0.0, 0.0, 0.0008));
}

#ifdef FLOOR
void main() {
  vec3 n = normalize(studio_normal);
  vec3 p = studio_position + 0.05 * noise(gl_FragCoord.xy);
  float blocked = 0.0;
  for (int i = 0; i < LIGHTS; ++i) {
    // Light from near the horizon throws shadows too long for a picture.
    float height = smoothstep(0.2, 0.8, dot(n, to_light[i]));
    if (height > 0.0) blocked += height * light[i].g * (1.0 - lit(i, p));
  }
  result = vec4(blocked);
}
#else
void main() {
  vec3 view = normalize(eye - studio_position);
#ifdef SOLID
  const bool front = true;
  vec3 n = normalize(facing_out * studio_normal);
#else
  bool front = gl_FrontFacing;
  vec3 n = normalize(front ? studio_normal : -studio_normal);
#endif
  vec3 own = front ? albedo : albedo * vec3(0.74, 0.80, 0.90);
  vec3 spread = noise(gl_FragCoord.xy);
  // Within the surface's plane, so that the shift alone never puts a point into its own shadow.
  vec3 shift = 0.022 * (spread - dot(spread, n) * n);
  vec3 radiance = vec3(0.0);
  for (int i = 0; i < LIGHTS; ++i) {
    float facing = dot(n, to_light[i]);
    if (facing > 0.0) {
      float shine = gloss[i] * pow(max(dot(n, normalize(view + to_light[i])), 0.0), 40.0);
      // The key, the only one that shines, is soft by itself.
      vec3 p = studio_position + 0.006 * n + (gloss[i] > 0.0 ? 0.3 : 1.0) * shift;
      radiance += light[i] * facing * lit(i, p) * (own + shine);
    }
  }
  result = vec4(radiance + share * 0.035 * own, share);
}
#endif
#endif
)";

constexpr char kCopyVertexShader[] = R"(
void main() {
  gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 2.0 * float(gl_VertexID & 2) - 1.0, 0.0, 1.0);
}
)";

constexpr char kCopyFragmentShader[] = R"(
uniform sampler2D source;
out vec4 result;
void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

/// One of the lights of a pass.
struct Light {
  Vector3 to_light;   ///< unit, studio frame
  Vector3 intensity;  ///< linear RGB, already divided by the number of its kind
  double gloss;       ///< strength of its highlight
};

/// Directions spread evenly over the ball (a Fibonacci lattice); `up` is their pole.
Vector3 sky_direction(int index, int count, const Eigen::Quaterniond& up_from_z) {
  const double z = 1.0 - (2.0 * index + 1.0) / count;
  const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double rho = std::sqrt(1.0 - z * z);
  return up_from_z * Vector3(rho * std::cos(angle), rho * std::sin(angle), z);
}

Light sky_light(int index, int count, const Eigen::Quaterniond& up_from_z) {
  const Vector3 to_light = sky_direction(index, count, up_from_z);
  const double height = to_light.dot(up_from_z * Vector3::UnitZ());
  const double t = 0.5 + 0.5 * height;
  // Above a cool sky, below the light that a bright floor gives back. A full even ball of light 1 gives
  // a surface 1 when the mean of max(0, cos) = 1/4 is made up for.
  const Vector3 radiance = (1.0 - t) * Vector3(0.26, 0.25, 0.24) + t * Vector3(0.60, 0.63, 0.68);
  return {to_light, 4.0 / count * radiance, 0.0};
}

/// A disc of light in the upper left behind the eye, spread as sunflower seeds are.
Light key_light(int index, int count, const Pose& studio_from_camera) {
  const double rho = 0.22 * std::sqrt((index + 0.5) / count);
  const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const Vector3 middle = Vector3(-0.55, 0.80, 0.62).normalized();
  const Vector3 side = middle.unitOrthogonal();
  const Vector3 spread = rho * (std::cos(angle) * side + std::sin(angle) * middle.cross(side));
  return {studio_from_camera.linear() * (middle + spread).normalized(), Vector3(0.92, 0.90, 0.86) / count,
          0.10};
}

using PassLights = std::array<Light, kLightsAPass>;

/// One light of the key and three of the sky for each pass, so that each pass is a fair sample.
std::vector<PassLights> make_lights(int passes, const Pose& studio_from_camera, const Vector3& up) {
  const auto up_from_z = base::rotation_between(Vector3::UnitZ(), up);
  constexpr int kSkyLights = kLightsAPass - 1;
  std::vector<PassLights> lights;
  for (int pass = 0; pass < passes; ++pass) {
    PassLights& own = lights.emplace_back();
    // The sky's lights are numbered from top to bottom: one from each third.
    for (int i = 0; i < kSkyLights; ++i) {
      own[static_cast<std::size_t>(i)] = sky_light(i * passes + pass, kSkyLights * passes, up_from_z);
    }
    own[kSkyLights] = key_light(pass, passes, studio_from_camera);
  }
  return lights;
}

/// The shift of pass `index` within the pixel, -0.5 ... 0.5 (the R2 sequence, Roberts 2018).
Eigen::Vector2d pixel_shift(int index) {
  constexpr double kPlastic = 1.32471795724474602596;
  const auto wrapped = [](double v) { return v - std::floor(v) - 0.5; };
  return {wrapped((index + 0.5) / kPlastic), wrapped((index + 0.5) / (kPlastic * kPlastic))};
}

Matrix4 shifted(const Matrix4& clip_from_studio, const Eigen::Vector2d& pixels,
                const StudioSettings& settings) {
  Matrix4 shift = Matrix4::Identity();
  shift(0, 3) = 2.0 * pixels.x() / settings.width;
  shift(1, 3) = 2.0 * pixels.y() / settings.height;
  return shift * clip_from_studio;
}

geometry::TriangleMesh floor_square(double height, const Vector3& up) {
  const Vector3 x = up.unitOrthogonal();
  const Vector3 y = up.cross(x);
  const Vector3 middle = height * up;
  const double side = kFloorReach;
  geometry::TriangleMesh square;
  square.positions = {middle - side * (x + y), middle + side * (x - y), middle + side * (x + y),
                      middle - side * (x - y)};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return square;
}

/// The buffers of a mesh.
struct ItemViews {
  MeshView view;
  std::optional<MeshView> caster;  ///< a coarser one that throws the shadows, for large meshes
};

/// A mesh ready to be drawn: its buffers, which others may share, and where they stand in the studio.
struct Item {
  std::shared_ptr<const ItemViews> views;
  Matrix4 studio_from_mesh;
  Matrix4 direction_from_buffer;  ///< turns normals
  Vector3 albedo;                 ///< linear RGB
};

Vector3 linear_rgb(const charts::Colour& colour) {
  return {base::linear_from_srgb(colour.red), base::linear_from_srgb(colour.green),
          base::linear_from_srgb(colour.blue)};
}

std::shared_ptr<const ItemViews> make_views(const StudioMesh& mesh) {
  std::optional<MeshView> caster;
  if (mesh.caster) caster.emplace(*mesh.caster);
  return std::make_shared<const ItemViews>(ItemViews{MeshView(mesh.seen), std::move(caster)});
}

Item make_item(std::shared_ptr<const ItemViews> views, const Matrix4& studio_from_mesh, const Pose& turn,
               const charts::Colour& colour) {
  Matrix4 direction = Matrix4::Identity();
  direction.topLeftCorner<3, 3>() = turn.linear();
  return {std::move(views), studio_from_mesh, direction, linear_rgb(colour)};
}

/// A CSG solid ready to be drawn.
struct SolidItem {
  CsgView view;
  Matrix4 studio_from_tree;
  Matrix4 direction_from_tree;  ///< turns normals
  charts::Colour colour;
};

struct Programs {
  GlObject depth, body, floor, copy;
  GlObject solid;  ///< none in a core context
};

base::Result<Programs> compile_programs(bool with_solids) {
  const std::string lights = fmt::format("#define LIGHTS {}\n", kLightsAPass);
  auto depth = compile_program(kVertexShader, kFragmentShader, "#define DEPTH_ONLY\n");
  if (!depth) return base::fail(depth.error().message);
  auto body = compile_program(kVertexShader, kFragmentShader, lights + "#define BODY\n");
  if (!body) return base::fail(body.error().message);
  auto floor = compile_program(kVertexShader, kFragmentShader, lights + "#define FLOOR\n");
  if (!floor) return base::fail(floor.error().message);
  auto copy = compile_program(kCopyVertexShader, kCopyFragmentShader, "");
  if (!copy) return base::fail(copy.error().message);
  Programs programs{std::move(*depth), std::move(*body), std::move(*floor), std::move(*copy), {}};
  if (with_solids) {
    auto solid = compile_program(kVertexShader, kFragmentShader, lights + "#define SOLID\n", "compatibility");
    if (!solid) return base::fail(solid.error().message);
    programs.solid = std::move(*solid);
  }
  return programs;
}

struct Target {
  GlObject colour, depth, frame;
};

/// `colour_format` or `depth_format` may be 0 for none.
base::Result<Target> make_frame_target(unsigned colour_format, unsigned depth_format, int width, int height) {
  Target target;
  if (colour_format) target.colour = make_target(colour_format, width, height);
  if (depth_format) target.depth = make_target(depth_format, width, height);
  auto frame = make_frame(colour_format ? &target.colour : nullptr, depth_format ? &target.depth : nullptr);
  if (!frame) return base::fail(frame.error().message);
  target.frame = std::move(*frame);
  return target;
}

/// The targets of drawing: the pass at hand, the sum of all, the shadow maps of the pass at hand, and
/// the sum of the floor's shadow.
struct Targets {
  Target pass, sum, shadow, floor;
  Target solid_shadow;  ///< one shadow map, of solids only
};

base::Result<Targets> make_targets(const StudioSettings& settings, int shadow_side) {
  auto pass = make_frame_target(GL_RGBA16F, GL_DEPTH24_STENCIL8, settings.width, settings.height);
  if (!pass) return base::fail(pass.error().message);
  auto sum = make_frame_target(GL_RGBA32F, 0, settings.width, settings.height);
  if (!sum) return base::fail(sum.error().message);
  auto shadow = make_frame_target(0, GL_DEPTH24_STENCIL8, kLightsAPass * shadow_side, shadow_side);
  if (!shadow) return base::fail(shadow.error().message);
  glBindTexture(GL_TEXTURE_2D, shadow->depth.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  auto floor = make_frame_target(GL_RGBA32F, 0, kFloorSide, kFloorSide);
  if (!floor) return base::fail(floor.error().message);
  auto solid_shadow = make_frame_target(0, GL_DEPTH24_STENCIL8, shadow_side, shadow_side);
  if (!solid_shadow) return base::fail(solid_shadow.error().message);
  return Targets{std::move(*pass), std::move(*sum), std::move(*shadow), std::move(*floor),
                 std::move(*solid_shadow)};
}

/// Fineness with which the light is sampled.
struct Sampling {
  int passes;
  int shadow_side;  ///< texels
};

/// Fewer passes for models that cost more; the picture stays good from 8 on. Shadow maps of solids cost more
/// than the rest of a pass, and solids tend to have holes, where the light of each sample shows: smaller maps
/// and more passes look better in the same time.
Sampling choose_sampling(const StudioSettings& settings, const StudioScene& scene,
                         std::size_t triangles_of_bodies) {
  double triangles = 1.0 + static_cast<double>(triangles_of_bodies);
  Sampling sampling{static_cast<int>(std::clamp(12.0 * 4e5 / triangles, 8.0, 12.0)), 1024};
  if (!scene.solids.empty()) {
    for (const StudioSolid& solid : scene.solids) {
      triangles += static_cast<double>(solid.geometry.triangle_count());
    }
    sampling = {static_cast<int>(std::clamp(24.0 * 6e4 / triangles, 10.0, 24.0)), 512};
  }
  if (settings.passes > 0) sampling.passes = std::clamp(settings.passes, 4, 64);
  if (settings.shadow_side > 0) sampling.shadow_side = std::clamp(settings.shadow_side, 64, 4096);
  return sampling;
}

/// Pixels of the picture, counted from the lower left as OpenGL does.
struct PixelBox {
  int x, y, width, height;
};

/// Everything of one picture, so that its stages need no long argument lists.
struct Studio {
  const StudioSettings& settings;
  Sampling sampling;
  Programs programs;
  Targets targets;
  std::vector<Item> items;
  std::vector<SolidItem> solids;
  Item floor;
  Matrix4 clip_from_studio;
  Matrix4 clip_from_floor;  ///< looks straight down on it
  Vector3 eye;
  PixelBox drawn;  ///< pixels in which the bodies can appear
  GlObject empty_arrays{GlObject::Kind::VertexArray};
};

void draw_depth(const Studio& studio, const Matrix4& clip_from_studio, bool coarse) {
  const GlObject& program = studio.programs.depth;
  glUseProgram(program.name());
  set_uniform(program, "clip_from_studio", clip_from_studio);
  for (const Item& item : studio.items) {
    const MeshView& view = coarse && item.views->caster ? *item.views->caster : item.views->view;
    set_uniform(program, "studio_from_buffer", Matrix4(item.studio_from_mesh * view.mesh_from_buffer()));
    view.draw();
  }
}

void draw_solids_depth(const Studio& studio, const Matrix4& clip_from_studio) {
  for (const SolidItem& solid : studio.solids) {
    solid.view.draw_depth(clip_from_studio * solid.studio_from_tree * solid.view.tree_from_buffer());
  }
}

using ShadowMatrices = std::array<Matrix4, kLightsAPass>;

ShadowMatrices shadow_matrices(const PassLights& lights) {
  ShadowMatrices matrices;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    matrices[i] = light_camera(-lights[i].to_light, Vector3::Zero(), 1.02).clip_from_world();
  }
  return matrices;
}

/// Solids are drawn by themselves and copied: images of CSG are made from pixel (0, 0) only.
void draw_solid_shadows(const Studio& studio, const ShadowMatrices& shadows) {
  const int side = studio.sampling.shadow_side;
  glViewport(0, 0, side, side);
  for (int i = 0; i < kLightsAPass; ++i) {
    glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.solid_shadow.frame.name());
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_solids_depth(studio, shadows[static_cast<std::size_t>(i)]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, studio.targets.shadow.frame.name());
    glBlitFramebuffer(0, 0, side, side, i * side, 0, (i + 1) * side, side, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  }
}

void draw_shadow_maps(const Studio& studio, const ShadowMatrices& shadows) {
  glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.shadow.frame.name());
  glClear(GL_DEPTH_BUFFER_BIT);
  if (!studio.solids.empty()) draw_solid_shadows(studio, shadows);
  glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.shadow.frame.name());
  const int side = studio.sampling.shadow_side;
  for (int i = 0; i < kLightsAPass; ++i) {
    glViewport(i * side, 0, side, side);
    draw_depth(studio, shadows[static_cast<std::size_t>(i)], true);
  }
}

/// One of the pictures that are averaged.
struct Pass {
  const PassLights& lights;
  const ShadowMatrices& shadows;
  int number;
  double share;
};

void set_lights(const GlObject& program, const Pass& pass) {
  glUseProgram(program.name());
  const PassLights& lights = pass.lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    set_uniform(program, fmt::format("shadow_from_studio[{}]", i).c_str(), pass.shadows[i]);
    set_uniform(program, fmt::format("to_light[{}]", i).c_str(), lights[i].to_light);
    set_uniform(program, fmt::format("light[{}]", i).c_str(), lights[i].intensity);
    set_uniform(program, fmt::format("gloss[{}]", i).c_str(), static_cast<float>(lights[i].gloss));
  }
  set_uniform(program, "shadow_map", 0);
  set_uniform(program, "pass_number", static_cast<float>(pass.number));
}

void draw_item(const GlObject& program, const Item& item) {
  const MeshView& view = item.views->view;
  set_uniform(program, "studio_from_buffer", Matrix4(item.studio_from_mesh * view.mesh_from_buffer()));
  set_uniform(program, "direction_from_buffer", item.direction_from_buffer);
  set_uniform(program, "albedo", item.albedo);
  view.draw();
}

void set_view(const Studio& studio, const GlObject& program, double share) {
  set_uniform(program, "eye", studio.eye);
  set_uniform(program, "share", static_cast<float>(share));
}

void draw_solid(const Studio& studio, const SolidItem& solid, const Matrix4& clip) {
  const GlObject& program = studio.programs.solid;
  const Matrix4 studio_from_buffer = solid.studio_from_tree * solid.view.tree_from_buffer();
  set_uniform(program, "studio_from_buffer", studio_from_buffer);
  set_uniform(program, "direction_from_buffer", solid.direction_from_tree);
  solid.view.shade(clip * studio_from_buffer, [&](const CsgFaces& faces) {
    set_uniform(program, "albedo", linear_rgb(faces.colour.value_or(solid.colour)));
    set_uniform(program, "facing_out", faces.subtracted ? -1.0F : 1.0F);
  });
}

void draw_bodies(const Studio& studio, const Matrix4& clip, const Pass& pass) {
  glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.pass.frame.name());
  glViewport(0, 0, studio.settings.width, studio.settings.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(studio.drawn.x, studio.drawn.y, studio.drawn.width, studio.drawn.height);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  // Before anything is shaded, so that bodies hide behind solids.
  draw_solids_depth(studio, clip);
  const GlObject& program = studio.programs.body;
  set_lights(program, pass);
  set_view(studio, program, pass.share);
  set_uniform(program, "clip_from_studio", clip);
  for (const Item& item : studio.items) draw_item(program, item);
  if (studio.solids.empty()) return;
  set_lights(studio.programs.solid, pass);
  set_view(studio, studio.programs.solid, pass.share);
  for (const SolidItem& solid : studio.solids) draw_solid(studio, solid, clip);
}

/// Lets all further drawing add to the target, whatever the depth.
void begin_adding(const Target& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.frame.name());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
}

void end_adding() {
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

void add_floor_shadow(const Studio& studio) {
  begin_adding(studio.targets.floor);
  glViewport(0, 0, kFloorSide, kFloorSide);
  set_uniform(studio.programs.floor, "clip_from_studio", studio.clip_from_floor);
  draw_item(studio.programs.floor, studio.floor);
  end_adding();
}

void add_to_sum(const Studio& studio) {
  begin_adding(studio.targets.sum);
  glUseProgram(studio.programs.copy.name());
  glBindTexture(GL_TEXTURE_2D, studio.targets.pass.colour.name());
  set_uniform(studio.programs.copy, "source", 0);
  glBindVertexArray(studio.empty_arrays.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  end_adding();
  glDisable(GL_SCISSOR_TEST);
}

void begin_sums(const Studio& studio) {
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glEnable(GL_DEPTH_TEST);
  glActiveTexture(GL_TEXTURE0);
  for (const Target* target : {&studio.targets.sum, &studio.targets.floor}) {
    glBindFramebuffer(GL_FRAMEBUFFER, target->frame.name());
    glClear(GL_COLOR_BUFFER_BIT);
  }
}

void accumulate(const Studio& studio, const std::vector<PassLights>& lights) {
  begin_sums(studio);
  const int passes = static_cast<int>(lights.size());
  for (int pass = 0; pass < passes; ++pass) {
    const PassLights& own = lights[static_cast<std::size_t>(pass)];
    const ShadowMatrices shadows = shadow_matrices(own);
    draw_shadow_maps(studio, shadows);
    const Pass stage{own, shadows, pass, 1.0 / passes};
    glBindTexture(GL_TEXTURE_2D, studio.targets.shadow.depth.name());
    set_lights(studio.programs.floor, stage);
    add_floor_shadow(studio);
    draw_bodies(studio, shifted(studio.clip_from_studio, pixel_shift(pass), studio.settings), stage);
    add_to_sum(studio);
  }
}

/// The floor's shadow, smoothed, and the places where the rays of the picture meet it.
class FloorShadow {
 public:
  FloorShadow(const Studio& studio, const Vector3& up)
      : dark_(static_cast<std::size_t>(kFloorSide) * kFloorSide),
        floor_from_clip_(studio.clip_from_studio.inverse()),
        clip_from_floor_(studio.clip_from_floor),
        up_(up),
        height_(studio.settings.floor / studio.settings.radius) {
    glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.floor.frame.name());
    glReadPixels(0, 0, kFloorSide, kFloorSide, GL_RED, GL_FLOAT, dark_.data());
    for (int i = 0; i < 3; ++i) {
      blur(1, kFloorSide);
      blur(kFloorSide, 1);
    }
  }

  /// The share of light missing where the picture's point (clip space, -1 ... 1) shows the floor.
  double at(double x, double y) const {
    const Vector3 near = (floor_from_clip_ * Eigen::Vector4d(x, y, -1.0, 1.0)).hnormalized();
    const Vector3 far = (floor_from_clip_ * Eigen::Vector4d(x, y, 1.0, 1.0)).hnormalized();
    const double fall = up_.dot(near - far);
    const double along = (up_.dot(near) - height_) / fall;
    if (!(along >= 0.0) || !(fall > 0.0)) return 0.0;
    const Vector3 point = near + along * (far - near);
    const double distance = (point - height_ * up_).norm();
    const double fade = std::clamp((2.3 - distance) / 1.5, 0.0, 1.0);
    if (fade == 0.0) return 0.0;
    const Vector3 seen = (clip_from_floor_ * point.homogeneous()).hnormalized();
    return 0.62 * fade * fade * (3.0 - 2.0 * fade) * sample(0.5 + 0.5 * seen.x(), 0.5 + 0.5 * seen.y());
  }

 private:
  /// A box filter along the lines whose neighbours lie `step` apart; three make nearly a Gaussian.
  void blur(std::size_t step, std::size_t next_line) {
    constexpr int kBlurReach = 4;
    std::array<float, kFloorSide> line;
    for (std::size_t start = 0; start < kFloorSide; ++start) {
      float* first = dark_.data() + start * next_line;
      for (std::size_t i = 0; i < kFloorSide; ++i) line[i] = first[i * step];
      for (int i = 0; i < kFloorSide; ++i) {
        float sum = 0.0F;
        for (int k = i - kBlurReach; k <= i + kBlurReach; ++k) {
          sum += line[static_cast<std::size_t>(std::clamp(k, 0, kFloorSide - 1))];
        }
        first[static_cast<std::size_t>(i) * step] = sum / (2 * kBlurReach + 1);
      }
    }
  }

  double sample(double u, double v) const {
    const double x = std::clamp(u * kFloorSide - 0.5, 0.0, kFloorSide - 1.001);
    const double y = std::clamp(v * kFloorSide - 0.5, 0.0, kFloorSide - 1.001);
    const std::size_t corner = static_cast<std::size_t>(y) * kFloorSide + static_cast<std::size_t>(x);
    const double s = x - std::floor(x);
    const double t = y - std::floor(y);
    return (1.0 - t) * ((1.0 - s) * dark_[corner] + s * dark_[corner + 1]) +
           t * ((1.0 - s) * dark_[corner + kFloorSide] + s * dark_[corner + kFloorSide + 1]);
  }

  std::vector<float> dark_;
  Matrix4 floor_from_clip_, clip_from_floor_;
  Vector3 up_;
  double height_;
};

std::uint8_t byte_of(double linear) {
  return static_cast<std::uint8_t>(std::lround(255.0 * base::srgb_from_linear(linear)));
}

/// The picture's background there, linear: even in the middle, toward the edge colour in the corners.
Vector3 background_at(const StudioSettings& settings, int x, int y) {
  const double u = 2.0 * (x + 0.5) / settings.width - 1.0;
  const double v = 2.0 * (y + 0.5) / settings.height - 1.0;
  const double t = std::clamp(0.5 * (u * u + v * v), 0.0, 1.0);
  return (1.0 - t) * linear_rgb(settings.background) + t * linear_rgb(settings.background_edge);
}

/// Reads the sum and lays it over the background with the floor's shadow.
charts::Image resolve(const Studio& studio) {
  const StudioSettings& settings = studio.settings;
  const auto columns = static_cast<std::size_t>(settings.width);
  std::vector<float> sum(4 * columns * static_cast<std::size_t>(settings.height));
  glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.sum.frame.name());
  glReadPixels(0, 0, settings.width, settings.height, GL_RGBA, GL_FLOAT, sum.data());
  const FloorShadow floor(studio, settings.up.normalized());
  charts::Image image{settings.width, settings.height, {}};
  image.rgba.reserve(sum.size());
  for (int y = 0; y < settings.height; ++y) {
    const float* row = sum.data() + 4 * columns * static_cast<std::size_t>(settings.height - 1 - y);
    for (int x = 0; x < settings.width; ++x, row += 4) {
      Vector3 light(row[0], row[1], row[2]);
      const double open = 1.0 - std::min(1.0F, row[3]);
      if (open > 0.0) {
        const double missing =
            floor.at(2.0 * (x + 0.5) / settings.width - 1.0, 1.0 - 2.0 * (y + 0.5) / settings.height);
        light += open * (1.0 - std::min(1.0, missing)) * background_at(settings, x, y);
      }
      for (int c = 0; c < 3; ++c) image.rgba.push_back(byte_of(light[c]));
      image.rgba.push_back(255);
    }
  }
  return image;
}

/// Distance of each pixel's surface, m along the view axis, from a pass without shift.
std::vector<float> measure_distance(const Studio& studio, const Camera& camera) {
  const int width = studio.settings.width;
  const int height = studio.settings.height;
  glBindFramebuffer(GL_FRAMEBUFFER, studio.targets.pass.frame.name());
  glViewport(0, 0, width, height);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_solids_depth(studio, studio.clip_from_studio);
  draw_depth(studio, studio.clip_from_studio, false);
  const auto columns = static_cast<std::size_t>(width);
  std::vector<float> depth(columns * static_cast<std::size_t>(height));
  glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  std::vector<float> distance(depth.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::size_t from_top = depth.size() / columns - 1 - i / columns;
    const float value = depth[from_top * columns + i % columns];
    if (value < 1.0F) distance[i] = static_cast<float>(distance_of_depth(camera, value));
  }
  return distance;
}

Matrix4 studio_from_world(const StudioSettings& settings) {
  Matrix4 m = Matrix4::Identity();
  m.topLeftCorner<3, 3>() /= settings.radius;
  m.topRightCorner<3, 1>() = -settings.centre / settings.radius;
  return m;
}

/// The pixels that the studio's ball of radius 1 can cover, from the cube around it.
PixelBox covered_pixels(const Matrix4& clip_from_studio, const StudioSettings& settings) {
  const base::Bounds box = device_box({Vector3::Constant(-1.0), Vector3::Constant(1.0)}, clip_from_studio);
  const auto pixel = [](double ndc, int size, double slack) {
    return static_cast<int>(std::clamp((0.5 + 0.5 * ndc) * size + slack, 0.0, static_cast<double>(size)));
  };
  const int left = pixel(box.min().x(), settings.width, -2.0);
  const int bottom = pixel(box.min().y(), settings.height, -2.0);
  return {left, bottom, pixel(box.max().x(), settings.width, 2.0) - left,
          pixel(box.max().y(), settings.height, 2.0) - bottom};
}

base::Result<std::vector<SolidItem>> make_solids(const std::vector<StudioSolid>& solids,
                                                 const Matrix4& to_studio) {
  std::vector<SolidItem> items;
  if (solids.empty()) return items;
  const auto images = CsgImages::create();
  if (!images) return base::fail(images.error().message);
  for (const StudioSolid& solid : solids) {
    Matrix4 direction = Matrix4::Identity();
    direction.topLeftCorner<3, 3>() = solid.world_from_tree.linear();
    items.push_back({CsgView(*images, solid.geometry), to_studio * solid.world_from_tree.matrix(), direction,
                     solid.colour});
  }
  return items;
}

struct DrawnBodies {
  std::vector<Item> items;
  std::size_t triangles;
};

DrawnBodies make_items(const std::vector<StudioBody>& bodies, const Camera& camera,
                       const StudioSettings& settings, const Matrix4& to_studio) {
  StudioMeshes made = make_studio_meshes(bodies, camera, settings.height, settings.crease_angle);
  std::vector<std::shared_ptr<const ItemViews>> views;
  for (StudioMesh& mesh : made.meshes) {
    views.push_back(make_views(mesh));
    mesh = {};
  }
  DrawnBodies drawn{{}, made.triangles};
  for (const StudioItem& it : made.items)
    drawn.items.push_back(
        make_item(views[it.mesh], to_studio * it.world_from_mesh.matrix(), it.world_from_mesh, it.colour));
  return drawn;
}

base::Result<Studio> make_studio(const StudioScene& scene, const Camera& camera,
                                 const StudioSettings& settings) {
  auto programs = compile_programs(!scene.solids.empty());
  if (!programs) return base::fail(programs.error().message);
  const Matrix4 to_studio = studio_from_world(settings);
  DrawnBodies bodies = make_items(scene.bodies, camera, settings, to_studio);
  const Sampling sampling = choose_sampling(settings, scene, bodies.triangles);
  auto targets = make_targets(settings, sampling.shadow_side);
  if (!targets) return base::fail(targets.error().message);
  auto solids = make_solids(scene.solids, to_studio);
  if (!solids) return base::fail(solids.error().message);
  const Vector3 up = settings.up.normalized();
  const double height = settings.floor / settings.radius;
  Item floor = make_item(make_views({make_shading_mesh(floor_square(height, up), 0.0), std::nullopt}),
                         Matrix4::Identity(), Pose::Identity(), {});
  const Matrix4 clip_from_floor = light_camera(-up, height * up, kFloorReach).clip_from_world();
  const Matrix4 clip_from_studio = camera.clip_from_world() * to_studio.inverse();
  const Vector3 eye = (camera.eye() - settings.centre) / settings.radius;
  return Studio{settings,
                sampling,
                std::move(*programs),
                std::move(*targets),
                std::move(bodies.items),
                std::move(*solids),
                std::move(floor),
                clip_from_studio,
                clip_from_floor,
                eye,
                covered_pixels(clip_from_studio, settings)};
}

}  // namespace

base::Result<StudioPicture> draw_studio(const Offscreen&, const StudioScene& scene, const Camera& camera,
                                        const StudioSettings& settings) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (settings.width < 1 || settings.height < 1 || settings.width > largest || settings.height > largest) {
    return base::fail(fmt::format("a picture of {}x{} cannot be drawn; sides go from 1 to {} pixels",
                                  settings.width, settings.height, largest));
  }
  const auto studio = make_studio(scene, camera, settings);
  if (!studio) return base::fail(studio.error().message);
  const Pose studio_from_camera(camera.camera_from_world.inverse());
  accumulate(*studio, make_lights(studio->sampling.passes, studio_from_camera, settings.up.normalized()));
  return StudioPicture{resolve(*studio), measure_distance(*studio, camera)};
}

}  // namespace icome::render
