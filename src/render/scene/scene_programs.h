#pragma once
#include <map>
#include <string>

#include "base/result.h"
#include "render/gl/gl_objects.h"
#include "render/scene/scene_plan.h"

namespace icome::render {

/// A variant of the scene's shaders with the places of its uniforms of every object; -1 for those it has not.
struct SceneProgram {
  GlObject program;
  int clip_from_buffer = -1, camera_from_buffer = -1, direction_from_buffer = -1;
  int diffuse = -1, specular = -1, metal = -1, emission = -1, ambient = -1;
  int picture_frame = -1, cutoff = -1, sun_reaches = -1;
  int set_up_for = -1;  ///< the pass whose lights it knows
};

/// The kinds of light in a pass, as far as shaders differ by them.
struct LightKinds {
  int suns = 0;
  int lamps = 0;
  bool spots = false;
  bool gloss = false;    ///< the first sun makes highlights on all surfaces
  bool ambient = false;  ///< suns have ambient light
  bool groups = false;   ///< some suns shine on a group alone
  int maps = 0;          ///< shadow maps
  int skies = 0;
  bool toned = false;  ///< drawn as a screen shows it, not as light to be averaged

  auto operator<=>(const LightKinds&) const = default;
};

/// Compiles variants of the scene's shaders when they are first asked for, and keeps them. Lives in one
/// context.
class ScenePrograms {
 public:
  base::Result<SceneProgram*> surface(const SurfaceKind& kind, const LightKinds& lights);
  base::Result<SceneProgram*> ground(const LightKinds& lights);
  base::Result<SceneProgram*> flat(bool cut_out);  ///< depth or one colour
  base::Result<SceneProgram*> line();
  base::Result<SceneProgram*> dot();
  base::Result<SceneProgram*> depth_copy();  ///< of a picture of depths
  base::Result<SceneProgram*> cover();       ///< one colour where a picture of depths has something
  base::Result<SceneProgram*> sum();
  base::Result<SceneProgram*> grid();
  base::Result<SceneProgram*> panel();
  base::Result<SceneProgram*> background();
  base::Result<SceneProgram*> mean();
  base::Result<SceneProgram*> clear();
  base::Result<SceneProgram*> outline();

 private:
  base::Result<SceneProgram*> variant(const char* vertex, const std::string& fragment,
                                      const std::string& defines, const char* profile = "core");

  std::map<std::string, SceneProgram> made_;  // by their source
};

}  // namespace icome::render
