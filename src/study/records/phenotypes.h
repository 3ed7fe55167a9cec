#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "study/records/records.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The columns of the table of all answers to a questionnaire: a row a person, as BIDS wants it; a column an
/// item and, where it is asked after each condition, a condition ("ease_near").
Columns phenotype_columns(const StudyFolder& folder, const Questionnaire& questionnaire);

/// What somebody has answered.
struct Answers {
  Participant participant;
  Progress progress;
};

/// Writes the tables of all questionnaires anew, where they have changed. The folder is locked.
base::Result<void> write_phenotypes(const StudyFolder& folder, const std::vector<Answers>& people);

}  // namespace icome::study
