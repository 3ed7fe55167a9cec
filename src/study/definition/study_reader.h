#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "study/definition/study.h"

namespace icome::study {

/// Reads a study file (TOML; docs/studies.md has every key). Fails with all problems at once, a line each:
/// "source:line:column: what it is and what to write". In a study that was read, every factor, level and
/// variable that is named exists, and every text is in each of the study's languages.
base::Result<Study> read_study(std::string_view text, const std::string& source);

}  // namespace icome::study
