#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/desktop/device_choice.h"
#include "apps/study/study_report_command.h"

namespace icome::apps {

/// The options of `icome study`.
struct StudyOptions {
  std::string task;            // the subcommand: "new", "check", "run", "resume", "report"
  std::filesystem::path file;  // the study
  std::string from = "blank";  // of new: the template
  bool json = false;
  // For run and resume.
  std::filesystem::path data;              // empty: beside the study file
  std::optional<std::string> participant;  // none: the next number; for resume the only one to go on
  std::string language;                    // empty: the study's first
  std::vector<std::string> with;           // "age=31": control variables
  DeviceChoice devices;
  std::string microphone;    // or a recording; empty: the usual one
  std::size_t simulate = 0;  // people; 0: a real one
  bool pointer_alone = false;
  bool in_window = false;  // not over the whole screen
  StudyReportOptions report;
};

}  // namespace icome::apps
