#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "study/records/data_folder.h"

namespace icome::study {

/// Lets simulated people take part until the folder has `people` who are through; those who have
/// begun already go on where they are. `tell` is given the share that is done, in [0, 1], before
/// each step of a session, and returns whether to go on: if it returns false the work ends early,
/// with nothing lost. Their clock is simulated: whatever is interrupted, the trials are the same
/// bits in the end. Fails as DataFolder does, when a scene cannot be read and when a trial has no
/// target.
base::Result<void> simulate(const Study& study, const std::filesystem::path& study_folder, DataFolder& data,
                            std::size_t people, const std::function<bool(double)>& tell);

}  // namespace icome::study
