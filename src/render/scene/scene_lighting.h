#pragma once
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "render/model/camera.h"
#include "render/model/render_scene.h"

namespace icome::render {

/// The lights in which a picture is drawn.
enum class LightChoice {
  Automatic,  ///< the design's own where it has any that are on, else the studio's
  Studio      ///< a soft light from above, the sky, and a faint one at the eye
};

/// Light from one direction.
struct SunLight {
  base::Vector3 to_light;  ///< unit, world frame
  Eigen::Vector3f light;   ///< linear
  Eigen::Vector3f ambient = Eigen::Vector3f::Zero();
  float gloss = 0.0F;  ///< strength of the highlight that it makes on every surface
  double disc = 0.0;   ///< radius that it shines from, as a share of its distance: softens its shadow
  std::shared_ptr<const std::unordered_set<world::ObjectId>> group =
      {};  ///< all it shines on; null: everything
};

/// Light from one point, VRML 2.0's PointLight and SpotLight.
struct LampLight {
  base::Vector3 at;  ///< m, world frame
  Eigen::Vector3f light;
  Eigen::Vector3f ambient;
  Eigen::Vector4f fading;     ///< by 1, distance and its square (m), and where it ends (m)
  base::Vector3 along;        ///< unit, world frame
  double ends_at = 10.0;      ///< rad; beyond pi shines all round
  double full_within = 10.0;  ///< rad
};

/// All lights of a picture.
struct SceneLights {
  std::vector<SunLight> suns;  ///< the first throws a shadow if `shadowed`
  std::vector<LampLight> lamps;
  bool shadowed = false;
  double sky = 1.0;  ///< strength of the even light from all round
};

/// Chooses as many as shaders take (8 suns and the light at the eye, 16 lamps), the strongest first.
SceneLights choose_lights(const RenderScene& scene, const Camera& camera, LightChoice choice);

/// A sentence on lights that are too many to be drawn; empty where there are none.
std::string lights_left_out(const RenderScene& scene);

/// A light of the sky.
struct SkyLight {
  base::Vector3 to_light;  ///< unit, world frame
  Eigen::Vector3f light;
};

/// Light of the sky from straight above and from straight below; linear.
Eigen::Vector3f sky_above();
Eigen::Vector3f sky_below();

/// Light number `index` of `count` that together shine as the sky does; y is up.
SkyLight scene_sky_light(int index, int count, double strength);

/// The direction of the sun in pass `index` of `count`: the passes together shine from its whole disc.
base::Vector3 sun_direction(const SunLight& sun, int index, int count);

}  // namespace icome::render
