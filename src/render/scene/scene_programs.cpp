#include "render/scene/scene_programs.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "render/scene/scene_shaders.h"

namespace icome::render {
namespace {

std::string light_defines(const LightKinds& lights) {
  return fmt::format(
      "#define LIT\n#define SUNS {}\n#define LAMPS {}\n{}#define MAPS {}\n#define SKIES {}\n"
      "{}{}{}{}",
      lights.suns, lights.lamps, lights.spots ? "#define SPOTS\n" : "", lights.maps, lights.skies,
      lights.toned ? "#define TONED\n" : "", lights.gloss ? "#define GLOSS\n" : "",
      lights.ambient ? "#define SUN_AMBIENT\n" : "", lights.groups ? "#define SUN_GROUPS\n" : "");
}

void find_slots(SceneProgram& it) {
  const auto slot = [&](const char* name) { return glGetUniformLocation(it.program.name(), name); };
  it.clip_from_buffer = slot("clip_from_buffer");
  it.camera_from_buffer = slot("camera_from_buffer");
  it.direction_from_buffer = slot("direction_from_buffer");
  it.diffuse = slot("diffuse");
  it.specular = slot("specular");
  it.metal = slot("metal");
  it.emission = slot("emission");
  it.ambient = slot("ambient");
  it.picture_frame = slot("picture_frame");
  it.cutoff = slot("cutoff");
  it.sun_reaches = slot("sun_reaches");
}

}  // namespace

base::Result<SceneProgram*> ScenePrograms::variant(const char* vertex, const std::string& fragment,
                                                   const std::string& defines, const char* profile) {
  const std::string key = defines + vertex + fragment;
  const auto found = made_.find(key);
  if (found != made_.end()) return &found->second;
  auto program = compile_program(vertex, fragment, defines, profile);
  if (!program) return tl::unexpected(program.error());
  SceneProgram& made = made_[key];
  made.program = std::move(*program);
  find_slots(made);
  return &made;
}

base::Result<SceneProgram*> ScenePrograms::surface(const SurfaceKind& kind, const LightKinds& lights) {
  std::string defines = light_defines(lights);
  if (kind.textured) defines += "#define TEXTURED\n";
  if (kind.coloured) defines += "#define COLOURED\n";
  if (kind.cut_out) defines += "#define CUT_OUT\n";
  if (kind.built_in) defines += "#define BUILT_IN\n";
  if (kind.shiny) defines += "#define SHINY\n";
  if (kind.blended) defines += "#define BLENDED\n";
  if (kind.unlit) defines += "#define UNLIT\n";
  return variant(kSceneVertexShader, std::string(kToneShader) + kSceneLightShader + kSceneFragmentShader,
                 defines, kind.built_in ? "compatibility" : "core");
}

base::Result<SceneProgram*> ScenePrograms::ground(const LightKinds& lights) {
  return variant(kSceneVertexShader, std::string(kSceneLightShader) + kGroundFragmentShader,
                 light_defines(lights));
}

base::Result<SceneProgram*> ScenePrograms::flat(bool cut_out) {
  return variant(kSceneVertexShader, kFlatFragmentShader, cut_out ? "#define TEXTURED\n" : "");
}

base::Result<SceneProgram*> ScenePrograms::line() {
  return variant(kLineVertexShader, kFlatFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::dot() { return variant(kDotVertexShader, kDotFragmentShader, ""); }

base::Result<SceneProgram*> ScenePrograms::depth_copy() {
  return variant(kWholeVertexShader, kDepthCopyFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::cover() {
  return variant(kWholeVertexShader, kCoverFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::sum() {
  return variant(kWholeVertexShader, kSumFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::grid() {
  return variant(kGridVertexShader, kGridFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::panel() {
  return variant(kPanelVertexShader, kPanelFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::background() {
  return variant(kWholeVertexShader, std::string(kDitherShader) + kBackgroundFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::mean() {
  return variant(kWholeVertexShader, std::string(kToneShader) + kDitherShader + kMeanFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::clear() {
  return variant(kWholeVertexShader, kClearFragmentShader, "");
}

base::Result<SceneProgram*> ScenePrograms::outline() {
  return variant(kWholeVertexShader, kOutlineFragmentShader, "");
}

}  // namespace icome::render
