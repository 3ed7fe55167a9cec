#include "render/scene/scene_markers.h"

#include <epoxy/gl.h>

#include <cmath>
#include <memory>

#include "base/decompositions.h"
#include "base/srgb.h"
#include "world/shape/solid_geometry.h"

namespace icome::render {
namespace {

using base::Affine3;
using base::Vector3;

constexpr float kHiddenAlpha = 0.22F;  // of parts that lie behind something

RenderShapePointer marker_shape(const geometry::Primitive& primitive) {
  auto made = make_render_shape(world::PrimitiveGeometry(primitive));
  return made ? *made : std::make_shared<const RenderShape>();
}

Eigen::Vector3f linear_colour(const charts::Colour& colour) {
  return {float(base::linear_from_srgb(colour.red)), float(base::linear_from_srgb(colour.green)),
          float(base::linear_from_srgb(colour.blue))};
}

/// Shines a little by itself, so that it is seen in the dark.
std::shared_ptr<const RenderMaterial> marker_look(const charts::Colour& colour, float alpha) {
  RenderMaterial look;
  look.diffuse = 0.7F * linear_colour(colour);
  look.emission = 0.4F * linear_colour(colour);
  look.alpha = alpha * float(colour.alpha);
  return std::make_shared<const RenderMaterial>(look);
}

RenderItem marker_item(const RenderShapePointer& shape, const Affine3& place,
                       const std::shared_ptr<const RenderMaterial>& look) {
  return {{}, shape, look, place, shape->bounds.transformed(place)};
}

/// Brings a primitive of length 1 along z, centred, to one from `from` to `to`.
Affine3 stretched(const Vector3& from, const Vector3& to, double radius) {
  const Vector3 along = to - from;
  const double length = along.norm();
  Affine3 place = Affine3::Identity();
  place.linear() = base::rotation_between(Vector3::UnitZ(), along).toRotationMatrix() *
                   Vector3(radius, radius, length).asDiagonal();
  place.translation() = 0.5 * (from + to);
  return place;
}

std::vector<RenderItem> copied_items(const std::vector<SceneOverlay::Copy>& copies) {
  std::vector<RenderItem> items;
  for (const SceneOverlay::Copy& copy : copies) {
    if (!copy.scene || !copy.world_from_scene.matrix().allFinite()) continue;
    copy.scene->for_each([&](const RenderItem& item) {
      const Affine3 place = copy.world_from_scene * item.world_from_object;
      items.push_back({{}, item.shape, item.material, place, item.shape->bounds.transformed(place)});
    });
  }
  return items;
}

std::vector<PlannedItem> plan_all(const std::vector<RenderItem>& items, const Camera& camera) {
  std::vector<PlannedItem> planned;
  planned.reserve(items.size());
  for (const RenderItem& item : items) planned.push_back(plan_item(item, camera));
  return planned;
}

/// A frame for buffers in single precision round the points; false: there is none that is finite.
bool frame_points(const std::vector<Vector3>& points, ShadingMesh& mesh) {
  base::Bounds box;
  for (const Vector3& it : points) {
    if (it.allFinite()) box.extend(it);
  }
  if (box.isEmpty()) return false;
  mesh.centre = 0.5 * (box.min() + box.max());
  mesh.radius = std::max(0.5 * box.sizes().norm(), 1e-300);
  return true;
}

Eigen::Vector3f in_frame(const ShadingMesh& mesh, const Vector3& point) {
  return ((point - mesh.centre) / mesh.radius).cast<float>();
}

/// Four corners a dot, as the dot shader wants them: the place and the corner. Dots are moved nearer to the
/// eye, so that surfaces on which they lie do not cut them.
ShadingMesh dot_mesh(std::vector<Vector3> points, const Vector3& eye) {
  constexpr double kNearer = 0.004;  // of the distance
  for (Vector3& it : points) it += kNearer * (eye - it);
  ShadingMesh mesh;
  if (!frame_points(points, mesh)) return mesh;
  for (const Vector3& it : points) {
    if (!it.allFinite()) continue;
    const Eigen::Vector3f at = in_frame(mesh, it);
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const float x : {-1.0F, 1.0F}) {
      for (const float y : {-1.0F, 1.0F}) mesh.vertices.push_back({at, Eigen::Vector3f(x, y, 0.0F)});
    }
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
  }
  return mesh;
}

/// Four corners a stretch, as the line shader wants them: the place and the other end.
ShadingMesh line_mesh(const std::vector<Vector3>& points) {
  ShadingMesh mesh;
  if (!frame_points(points, mesh)) return mesh;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i - 1].allFinite() || !points[i].allFinite()) continue;
    const Eigen::Vector3f from = in_frame(mesh, points[i - 1]), to = in_frame(mesh, points[i]);
    const auto first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{from, to}, {from, to}, {to, from}, {to, from}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
  }
  return mesh;
}

}  // namespace

void SceneMarkers::make_shapes() {
  if (ball_) return;
  ball_ = marker_shape(geometry::Sphere{1.0});
  shaft_ = marker_shape(geometry::Cylinder{1.0, 1.0});
  head_ = marker_shape(geometry::Cone{1.0, 0.0, 1.0});
}

std::vector<RenderItem> SceneMarkers::items_of(const SceneOverlay& overlay, float alpha) const {
  std::vector<RenderItem> items;
  for (const SceneOverlay::Ball& it : overlay.balls) {
    if (!it.centre.allFinite() || !(it.radius > 0.0)) continue;
    items.push_back(marker_item(ball_, Eigen::Translation3d(it.centre) * Eigen::Scaling(it.radius),
                                marker_look(it.colour, alpha)));
  }
  for (const SceneOverlay::Arrow& it : overlay.arrows) {
    const double length = (it.to - it.from).norm();
    if (!std::isfinite(length) || !(length > 0.0) || !(it.radius > 0.0)) continue;
    const auto look = marker_look(it.colour, alpha);
    const double head = std::min(7.0 * it.radius, length);
    const Vector3 neck = it.to - head / length * (it.to - it.from);
    if (head < length) items.push_back(marker_item(shaft_, stretched(it.from, neck, it.radius), look));
    items.push_back(marker_item(head_, stretched(neck, it.to, 2.6 * it.radius), look));
  }
  return items;
}

base::Result<void> SceneMarkers::draw_lines(const SceneOverlay& overlay, const Camera& camera,
                                            ScenePrograms& programs, const SceneTarget& target, float alpha) {
  const auto program = programs.line();
  if (!program) return tl::unexpected(program.error());
  glUseProgram((*program)->program.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  for (const SceneOverlay::Line& line : overlay.lines) {
    const ShadingMesh mesh = line_mesh(line.points);
    if (mesh.indices.empty()) continue;
    const MeshView view(mesh);
    set_uniform((*program)->program, "clip_from_buffer",
                Matrix4(camera.clip_from_world() * view.mesh_from_buffer()));
    glUniform2f(glGetUniformLocation((*program)->program.name(), "half_width"),
                float(line.width / target.width), float(line.width / target.height));
    const Eigen::Vector3f colour = alpha * float(line.colour.alpha) * linear_colour(line.colour);
    glUniform4f((*program)->diffuse, colour.x(), colour.y(), colour.z(), alpha * float(line.colour.alpha));
    view.draw();
  }
  glDisable(GL_BLEND);
  return {};
}

base::Result<void> SceneMarkers::draw_dots(const SceneOverlay& overlay, const Camera& camera,
                                           ScenePrograms& programs, const SceneTarget& target, float alpha) {
  if (overlay.dots.empty()) return {};
  const auto program = programs.dot();
  if (!program) return tl::unexpected(program.error());
  glUseProgram((*program)->program.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const Vector3 eye = camera.eye();
  for (const SceneOverlay::Dots& dots : overlay.dots) {
    const ShadingMesh mesh = dot_mesh(dots.points, eye);
    if (mesh.indices.empty()) continue;
    const MeshView view(mesh);
    set_uniform((*program)->program, "clip_from_buffer",
                Matrix4(camera.clip_from_world() * view.mesh_from_buffer()));
    glUniform2f(glGetUniformLocation((*program)->program.name(), "half_width"),
                float(dots.width / target.width), float(dots.width / target.height));
    const float shown = alpha * float(dots.colour.alpha);
    const Eigen::Vector3f colour = shown * linear_colour(dots.colour);
    glUniform4f((*program)->diffuse, colour.x(), colour.y(), colour.z(), shown);
    view.draw();
  }
  glDisable(GL_BLEND);
  return {};
}

base::Result<void> SceneMarkers::draw(const SceneOverlay& overlay, const Camera& camera, ScenePass& pass,
                                      ScenePrograms& programs, const SceneTarget& target) {
  if (overlay.balls.empty() && overlay.arrows.empty() && overlay.lines.empty() && overlay.dots.empty() &&
      overlay.copies.empty())
    return {};
  make_shapes();
  if (!overlay.copies.empty()) {
    const std::vector<RenderItem> copied = copied_items(overlay.copies);
    if (auto drawn = pass.opaque(plan_all(copied, camera)); !drawn) return drawn;
  }
  // Hidden parts first, before markers hide each other.
  glDepthFunc(GL_GREATER);
  const std::vector<RenderItem> faint = items_of(overlay, kHiddenAlpha);
  auto done = pass.blended(plan_all(faint, camera));
  glDepthMask(GL_FALSE);
  if (done) done = draw_lines(overlay, camera, programs, target, kHiddenAlpha);
  if (done) done = draw_dots(overlay, camera, programs, target, kHiddenAlpha);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  if (!done) return done;
  const std::vector<RenderItem> items = items_of(overlay, 1.0F);
  done = pass.opaque(plan_all(items, camera));
  if (done) done = draw_lines(overlay, camera, programs, target, 1.0F);
  if (done) done = draw_dots(overlay, camera, programs, target, 1.0F);
  return done;
}

}  // namespace icome::render
