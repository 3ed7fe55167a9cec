#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "study/records/records.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

// The JSON files of the folder. All those of simulated data say so.

/// The JSON file that describes the columns of a table.
std::string table_sidecar(const Columns& columns, bool simulated);
/// The JSON file that describes the answers to a questionnaire.
std::string phenotype_sidecar(const StudyFolder& folder, const Questionnaire& questionnaire,
                              const Columns& columns);
/// The JSON file that describes a trace (BIDS "Motion": _motion.json).
std::string trace_sidecar(const StudyFolder& folder, const Trace& trace);
/// dataset_description.json (BIDS and Psych-DS).
std::string description_text(const StudyFolder& folder);
/// README, which is plain text.
std::string readme_text(const StudyFolder& folder);

/// The contents of a folder, as its dataset_description.json describes them.
struct Description {
  std::string study;       // its name
  std::uint64_t hash = 0;  // Study::hash
  bool simulated = false;
  std::vector<std::string> without;  // Study::without
};
/// Fails if the text lacks the name or the hash of the study, or whether the data are simulated.
base::Result<Description> parse_description(std::string_view text, const std::string& source);

}  // namespace icome::study
