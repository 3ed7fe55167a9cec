#pragma once
#include <filesystem>

namespace icome::apps {

/// The options of `icome study report`.
struct StudyReportOptions {
  std::filesystem::path folder;  // of the data
  std::filesystem::path out;     // of the page; empty: report.html in the folder
  std::filesystem::path pdf;     // empty: none
  bool json = false;
};

/// Writes the page, and the PDF file where one is asked for, and prints the key results with their paths,
/// or all results as JSON. Refuses to write over the data. Gives the program's exit code.
int run_study_report(const StudyReportOptions& options);

}  // namespace icome::apps
