#include "render/pictures/touch_solid.h"

#include <fmt/format.h>

#include <utility>

#include "charts/length_text.h"
#include "render/csg/csg_cost.h"
#include "render/pictures/touch_view.h"

namespace icome::render {

base::Result<PreparedSolid> PreparedSolid::prepare(const TouchSolid& solid) {
  PreparedSolid prepared(solid);
  auto geometry = make_csg_geometry(solid.tree);
  if (geometry) {
    prepared.geometry_ = std::move(*geometry);
  } else {
    const auto taken = prepared.take_mesh(geometry.error().message);
    if (!taken) return base::fail(taken.error().message);
  }
  return prepared;
}

base::Result<void> PreparedSolid::take_mesh(const std::string& reason) {
  const TouchSolid& solid = solid_;
  if (!solid.mesh) {
    return base::fail(fmt::format("{} cannot be drawn without a mesh of it: {}", solid.name, reason));
  }
  auto mesh = solid.mesh();
  if (!mesh) return base::fail(mesh.error().message);
  mesh_ = std::move(*mesh);
  reason_ = reason;
  return {};
}

std::vector<base::Vector3> PreparedSolid::points() const {
  const TouchSolid& solid = solid_;
  if (mesh_) return model_points({{*mesh_, solid.world_from_tree, solid.colour}});
  std::vector<base::Vector3> points;
  points.reserve(geometry_->surface.size());
  for (const base::Vector3& point : geometry_->surface) points.push_back(solid.world_from_tree * point);
  return points;
}

base::Result<void> PreparedSolid::place(StudioScene& scene, const Offscreen& context, const Camera& camera,
                                        double pixels, const std::function<void(const std::string&)>& tell) {
  const TouchSolid& solid = solid_;
  if (!mesh_) {
    const Matrix4 clip_from_tree = camera.clip_from_world() * solid.world_from_tree.matrix();
    const auto reason = reason_against_images(context, *geometry_, clip_from_tree, pixels);
    const auto taken = reason ? take_mesh(*reason) : base::Result<void>();
    if (!taken) return base::fail(taken.error().message);
  }
  std::string how;
  if (mesh_) {
    scene.bodies.push_back({*mesh_, solid.world_from_tree, solid.colour});
    how = fmt::format("{} is drawn as a mesh of {} triangles: {}.", solid.name,
                      charts::grouped(mesh_->triangles.size()), reason_);
  } else {
    scene.solids.push_back({*geometry_, solid.world_from_tree, solid.colour});
    how = fmt::format("{} is drawn from images of its {} operands.", solid.name, geometry_->operand_count());
  }
  if (tell) tell(how);
  return {};
}

base::Result<std::vector<PreparedSolid>> prepare_solids(const std::vector<TouchSolid>& solids) {
  std::vector<PreparedSolid> prepared;
  prepared.reserve(solids.size());
  for (const TouchSolid& solid : solids) {
    auto own = PreparedSolid::prepare(solid);
    if (!own) return base::fail(own.error().message);
    prepared.push_back(std::move(*own));
  }
  return prepared;
}

}  // namespace icome::render
