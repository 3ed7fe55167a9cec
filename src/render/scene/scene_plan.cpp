#include "render/scene/scene_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace icome::render {
namespace {

using base::Bounds;
using base::Matrix3;
using base::Vector3;

constexpr float kLeastAlpha = 1.0F / 512.0F;  // less is not seen

/// The sides of a camera's view, to tell which boxes are outside.
class ViewSides {
 public:
  /// `also_nearer`: things before the nearest plane count as inside, too, as they do for light.
  ViewSides(const Matrix4& clip_from_world, bool also_nearer) {
    std::size_t n = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        if (also_nearer && axis == 2 && sign > 0.0) continue;
        sides_[n++] = clip_from_world.row(3) + sign * clip_from_world.row(axis);
      }
    }
    count_ = n;
  }

  bool may_see(const Bounds& box) const {
    if (box.isEmpty()) return false;
    const Vector3 centre = 0.5 * (box.min() + box.max());
    const Vector3 half = 0.5 * (box.max() - box.min());
    for (std::size_t i = 0; i < count_; ++i) {
      const Vector3 normal = sides_[i].head<3>().transpose();
      // Written so that a box with NaN counts as seen.
      if (normal.dot(centre) + normal.cwiseAbs().dot(half) + sides_[i][3] < 0.0) return false;
    }
    return true;
  }

 private:
  std::array<Eigen::RowVector4d, 6> sides_;
  std::size_t count_ = 0;
};

bool is_textured(const RenderItem& item) {
  return item.material->picture && !item.shape->picture_places.empty();
}

/// Pixels that a unit of the buffers' frame takes where the object is nearest; infinite where the eye may be
/// in it.
double pixels_a_unit(const PlannedItem& planned, const Camera& camera, double height) {
  const Bounds& box = planned.item->bounds;
  const double metre =
      pixels_a_metre(camera, 0.5 * (box.min() + box.max()), 0.5 * box.sizes().norm(), height);
  return metre * planned.camera_from_buffer.topLeftCorner<3, 3>().colwise().norm().maxCoeff();
}

/// The coarsest level that is fine enough.
int level_for(const RenderShape& shape, double pixels, double cell) {
  std::size_t fine_enough = 0;
  while (fine_enough < shape.coarser.size() && shape.coarser[fine_enough].cell * pixels <= cell)
    ++fine_enough;
  return kFullLevel + int(fine_enough);
}

std::size_t triangles_of(const RenderShape& shape, int level) {
  return level == kFullLevel ? shape.triangle_count()
                             : shape.coarser[std::size_t(level)].mesh.indices.size() / 3;
}

void choose_levels(std::initializer_list<std::vector<PlannedItem>*> lists, const Camera& camera,
                   const SceneDetail& detail) {
  if (!(detail.height > 0.0)) return;
  constexpr double kCoarsestCell = 6.0;  // pixels
  double cell = detail.cell;
  for (std::size_t triangles = 0;; cell *= 1.5, triangles = 0) {
    for (std::vector<PlannedItem>* list : lists) {
      for (PlannedItem& it : *list) {
        const RenderShape& shape = *it.item->shape;
        if (!shape.coarser.empty() && !is_textured(*it.item))
          it.level = level_for(shape, pixels_a_unit(it, camera, detail.height), cell);
        triangles += triangles_of(shape, it.level);
      }
    }
    if (triangles <= detail.most_triangles || cell * 1.5 > kCoarsestCell) return;
  }
}

/// Normals are turned by the cofactors: as the inverse transposed, but also where a shape is flat.
Matrix3 cofactors(const Matrix3& m) {
  Matrix3 c;
  c.col(0) = m.col(1).cross(m.col(2));
  c.col(1) = m.col(2).cross(m.col(0));
  c.col(2) = m.col(0).cross(m.col(1));
  return c;
}

template <typename Visit>
void visit_seen(const RenderScene& scene, const ViewSides& sides, Visit&& visit) {
  for (const auto& block : scene.blocks()) {
    if (!sides.may_see(block->bounds)) continue;
    for (const RenderItem& item : block->items) {
      if (item.shape && body_colour(item).w() > kLeastAlpha && sides.may_see(item.bounds)) visit(item);
    }
  }
}

}  // namespace

SurfaceKind surface_kind(const RenderItem& item) {
  const RenderMaterial& look = *item.material;
  const bool textured = is_textured(item);
  return {.textured = textured,
          .coloured = !item.shape->colours.empty() && !(textured && look.picture_replaces_colour),
          .cut_out = textured && look.opacity == PictureOpacity::CutOut,
          .shiny = (look.specular.maxCoeff() > 0.0F || look.metal > 0.0F) && !look.unlit,
          .blended = is_blended(item),
          .unlit = look.unlit};
}

bool is_blended(const RenderItem& item) {
  if (body_colour(item).w() < 1.0F - kLeastAlpha) return true;
  return is_textured(item) && item.material->opacity == PictureOpacity::Blended;
}

Eigen::Vector4f body_colour(const RenderItem& item) {
  const RenderMaterial& look = *item.material;
  Eigen::Vector4f colour(look.diffuse.x(), look.diffuse.y(), look.diffuse.z(), look.alpha);
  if (!is_textured(item)) return colour;
  if (look.picture_replaces_colour) colour.head<3>().setOnes();
  if (look.picture_replaces_alpha) colour.w() = 1.0F;
  return colour;
}

PlannedItem plan_item(const RenderItem& item, const Camera& camera) {
  const ShadingMesh& mesh = item.shape->mesh;
  Matrix4 object_from_buffer = Matrix4::Identity();
  object_from_buffer.topLeftCorner<3, 3>() *= mesh.radius;
  object_from_buffer.topRightCorner<3, 1>() = mesh.centre;
  PlannedItem planned;
  planned.item = &item;
  planned.camera_from_buffer =
      camera.camera_from_world.matrix() * item.world_from_object.matrix() * object_from_buffer;
  planned.clip_from_buffer = camera.clip_from_camera * planned.camera_from_buffer;
  planned.mirrored = item.is_mirrored();
  const Matrix3 turn = planned.camera_from_buffer.topLeftCorner<3, 3>();
  const double size = turn.cwiseAbs().maxCoeff();
  planned.direction_from_buffer = cofactors(turn / (size > 0.0 ? size : 1.0));
  if (planned.mirrored) planned.direction_from_buffer *= -1.0;
  const Vector3 middle = 0.5 * (item.bounds.min() + item.bounds.max());
  planned.distance = (camera.camera_from_world * middle).norm();
  return planned;
}

ScenePlan plan_scene(const RenderScene& scene, const Camera& camera, const SceneDetail& detail) {
  ScenePlan plan;
  visit_seen(scene, ViewSides(camera.clip_from_world(), false), [&](const RenderItem& item) {
    (is_blended(item) ? plan.blended : plan.opaque).push_back(plan_item(item, camera));
  });
  choose_levels({&plan.opaque, &plan.blended}, camera, detail);
  std::sort(plan.opaque.begin(), plan.opaque.end(), [](const PlannedItem& a, const PlannedItem& b) {
    const SurfaceKind one = surface_kind(*a.item), other = surface_kind(*b.item);
    return one != other ? one < other : a.distance < b.distance;
  });
  std::sort(plan.blended.begin(), plan.blended.end(),
            [](const PlannedItem& a, const PlannedItem& b) { return a.distance > b.distance; });
  return plan;
}

std::vector<PlannedItem> plan_casters(const RenderScene& scene, const Camera& lens,
                                      const SceneDetail& detail) {
  std::vector<PlannedItem> casters;
  visit_seen(scene, ViewSides(lens.clip_from_world(), true), [&](const RenderItem& item) {
    if (!is_blended(item)) casters.push_back(plan_item(item, lens));
  });
  choose_levels({&casters}, lens, detail);
  return casters;
}

Bounds visible_bounds(const RenderScene& scene, const Camera& camera) {
  Bounds visible;
  visit_seen(scene, ViewSides(camera.clip_from_world(), false),
             [&](const RenderItem& item) { visible.extend(item.bounds); });
  return visible;
}

Camera windowed(const Camera& camera, const PictureWindow& window) {
  Matrix4 enlarge = Matrix4::Identity();
  enlarge(0, 0) = 1.0 / window.width;
  enlarge(1, 1) = 1.0 / window.height;
  enlarge(0, 3) = (1.0 - 2.0 * window.left) / window.width - 1.0;
  enlarge(1, 3) = (1.0 - 2.0 * window.bottom) / window.height - 1.0;
  Camera part = camera;
  part.clip_from_camera = enlarge * camera.clip_from_camera;
  return part;
}

}  // namespace icome::render
