#pragma once
#include <string>

#include "study/definition/study.h"
#include "study/definition/study_check.h"

namespace icome::apps {

/// The description of a study for a person. `source` names its file in what is to be thought about.
std::string study_text(const study::Study& study, const study::StudyCheck& check, const std::string& source);

/// The description of a study as JSON.
std::string study_json(const study::Study& study, const study::StudyCheck& check);

}  // namespace icome::apps
