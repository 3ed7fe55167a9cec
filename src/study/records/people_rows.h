#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "study/definition/trial_plan.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The columns of participants.tsv.
Columns people_columns(const StudyFolder& folder);

std::string person_row(const StudyFolder& folder, const Participant& participant);

/// The people who take part, as read from participants.tsv.
struct People {
  std::vector<Participant> participants;
  std::size_t whole = 0;  // bytes of the whole rows; 0: not even the header is whole
  bool torn = false;      // the last row is not whole
};

/// Fails, naming the line, on anything that a participants.tsv of this study cannot hold.
base::Result<People> parse_people(std::string_view text, const StudyFolder& folder);
/// Reads participants.tsv. Without the file there is nobody.
base::Result<People> read_people(const StudyFolder& folder);

/// Checked answers to the control variables, "" where nothing was said. Fails, naming the variable, on an
/// answer that is not a level or number, and on a missing one by which groups are balanced.
base::Result<std::vector<std::string>> checked_control(const Study& study, std::vector<std::string> answers);

}  // namespace icome::study
