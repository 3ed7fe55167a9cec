#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "study/definition/study.h"

namespace icome::study {

/// Reads a study file (TOML; docs/studies.md has every key). Fails with all that is wrong at once, a line
/// each: "source:line:column: what it is and what to write". A study that was read holds no name of a factor,
/// level or variable that is not there, and has every text in each of its languages.
base::Result<Study> read_study(std::string_view text, const std::string& source);

}  // namespace icome::study
