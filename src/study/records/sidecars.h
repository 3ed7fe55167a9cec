#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "study/records/records.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

// The JSON files of the folder. All of simulated data say so.

/// What the columns of a table are.
std::string table_sidecar(const Columns& columns, bool simulated);
/// The same of the answers to a questionnaire.
std::string phenotype_sidecar(const StudyFolder& folder, const Questionnaire& questionnaire,
                              const Columns& columns);
/// What a trace is of (BIDS "Motion": _motion.json).
std::string trace_sidecar(const StudyFolder& folder, const Trace& trace);
/// dataset_description.json (BIDS and Psych-DS).
std::string description_text(const StudyFolder& folder);
/// README, which is plain text.
std::string readme_text(const StudyFolder& folder);

/// What a folder says that it holds.
struct Description {
  std::string study;       // its name
  std::uint64_t hash = 0;  // Study::hash
  bool simulated = false;
  std::vector<std::string> without;  // Study::without
};
/// Fails on what description_text() does not write.
base::Result<Description> parse_description(std::string_view text, const std::string& source);

}  // namespace icome::study
