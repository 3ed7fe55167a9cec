#pragma once
#include <filesystem>
#include <functional>

#include "study/definition/study_check.h"

namespace icome::study {

/// Lets a simulated person do a trial with each thing that may be the target of one, and warns of those that
/// it did not choose before the trial's time limit: things in a wall, below the floor, under a menu that
/// never opens. A hundred trials at most, the conditions in turn. `tell` is given the share that is done, in
/// [0, 1], before each, and returns whether to go on. Only for a study that check_scenes() found no reason
/// against.
void check_reach(const Study& study, const std::filesystem::path& folder, StudyCheck& check,
                 const std::function<bool(double)>& tell);

}  // namespace icome::study
