#include "apps/study/scene_pictures.h"

#include <utility>

#include "charts/image.h"
#include "charts/lettering.h"
#include "render/model/views.h"
#include "render/pictures/picture_of_scene.h"
#include "session/elements/element_panels.h"
#include "study/definition/scene_reader.h"
#include "study/definition/trial_goal.h"

namespace icome::apps {
namespace {

constexpr int kSceneWidth = 720, kSceneHeight = 480;  // pixels
constexpr double kElementResolution = 4000.0;         // pixels a metre
// As TrialStage looks at scenes.
const render::ViewDirection kFromFront{"front", {0.0, 0.25, 1.0}, {0.0, 1.0, 0.0}};

/// The study with its files where the folder of the data keeps them.
study::Study with_kept_files(study::Study study, const std::filesystem::path& folder) {
  const study::Study before = study;
  const auto keep = [&](study::TrialScene& scene) {
    if (scene.file.empty()) return;
    scene.file = study::kept_file(before, folder, scene.file).string();
    if (scene.element) scene.element->file = study::kept_file(before, folder, scene.element->file).string();
  };
  for (study::TrialScene& scene : study.trials.scenes) keep(scene);
  if (study.trials.practice_scene) keep(*study.trials.practice_scene);
  return study;
}

/// The element as it is to be read, opaque.
std::vector<render::SceneOverlay::Panel> panels_of_element(const study::StageElement& stage) {
  interaction::Element element = *stage.element;
  element.fading.least = 1.0;
  interaction::ElementUse use(element, 0, charts::line_width);
  use.rest(0.0, true);
  return session::panels_of(use, session::ElementTheme::Light, kElementResolution);
}

base::Result<std::vector<std::uint8_t>> drawn_scene(study::SceneReader& scenes,
                                                    const study::TrialPlan& plan) {
  const auto world = scenes.in_trial(plan);
  if (!world) return tl::unexpected(world.error());
  const auto element = scenes.element_in(plan);
  if (!element) return tl::unexpected(element.error());
  render::ScenePublisher publisher;
  const render::RenderScenePointer scene = publisher.publish(*world);
  render::SceneLook look;
  look.passes = render::still_passes(*scene);
  if (*element != nullptr) look.overlay.panels = panels_of_element(**element);
  const render::Camera camera = render::fit_scene(*scene, kFromFront, double(kSceneWidth) / kSceneHeight);
  const auto image = render::draw_picture(*scene, camera, look, kSceneWidth, kSceneHeight);
  if (!image) return tl::unexpected(image.error());
  return charts::encode_png(*image);
}

}  // namespace

std::vector<ScenePicture> pictures_of_scenes(const study::StudyData& data,
                                             const std::filesystem::path& folder) {
  const study::Study study = with_kept_files(data.study, std::filesystem::absolute(folder));
  study::SceneReader scenes(study, {});
  std::vector<ScenePicture> pictures;
  for (std::size_t i = 0; i < study.trials.scenes.size(); ++i) {
    study::TrialPlan plan;
    plan.scene = i;
    plan.values.assign(study.trials.variables.size(), 0);
    ScenePicture picture{study.trials.scenes[i].id, {}, {}};
    auto png = drawn_scene(scenes, plan);
    if (png)
      picture.png = std::move(*png);
    else
      picture.why = png.error().message;
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace icome::apps
