#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "study/records/records.h"
#include "study/records/study_folder.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The columns of a person's table of trials (_beh.tsv), and of what else happened (_events.tsv).
Columns trial_columns(const StudyFolder& folder);
Columns event_columns(const StudyFolder& folder);

/// The `run`-th trial of a person, counted from 1.
std::string trial_row(const StudyFolder& folder, const Participant& participant, const TrialRecord& trial,
                      std::size_t run);
std::string event_row(const StudyFolder& folder, const EventRecord& event);

/// Why a person cannot have done this trial after those; empty: they can.
std::string why_not_next(const Study& study, const Participant& participant,
                         const std::vector<TrialRecord>& done, const TrialPlan& next);
/// Why this cannot have happened in the study; empty: it can.
std::string why_no_event(const Study& study, const EventRecord& event);

/// What is on record of a person.
struct PersonRecord {
  Progress progress;
  std::size_t trials_whole = 0;  // bytes of the rows that are whole; 0: not even the header is
  std::size_t events_whole = 0;
  bool trials_torn = false;  // the last row is not
  bool events_torn = false;
};

/// Fails, naming file and line, on what no session of this study leaves. No file: nothing was done.
base::Result<PersonRecord> read_record(const StudyFolder& folder, const Participant& participant);

/// Whether there is an event of that kind.
bool has_event(const Progress& progress, EventKind kind);
/// Nobody goes on with that session: it is complete, or the person declined.
bool has_ended(const Progress& progress);

}  // namespace icome::study
