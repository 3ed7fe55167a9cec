#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"
#include "study/definition/trial_plan.h"
#include "world/world.h"

namespace icome::study {

/// The scenes of a study, each read once. The study outlives it.
class SceneReader {
 public:
  /// `folder`: of the study file, which scenes lie beside.
  SceneReader(const Study& study, std::filesystem::path folder);

  /// A scene as its file says it, in the stage frame. Fails as files::read_design() does.
  const base::Result<world::World>& whole(const std::string& file);
  /// What is there in a trial: its scene without hidden_things(). Fails also when the trial has no scene
  /// file.
  base::Result<world::World> in_trial(const TrialPlan& plan);

 private:
  const Study& study_;
  std::filesystem::path folder_;
  std::map<std::string, base::Result<world::World>> worlds_;  // those that cannot be read, too
};

}  // namespace icome::study
