#include "render/scene/scene_lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/srgb.h"

namespace icome::render {
namespace {

using base::Vector3;

constexpr std::size_t kMostSuns = 8;
constexpr std::size_t kMostLamps = 16;
constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002102;  // rad: pi (3 - sqrt 5)

Eigen::Vector3f shine_of(const world::Light& light, float strength) {
  return strength * Eigen::Vector3f(base::linear_from_srgb(light.colour).data());
}

/// Unit direction along the light's -z; along the world's -z where the light's placement is flat.
Vector3 shining_along(const RenderLight& it) {
  const Vector3 along = it.world_from_light.linear() * -Vector3::UnitZ();
  const double size = along.stableNorm();
  return size > 0.0 && std::isfinite(size) ? Vector3(along / size) : Vector3(-Vector3::UnitZ());
}

SunLight sun_of(const RenderLight& it) {
  return {-shining_along(it),
          shine_of(it.light, it.light.intensity),
          shine_of(it.light, it.light.ambient),
          0.0F,
          0.02,
          it.group};
}

bool shines(const world::Light& light) {
  return light.on && (light.intensity > 0.0F || light.ambient > 0.0F);
}

LampLight lamp_of(const RenderLight& it) {
  LampLight lamp;
  lamp.at = it.world_from_light.translation();
  lamp.light = shine_of(it.light, it.light.intensity);
  lamp.ambient = shine_of(it.light, it.light.ambient);
  // Distances and radius are of the light's own frame.
  const double scale = std::cbrt(std::abs(it.world_from_light.linear().determinant()));
  const float grown = scale > 0.0 && std::isfinite(scale) ? float(scale) : 1.0F;
  const auto& fade = it.light.attenuation;
  const bool fades = fade[0] > 0.0F || fade[1] > 0.0F || fade[2] > 0.0F;
  lamp.fading = fades ? Eigen::Vector4f(fade[0], fade[1] / grown, fade[2] / (grown * grown), 0.0F)
                      : Eigen::Vector4f(1.0F, 0.0F, 0.0F, 0.0F);
  lamp.fading[3] = float(it.light.radius) * grown;
  lamp.along = shining_along(it);
  if (it.light.kind == world::Light::Kind::Spot) {
    lamp.ends_at = it.light.cut_off_angle;
    lamp.full_within = std::min(it.light.beam_width, it.light.cut_off_angle);
  }
  return lamp;
}

SceneLights design_lights(const RenderScene& scene) {
  SceneLights lights;
  for (const RenderLight& it : scene.lights()) {
    if (!shines(it.light)) continue;
    if (it.light.kind == world::Light::Kind::Directional) {
      lights.suns.push_back(sun_of(it));
    } else {
      lights.lamps.push_back(lamp_of(it));
    }
  }
  const auto by_strength = [](const auto& a, const auto& b) { return a.light.sum() > b.light.sum(); };
  std::stable_sort(lights.suns.begin(), lights.suns.end(), by_strength);
  std::stable_sort(lights.lamps.begin(), lights.lamps.end(), by_strength);
  // The first one's shadow falls on everything.
  std::stable_partition(lights.suns.begin(), lights.suns.end(), [](const SunLight& it) { return !it.group; });
  if (lights.suns.size() > kMostSuns) lights.suns.resize(kMostSuns);
  if (lights.lamps.size() > kMostLamps) lights.lamps.resize(kMostLamps);
  return lights;
}

/// The unit direction in the world's frame of one that is given in the camera's.
Vector3 from_camera(const Camera& camera, const Vector3& direction) {
  return (camera.camera_from_world.linear().transpose() * direction).normalized();
}

}  // namespace

SceneLights choose_lights(const RenderScene& scene, const Camera& camera, LightChoice choice) {
  if (choice == LightChoice::Automatic) {
    SceneLights lights = design_lights(scene);
    if (!lights.suns.empty() || !lights.lamps.empty()) {
      // Parts that no light of the design reaches can still be made out. The first light throws a shadow;
      // that of the light at the eye is hidden behind the thing that throws it.
      lights.shadowed = lights.suns.empty() || !lights.suns.front().group;
      lights.suns.push_back({from_camera(camera, Vector3::UnitZ()), Eigen::Vector3f::Constant(0.15F)});
      lights.sky = 0.4;
      return lights;
    }
  }
  SceneLights studio;
  // It stands still in the world: shadows stay where they are while one walks round things.
  studio.suns.push_back(
      {Vector3(-0.46, 0.80, 0.62).normalized(), {0.62F, 0.60F, 0.57F}, Eigen::Vector3f::Zero(), 0.10F, 0.22});
  // Sides that it does not reach are seen by a light at the eye.
  studio.suns.push_back({from_camera(camera, {-0.25, 0.35, 1.0}), {0.20F, 0.20F, 0.21F}});
  studio.shadowed = true;
  return studio;
}

std::string lights_left_out(const RenderScene& scene) {
  std::size_t suns = 0, lamps = 0;
  for (const RenderLight& it : scene.lights()) {
    if (shines(it.light)) ++(it.light.kind == world::Light::Kind::Directional ? suns : lamps);
  }
  if (suns <= kMostSuns && lamps <= kMostLamps) return {};
  return fmt::format(
      "Of {} directional lights and {} lamps, the {} and {} strongest are drawn: the others do not shine.",
      suns, lamps, std::min(suns, kMostSuns), std::min(lamps, kMostLamps));
}

Eigen::Vector3f sky_above() { return {0.44F, 0.46F, 0.50F}; }
Eigen::Vector3f sky_below() { return {0.19F, 0.185F, 0.18F}; }

SkyLight scene_sky_light(int index, int count, double strength) {
  const double height = 1.0 - (2.0 * index + 1.0) / count;
  const double rho = std::sqrt(1.0 - height * height);
  const double angle = kGoldenAngle * index;
  const auto t = float(0.5 + 0.5 * height);
  // A full even ball of light 1 gives a surface 1 when the mean of max(0, cos) = 1/4 is made up for.
  return {{rho * std::cos(angle), height, rho * std::sin(angle)},
          float(4.0 * strength / count) * ((1.0F - t) * sky_below() + t * sky_above())};
}

Vector3 sun_direction(const SunLight& sun, int index, int count) {
  if (count <= 1) return sun.to_light;
  const double rho = sun.disc * std::sqrt((index + 0.5) / count);
  const Vector3 side = sun.to_light.unitOrthogonal();
  const double angle = kGoldenAngle * index;
  return (sun.to_light + rho * (std::cos(angle) * side + std::sin(angle) * sun.to_light.cross(side)))
      .normalized();
}

}  // namespace icome::render
