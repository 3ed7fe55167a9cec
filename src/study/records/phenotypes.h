#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "study/records/records.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The columns of the table of all answers to a questionnaire: a row for each person, as BIDS requires; a
/// column for each item and, if it is asked after each condition, for each condition ("ease_near").
Columns phenotype_columns(const StudyFolder& folder, const Questionnaire& questionnaire);

/// The answers of a person.
struct Answers {
  Participant participant;
  Progress progress;
};

/// Writes the tables of all questionnaires anew if they have changed. The folder must be locked.
base::Result<void> write_phenotypes(const StudyFolder& folder, const std::vector<Answers>& people);

}  // namespace icome::study
