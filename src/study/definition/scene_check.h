#pragma once
#include <filesystem>
#include <set>
#include <string>

#include "study/definition/study_check.h"

namespace icome::study {

/// Adds findings about the scenes to a check. The scenes lie in `folder`, which holds the study file.
///
/// Reasons: a scene's file is missing or cannot be read, or no object in it is the target for some values
/// that may be drawn for a trial there. Warnings: things that the task shows or takes for wrong are not
/// there. Each scene is read once. Only trial variables that occur in names of things count; if these have
/// more than some hundreds of combinations, not all are looked at. Scenes without a file are left out.
void check_scenes(const Study& study, const std::filesystem::path& folder, StudyCheck& check);

/// The names between quotes; of more than ten the first, and how many there are more.
std::string listed(const std::set<std::string>& names);

}  // namespace icome::study
