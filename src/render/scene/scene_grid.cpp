#include "render/scene/scene_grid.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/srgb.h"
#include "render/scene/scene_renderer.h"

namespace icome::render {
namespace {

using base::Vector2;
using base::Vector3;

constexpr double kCellsAcross = 60.0;  // of the finest, across the view where they are seen best
constexpr double kReach = 14.0;        // times the distance to the place that is looked at

Eigen::Vector4f linear(const charts::Colour& colour) {
  return {float(base::linear_from_srgb(colour.red)), float(base::linear_from_srgb(colour.green)),
          float(base::linear_from_srgb(colour.blue)), float(colour.alpha)};
}

/// The rest of the place after whole steps: the shader has few digits.
Vector2 wrapped(const Vector2& place, double step) {
  return place - step * Vector2((place / step).array().floor());
}

}  // namespace

std::optional<GridPlan> plan_grid(const Camera& camera) {
  const Vector3 eye = camera.eye();
  const Vector3 ahead = -camera.camera_from_world.linear().row(2).transpose();
  const double height = std::abs(eye.y());
  // Distance to the plane along the view, but not to near the horizon.
  const double distance = height / std::max(std::abs(ahead.y()), 0.25);
  const double opening = 2.0 / camera.clip_from_camera.row(1).head<3>().norm();
  const double width = distance * opening;
  if (!eye.allFinite() || !std::isfinite(width) || !(width > 0.0)) return std::nullopt;
  GridPlan plan;
  const double decade = std::log10(width / kCellsAcross) + 1.0;
  plan.cell = std::pow(10.0, std::floor(decade));
  plan.fineness = decade - std::floor(decade);
  plan.middle = {eye.x(), eye.z()};
  plan.reach = kReach * distance;
  return plan;
}

SceneGrid::SceneGrid() {
  constexpr std::array<float, 12> kCorners = {-1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0, 1};
  glBindVertexArray(arrays_.name());
  glBindBuffer(GL_ARRAY_BUFFER, corners_.name());
  glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
}

base::Result<void> SceneGrid::draw(const SceneLook& look, const Camera& whole, const Camera& camera,
                                   const Matrix4& clip_shift, ScenePrograms& programs) {
  const auto plan = plan_grid(whole);
  if (!plan) return {};
  const auto program = programs.grid();
  if (!program) return tl::unexpected(program.error());
  const GlObject& name = (*program)->program;
  glUseProgram(name.name());
  Matrix4 world_from_square = Matrix4::Identity();
  world_from_square.topLeftCorner<3, 3>() *= plan->reach;
  world_from_square.topRightCorner<3, 1>() = Vector3(plan->middle.x(), 0.0, plan->middle.y());
  set_uniform(name, "clip_from_buffer", Matrix4(clip_shift * camera.clip_from_world() * world_from_square));
  set_uniform(name, "reach", float(plan->reach / plan->cell));
  set_uniform(name, "fineness", float(plan->fineness));
  const auto slot = [&](const char* uniform) { return glGetUniformLocation(name.name(), uniform); };
  const Eigen::Vector2f offset = (wrapped(plan->middle, 100.0 * plan->cell) / plan->cell).cast<float>();
  const Eigen::Vector2f origin = (-plan->middle / plan->cell).cast<float>();
  glUniform2fv(slot("offset"), 1, offset.data());
  glUniform2fv(slot("origin"), 1, origin.data());
  glUniform4fv(slot("colour"), 1, linear(look.grid_colour).data());
  glUniform4fv(slot("axis_colours[0]"), 1, linear(look.x_axis).data());
  glUniform4fv(slot("axis_colours[1]"), 1, linear(look.z_axis).data());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  // The grid reaches farther than the camera's depths are made for, and lies behind things that stand on it.
  glEnable(GL_DEPTH_CLAMP);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.0F, 4.0F);
  glBindVertexArray(arrays_.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDepthFunc(GL_LESS);
  glDisable(GL_DEPTH_CLAMP);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  return {};
}

}  // namespace icome::render
