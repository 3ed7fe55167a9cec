// Compares frames of a moving view, ours and Coin's, in one context.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "coin_frames.h"
#include "desktop_figures.h"
#include "frame_scenes.h"
#include "render/gl/offscreen.h"
#include "render/model/views.h"
#include "render/scene/scene_renderer.h"
#include "render/scene/scene_targets.h"
#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::benchmarks {
namespace {

using base::Affine3;
using base::Vector3;
using render::RenderScenePointer;

/// The value of a result that cannot fail, unless the benchmark is wrong.
template <typename Value>
Value must(base::Result<Value> result) {
  if (!result) {
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
  }
  if constexpr (!std::is_void_v<Value>) return std::move(*result);
}

struct FrameWorld {
  world::World world;
  world::IdSource ids;
  std::vector<world::ObjectId> objects;

  void add(world::GeometryPointer shape, const Vector3& at, const Vector3& colour) {
    const auto geometry = ids.next<world::GeometryId>();
    must(world::apply(world, world::CreateGeometry{geometry, std::move(shape)}));
    const auto material = ids.next<world::MaterialId>();
    world::Material look;
    look.diffuse = {float(colour.x()), float(colour.y()), float(colour.z())};
    must(world::apply(world, world::CreateMaterial{material, look}));
    const auto id = ids.next<world::ObjectId>();
    must(world::apply(world, world::CreateObject{id,
                                                 world.roots().size(),
                                                 {.name = "solid",
                                                  .parent = {},
                                                  .parent_from_object = Affine3(Eigen::Translation3d(at)),
                                                  .geometry = geometry}}));
    must(world::apply(world, world::ChooseMaterial{id, material}));
    objects.push_back(id);
  }
};

world::GeometryPointer shape_of(FrameSolid::Kind kind) {
  constexpr double kHalf = 0.5 * kSolidSize;
  using world::PrimitiveGeometry;
  switch (kind) {
    case FrameSolid::Kind::Box:
      return std::make_shared<PrimitiveGeometry>(geometry::Box{Vector3::Constant(kHalf)});
    case FrameSolid::Kind::Ball:
      return std::make_shared<PrimitiveGeometry>(geometry::Sphere{kHalf});
    case FrameSolid::Kind::Cylinder:
      return std::make_shared<PrimitiveGeometry>(geometry::Cylinder{kHalf, kSolidSize});
    case FrameSolid::Kind::Cone:
      break;
  }
  return std::make_shared<PrimitiveGeometry>(geometry::Cone{kHalf, 0.0, kSolidSize});
}

/// Direction to the eye, which goes round the scene, a little further each frame.
Vector3 toward_eye(int frame) {
  const double angle = 0.5 + 0.02 * frame;
  return {std::sin(angle), 0.5, std::cos(angle)};
}

/// The frame that both renderers draw into.
class FrameTarget {
 public:
  explicit FrameTarget(const DesktopExtent& extent) : extent_(extent) {
    must(canvas_.fit(extent.width, extent.height, GL_RGBA8, GL_DEPTH24_STENCIL8));
  }
  render::SceneTarget ours() const { return {canvas_.frame.name(), extent_.width, extent_.height, {}}; }

  /// Median CPU time of a frame, ms; the first ones, which make and upload things, do not count.
  double median(const std::function<void(int)>& draw) const {
    constexpr int kFirst = 2;
    std::vector<double> times;
    for (int frame = 0; frame < extent_.frames + kFirst; ++frame) {
      const double begin = cpu_milliseconds();
      draw(frame);
      glFinish();
      if (frame >= kFirst) times.push_back(cpu_milliseconds() - begin);
    }
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return times[times.size() / 2];
  }

  double coins(CoinFrames& coin, const Vector3& moved) const {
    return median([&](int frame) {
      coin.move_all(moved);
      glBindFramebuffer(GL_FRAMEBUFFER, canvas_.frame.name());
      glUseProgram(0);
      glBindVertexArray(0);
      glEnable(GL_DEPTH_TEST);
      glClearColor(0.8F, 0.8F, 0.8F, 1.0F);
      glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      coin.draw(toward_eye(frame), extent_.width, extent_.height);
    });
  }

 private:
  const DesktopExtent& extent_;
  render::SceneCanvas canvas_;
};

struct OurFrames {
  const FrameTarget& target;
  double aspect;
  render::SceneRenderer renderer = {};

  double still(const RenderScenePointer& scene, bool shadows) {
    return target.median([&](int frame) { draw(*scene, shadows, frame); });
  }
  void draw(const render::RenderScene& scene, bool shadows, int frame) {
    render::SceneLook look;
    look.shadows = shadows;
    const render::ViewDirection from{"", toward_eye(frame), Vector3::UnitY()};
    must(renderer.draw(scene, render::fit_scene(scene, from, aspect), look, target.ours()));
  }
};

std::vector<DesktopRow> object_rows(const DesktopExtent& extent, const FrameTarget& target, OurFrames& ours) {
  const std::vector<FrameSolid> solids = frame_solids(extent.objects);
  FrameWorld it;
  for (const FrameSolid& solid : solids) it.add(shape_of(solid.kind), solid.at, solid.colour);
  CoinFrames coin(solids);
  const double coin_still = target.coins(coin, Vector3::Zero());
  const double coin_moving = target.coins(coin, Vector3(1e-4, 0.0, 0.0));
  render::ScenePublisher publisher;
  RenderScenePointer scene = publisher.publish(it.world);
  const double plain = ours.still(scene, false), shadow = ours.still(scene, true);
  double publishing = 0.0;
  const auto moving = [&](bool shadows) {
    publishing = 0.0;
    return target.median([&](int frame) {
      const double begin = cpu_milliseconds();
      world::Changes changes;
      for (std::size_t i = 0; i < solids.size(); ++i) {
        const Vector3 at = solids[i].at + Vector3(1e-4 * frame, 0.0, 0.0);
        const world::PlaceObject edit{it.objects[i], Affine3(Eigen::Translation3d(at))};
        must(world::apply(it.world, edit));
        changes.objects.push_back(it.objects[i]);
      }
      scene = publisher.update(it.world, changes);
      publishing = cpu_milliseconds() - begin;
      ours.draw(*scene, shadows, frame);
    });
  };
  const double moving_plain = moving(false), moving_shadow = moving(true);
  const std::string name = fmt::format("{} objects", extent.objects);
  return {{.figure = name + ", the view moves", .value = plain, .times_of = coin_still, .of = "Coin's"},
          {.figure = name + ", the view moves, with shadow",
           .value = shadow,
           .times_of = coin_still,
           .of = "Coin's, without"},
          {.figure = "peer: Coin", .value = coin_still},
          {.figure = name + ", all move", .value = moving_plain, .times_of = coin_moving, .of = "Coin's"},
          {.figure = name + ", all move, with shadow",
           .value = moving_shadow,
           .times_of = coin_moving,
           .of = "Coin's, without"},
          {.figure = "peer: Coin, all move", .value = coin_moving},
          {.figure = "of it: edits and a new version to draw, by another thread", .value = publishing}};
}

std::vector<DesktopRow> mesh_rows(const DesktopExtent& extent, const FrameTarget& target, OurFrames& ours) {
  const geometry::TriangleMesh mesh = frame_mesh(extent.rows);
  FrameWorld it;
  it.add(std::make_shared<world::MeshGeometry>(mesh), Vector3::Zero(), {0.7, 0.6, 0.5});
  const RenderScenePointer scene = render::ScenePublisher().publish(it.world);
  CoinFrames coin(mesh);
  const double coins = target.coins(coin, Vector3::Zero());
  const std::string name = fmt::format("a mesh of {} triangles", mesh.triangles.size());
  return {{.figure = name, .value = ours.still(scene, false), .times_of = coins, .of = "Coin's"},
          {.figure = name + ", with shadow",
           .value = ours.still(scene, true),
           .times_of = coins,
           .of = "Coin's, without"},
          {.figure = "peer: Coin", .value = coins}};
}

}  // namespace

std::vector<DesktopSection> frame_figures(const DesktopExtent& extent) {
  const auto context = must(render::Offscreen::create());
  const FrameTarget target(extent);
  OurFrames ours{target, double(extent.width) / extent.height};
  const RenderScenePointer nothing = render::ScenePublisher().publish({});
  DesktopSection section{fmt::format("CPU time of a frame of {} x {} in one pass, by {}", extent.width,
                                     extent.height, context.renderer()),
                         {{.figure = "nothing but the background", .value = ours.still(nothing, true)}}};
  for (const auto& rows : {object_rows, mesh_rows}) {
    for (DesktopRow& row : rows(extent, target, ours)) section.rows.push_back(std::move(row));
  }
  return {section};
}

}  // namespace icome::benchmarks
