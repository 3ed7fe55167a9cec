#include "render/scene/scene_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace icome::render {
namespace {

using base::Vector3;

constexpr double kCasterCell = 1.5;  // texels

void set_matrix(int slot, const Matrix4& value) {
  const Eigen::Matrix4f single = value.cast<float>();
  glUniformMatrix4fv(slot, 1, GL_FALSE, single.data());
}

void set_matrix(int slot, const base::Matrix3& value) {
  const Eigen::Matrix3f single = value.cast<float>();
  glUniformMatrix3fv(slot, 1, GL_FALSE, single.data());
}

void bind_picture(SceneBuffers& buffers, const SceneProgram& program, const RenderItem& item) {
  const auto& frame = item.material->picture_frame;
  std::array<float, 6> rows{};
  std::transform(frame.begin(), frame.end(), rows.begin(), [](double it) { return float(it); });
  glUniform3fv(program.picture_frame, 2, rows.data());
  glUniform1f(program.cutoff, item.material->cutoff);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, buffers.picture(item.material->picture));
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace

base::Result<SceneProgram*> ScenePass::use_lit(base::Result<SceneProgram*> program) const {
  if (!program) return program;
  glUseProgram((*program)->program.name());
  if ((*program)->set_up_for != serial_) lights_.set(**program);
  (*program)->set_up_for = serial_;
  return program;
}

void ScenePass::set_look(const SceneProgram& program, const PlannedItem& planned) {
  const RenderMaterial& look = *planned.item->material;
  set_matrix(program.camera_from_buffer, planned.camera_from_buffer);
  set_matrix(program.direction_from_buffer, planned.direction_from_buffer);
  glUniform4fv(program.diffuse, 1, body_colour(*planned.item).data());
  // VRML 2.0, 6.2.2: shininess times 128 is the exponent.
  const float exponent = std::max(1.0F, 128.0F * look.shininess);
  glUniform4f(program.specular, look.specular.x(), look.specular.y(), look.specular.z(), exponent);
  glUniform1f(program.metal, look.metal);
  glUniform3fv(program.emission, 1, look.emission.data());
  glUniform1f(program.ambient, look.ambient);
  lights_.set_groups(program, planned.item->object);
  glFrontFace(planned.mirrored ? GL_CW : GL_CCW);
}

void ScenePass::draw_surface(const SceneProgram& program, const PlannedItem& planned) {
  set_matrix(program.clip_from_buffer, Matrix4(clip_shift_ * planned.clip_from_buffer));
  set_look(program, planned);
  if (surface_kind(*planned.item).textured) bind_picture(buffers_, program, *planned.item);
  // Only where culling is off: blended items are drawn one side at a time.
  const bool hides_backs = !planned.item->material->double_sided && glIsEnabled(GL_CULL_FACE) == GL_FALSE;
  if (hides_backs) {
    glCullFace(GL_BACK);
    glEnable(GL_CULL_FACE);
  }
  buffers_.view(planned.item->shape, planned.level).draw();
  if (hides_backs) glDisable(GL_CULL_FACE);
}

base::Result<void> ScenePass::opaque(std::span<const PlannedItem> items) {
  SceneProgram* used = nullptr;
  SurfaceKind kind;
  std::vector<PlannedSolid> imaged;
  for (const PlannedItem& planned : items) {
    if (const CsgView* view = buffers_.solids().images(planned)) {
      imaged.push_back({&planned, view});
      continue;
    }
    const SurfaceKind own = surface_kind(*planned.item);
    if (!used || own != kind) {
      const auto program = use_lit(programs_.surface(own, lights_.kinds()));
      if (!program) return tl::unexpected(program.error());
      used = *program;
      kind = own;
    }
    draw_surface(*used, planned);
  }
  return solids(imaged);
}

base::Result<void> ScenePass::blended(std::span<const PlannedItem> items) {
  if (items.empty()) return {};
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  base::Result<void> done;
  for (const PlannedItem& planned : items) {
    if (const CsgView* view = buffers_.solids().images(planned)) {
      if (done) done = blended_solid({&planned, view});
      continue;
    }
    for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
      if (hidden == GL_FRONT && !planned.item->material->double_sided) continue;
      glCullFace(hidden);
      if (done) done = opaque({&planned, 1});
    }
  }
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  return done;
}

base::Result<void> ScenePass::ground(const MeshView& square, const Camera& camera, const Vector3& middle,
                                     double reach) {
  const auto program = use_lit(programs_.ground(lights_.kinds()));
  if (!program) return tl::unexpected(program.error());
  Matrix4 world_from_square = Matrix4::Identity();
  world_from_square.topLeftCorner<3, 3>() *= reach;
  world_from_square.topRightCorner<3, 1>() = middle;
  const Matrix4 camera_from_buffer =
      camera.camera_from_world.matrix() * world_from_square * square.mesh_from_buffer();
  set_matrix((*program)->clip_from_buffer,
             Matrix4(clip_shift_ * camera.clip_from_camera * camera_from_buffer));
  set_matrix((*program)->camera_from_buffer, camera_from_buffer);
  set_matrix((*program)->direction_from_buffer, base::Matrix3(camera.camera_from_world.linear()));
  set_uniform((*program)->program, "ground_middle", Vector3(camera.camera_from_world * middle));
  set_uniform((*program)->program, "ground_reach", float(reach));
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  square.draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  return {};
}

base::Result<void> ScenePass::draw_flat(std::span<const PlannedItem> items, const Eigen::Vector4f& colour) {
  for (const bool cut_out : {false, true}) {
    const auto program = programs_.flat(cut_out);
    if (!program) return tl::unexpected(program.error());
    glUseProgram((*program)->program.name());
    set_uniform((*program)->program, "picture", 1);
    glUniform4fv((*program)->diffuse, 1, colour.data());
    for (const PlannedItem& planned : items) {
      if (surface_kind(*planned.item).cut_out != cut_out) continue;
      set_matrix((*program)->clip_from_buffer, planned.clip_from_buffer);
      if (cut_out) bind_picture(buffers_, **program, *planned.item);
      buffers_.view(planned.item->shape, planned.level).draw();
    }
  }
  return {};
}

base::Result<void> ScenePass::mask(std::span<const PlannedItem> items) {
  std::vector<PlannedItem> meshes;
  std::vector<PlannedSolid> imaged;
  for (const PlannedItem& planned : items) {
    const CsgView* view = buffers_.solids().images(planned);
    if (view)
      imaged.push_back({&planned, view});
    else
      meshes.push_back(planned);
  }
  auto done = draw_flat(meshes, Eigen::Vector4f::Ones());
  return done ? mask_solids(imaged) : done;
}

base::Result<void> ScenePass::shadow_maps(const RenderScene& scene, const SceneCanvas& maps, int side) {
  glBindFramebuffer(GL_FRAMEBUFFER, maps.frame.name());
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_CLAMP);  // things between the light and the view throw their shadows all the same
  for (std::size_t i = 0; i < lights_.lenses().size(); ++i) {
    glViewport(GLint(i) * side, 0, side, side);
    const SceneDetail detail{double(side), kCasterCell};
    const std::vector<PlannedItem> casters = plan_casters(scene, lights_.lenses()[i], detail);
    auto drawn = draw_flat(casters, Eigen::Vector4f::Zero());
    if (drawn) drawn = cast_solids(casters, maps, int(i), side);
    if (!drawn) return drawn;
  }
  glDisable(GL_DEPTH_CLAMP);
  return {};
}

}  // namespace icome::render
