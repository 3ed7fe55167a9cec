#pragma once
#include "apps/study/study_options.h"
#include "base/result.h"
#include "study/definition/study.h"

namespace icome::apps {

/// A study file, read.
struct OpenedStudy {
  study::Study study;
  std::string text;              // of the file
  std::filesystem::path folder;  // of the file
};
base::Result<OpenedStudy> open_study(const std::filesystem::path& file);

/// `icome study run` and `resume`: takes a person through the study in a window, or lets simulated people
/// take part. Gives the program's exit code.
int run_study_session(int argc, char** argv, const StudyOptions& options);

}  // namespace icome::apps
