#pragma once
#include <filesystem>

#include "study/definition/study_check.h"

namespace icome::study {

/// Adds to a check what only the scenes tell, which lie in `folder`, that of the study file.
///
/// Reasons: a scene's file is not there or cannot be read, or nothing in it is the target of a trial that may
/// take place there, whatever is drawn for it. Warnings: what the task shows or takes for wrong is not there.
/// Each scene is read once. Of trial variables only those count that names of things hold; where these have
/// more than some hundreds of combinations, not all are looked at. Scenes without a file are left out.
void check_scenes(const Study& study, const std::filesystem::path& folder, StudyCheck& check);

}  // namespace icome::study
