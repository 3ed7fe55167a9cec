#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "render/model/camera.h"
#include "render/scene/scene_lighting.h"
#include "render/scene/scene_programs.h"
#include "render/scene/scene_shadows.h"

namespace icome::render {

/// The number of a pass among those that are averaged.
struct PassNumber {
  int index = 0;
  int count = 1;
};

/// The lights of one pass in the camera's frame, as shaders take them, with the lenses of its shadow maps.
class ScenePassLights {
 public:
  /// `toned`: the pass is shown as it is, not averaged.
  ScenePassLights(const SceneLights& lights, const Camera& camera, const std::optional<ShadowRegion>& shadows,
                  int shadow_side, PassNumber pass, bool toned);

  const LightKinds& kinds() const { return kinds_; }
  const std::vector<Camera>& lenses() const { return lenses_; }  ///< one a shadow map

  /// Sets the lights of the program, which is in use; the shadow maps are the texture of unit 0.
  void set(const SceneProgram& program) const;
  /// Tells the program which suns shine on the object.
  void set_groups(const SceneProgram& program, world::ObjectId object) const;

 private:
  void add_suns(const SceneLights& lights, PassNumber pass);
  void add_lamps(const SceneLights& lights);
  void add_sky(double strength, bool sampled, PassNumber pass);
  void add_shadows(const ShadowRegion& region, int shadow_side);

  Camera camera_;
  LightKinds kinds_;
  std::vector<base::Vector3> shadow_directions_;  // to the light, world frame
  std::vector<Camera> lenses_;
  std::vector<Eigen::Vector3f> to_sun_, sun_light_, sun_ambient_;
  std::vector<float> sun_gloss_;
  std::vector<std::shared_ptr<const std::unordered_set<world::ObjectId>>> sun_groups_;
  std::vector<Eigen::Vector3f> lamp_at_, lamp_light_, lamp_ambient_, lamp_along_;
  std::vector<Eigen::Vector4f> lamp_fading_;
  std::vector<Eigen::Vector2f> lamp_cone_;
  std::vector<Eigen::Vector3f> to_sky_, sky_light_;
  std::vector<Eigen::Matrix4f> shadow_from_camera_;
  Eigen::Vector3f sky_up_, sky_above_, sky_below_;
  float shadow_offset_ = 0.0F, shadow_blur_ = 0.0F, seed_ = 0.0F;
};

}  // namespace icome::render
