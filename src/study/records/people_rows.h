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

/// Who takes part.
struct People {
  std::vector<Participant> participants;
  std::size_t whole = 0;  // bytes of the rows that are whole; 0: not even the header is
  bool torn = false;      // the last row is not
};

/// Fails, naming the line, on what no participants.tsv of this study holds.
base::Result<People> parse_people(std::string_view text, const StudyFolder& folder);
/// No file: nobody.
base::Result<People> read_people(const StudyFolder& folder);

/// What people answer about themselves, with "" where nothing was said; fails, naming the variable, on what
/// is no level or number, and where groups are balanced by an answer that is not there.
base::Result<std::vector<std::string>> checked_control(const Study& study, std::vector<std::string> answers);

}  // namespace icome::study
