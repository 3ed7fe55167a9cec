#include "render/scene/scene_pass_lights.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace icome::render {
namespace {

using base::Vector3;

constexpr int kSkySamples = 3;  // a pass

int slot_of(const SceneProgram& program, const char* name) {
  return glGetUniformLocation(program.program.name(), name);
}

void set_all(const SceneProgram& program, const char* name, const std::vector<float>& values) {
  if (!values.empty()) glUniform1fv(slot_of(program, name), GLsizei(values.size()), values.data());
}

void set_all(const SceneProgram& program, const char* name, const std::vector<Eigen::Vector2f>& values) {
  if (!values.empty()) glUniform2fv(slot_of(program, name), GLsizei(values.size()), values[0].data());
}

void set_all(const SceneProgram& program, const char* name, const std::vector<Eigen::Vector3f>& values) {
  if (!values.empty()) glUniform3fv(slot_of(program, name), GLsizei(values.size()), values[0].data());
}

void set_all(const SceneProgram& program, const char* name, const std::vector<Eigen::Vector4f>& values) {
  if (!values.empty()) glUniform4fv(slot_of(program, name), GLsizei(values.size()), values[0].data());
}

void set_all(const SceneProgram& program, const char* name, const std::vector<Eigen::Matrix4f>& values) {
  if (values.empty()) return;
  glUniformMatrix4fv(slot_of(program, name), GLsizei(values.size()), GL_FALSE, values[0].data());
}

}  // namespace

ScenePassLights::ScenePassLights(const SceneLights& lights, const Camera& camera,
                                 const std::optional<ShadowRegion>& shadows, int shadow_side, PassNumber pass,
                                 bool toned)
    : camera_(camera), seed_(float(pass.index)) {
  add_suns(lights, pass);
  add_lamps(lights);
  const bool sampled = shadows && lights.shadowed && pass.count > 1;
  add_sky(lights.sky, sampled, pass);
  if (shadows && lights.shadowed) add_shadows(*shadows, shadow_side);
  kinds_.toned = toned;
}

void ScenePassLights::add_suns(const SceneLights& lights, PassNumber pass) {
  for (const SunLight& sun : lights.suns) {
    const Vector3 to_light = sun_direction(sun, pass.index, pass.count);
    if (to_sun_.empty()) shadow_directions_.push_back(to_light);
    to_sun_.emplace_back((camera_.camera_from_world.linear() * to_light).cast<float>());
    sun_light_.push_back(sun.light);
    sun_ambient_.push_back(sun.ambient);
    sun_gloss_.push_back(sun.gloss);
    sun_groups_.push_back(sun.group);
    if (sun.group) kinds_.groups = true;
    if (sun.ambient.maxCoeff() > 0.0F) kinds_.ambient = true;
  }
  kinds_.suns = int(lights.suns.size());
  kinds_.gloss = !lights.suns.empty() && lights.suns.front().gloss > 0.0F;
}

void ScenePassLights::add_lamps(const SceneLights& lights) {
  for (const LampLight& lamp : lights.lamps) {
    lamp_at_.emplace_back((camera_.camera_from_world * lamp.at).cast<float>());
    lamp_light_.push_back(lamp.light);
    lamp_ambient_.push_back(lamp.ambient);
    lamp_fading_.push_back(lamp.fading);
    lamp_along_.emplace_back((camera_.camera_from_world.linear() * lamp.along).cast<float>());
    const double fading = lamp.ends_at - lamp.full_within;
    lamp_cone_.emplace_back(float(lamp.ends_at), float(fading > 1e-6 ? 1.0 / fading : 1e6));
    if (lamp.ends_at < 4.0) kinds_.spots = true;
  }
  kinds_.lamps = int(lights.lamps.size());
}

void ScenePassLights::add_sky(double strength, bool sampled, PassNumber pass) {
  sky_up_ = (camera_.camera_from_world.linear() * Vector3::UnitY()).cast<float>();
  // Without shadows nothing hides any of the sky; this makes up for the part that usually is hidden.
  const auto open = float(0.85 * strength);
  sky_above_ = open * sky_above();
  sky_below_ = open * sky_below();
  if (!sampled) return;
  kinds_.skies = kSkySamples;
  for (int i = 0; i < kSkySamples; ++i) {
    // Numbered from top to bottom: one from each part, so that each pass is a fair sample.
    const SkyLight sky =
        scene_sky_light(i * pass.count + pass.index, kSkySamples * pass.count, strength * pass.count);
    shadow_directions_.push_back(sky.to_light);
    to_sky_.emplace_back((camera_.camera_from_world.linear() * sky.to_light).cast<float>());
    sky_light_.push_back(sky.light);
  }
}

void ScenePassLights::add_shadows(const ShadowRegion& region, int shadow_side) {
  for (const Vector3& to_light : shadow_directions_) {
    lenses_.push_back(light_camera(-to_light, region.centre, 1.02 * region.radius));
    shadow_from_camera_.emplace_back(
        (lenses_.back().clip_from_world() * camera_.camera_from_world.inverse().matrix()).cast<float>());
  }
  kinds_.maps = int(lenses_.size());
  // Three texels: a point never lies in its own shadow.
  shadow_offset_ = float(6.0 * region.radius / shadow_side);
  shadow_blur_ = float(0.015 * region.radius);
}

void ScenePassLights::set(const SceneProgram& program) const {
  set_all(program, "to_sun", to_sun_);
  set_all(program, "sun_light", sun_light_);
  set_all(program, "sun_ambient", sun_ambient_);
  set_all(program, "sun_gloss", sun_gloss_);
  set_all(program, "lamp_at", lamp_at_);
  set_all(program, "lamp_light", lamp_light_);
  set_all(program, "lamp_ambient", lamp_ambient_);
  set_all(program, "lamp_along", lamp_along_);
  set_all(program, "lamp_fading", lamp_fading_);
  set_all(program, "lamp_cone", lamp_cone_);
  set_all(program, "to_sky", to_sky_);
  set_all(program, "sky_light", sky_light_);
  set_all(program, "shadow_from_camera", shadow_from_camera_);
  set_all(program, "sky_up", std::vector{sky_up_});
  set_all(program, "sky_above", std::vector{sky_above_});
  set_all(program, "sky_below", std::vector{sky_below_});
  set_all(program, "shadow_offset", std::vector{shadow_offset_});
  set_all(program, "shadow_blur", std::vector{shadow_blur_});
  set_all(program, "noise_seed", std::vector{seed_});
  glUniform1i(slot_of(program, "shadow_map"), 0);
  glUniform1i(slot_of(program, "picture"), 1);
}

void ScenePassLights::set_groups(const SceneProgram& program, world::ObjectId object) const {
  if (program.sun_reaches < 0) return;
  std::vector<float> reaches;
  for (const auto& group : sun_groups_) reaches.push_back(!group || group->contains(object) ? 1.0F : 0.0F);
  glUniform1fv(program.sun_reaches, GLsizei(reaches.size()), reaches.data());
}

}  // namespace icome::render
