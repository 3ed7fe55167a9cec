#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"
#include "study/definition/stage_element.h"
#include "study/definition/trial_plan.h"
#include "world/world.h"

namespace icome::study {

/// The scenes of a study, each read once. The study must outlive it.
class SceneReader {
 public:
  /// `folder` is that of the study file, beside which the scenes lie.
  SceneReader(const Study& study, std::filesystem::path folder);

  /// A whole scene from its file, in the stage frame. Fails as files::read_design() does.
  const base::Result<world::World>& whole(const std::string& file);
  /// The world of a trial: its scene without hidden_things(). Fails also when the trial has no scene
  /// file.
  base::Result<world::World> in_trial(const TrialPlan& plan);
  /// The element of a trial's scene, read once; null where the scene has none. Fails as read_stage_element()
  /// does. It lives as long as the reader.
  base::Result<const StageElement*> element_in(const TrialPlan& plan);

 private:
  const Study& study_;
  std::filesystem::path folder_;
  std::map<std::string, base::Result<world::World>> worlds_;  // including those that cannot be read
  std::map<const TrialScene*, base::Result<StageElement>> elements_;
};

}  // namespace icome::study
