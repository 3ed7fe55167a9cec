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

/// The columns of a person's table of trials (_beh.tsv), and of the table of events (_events.tsv).
Columns trial_columns(const StudyFolder& folder);
Columns event_columns(const StudyFolder& folder);

/// The row of a person's `run`-th trial, counted from 1.
std::string trial_row(const StudyFolder& folder, const Participant& participant, const TrialRecord& trial,
                      std::size_t run);
std::string event_row(const StudyFolder& folder, const EventRecord& event);

/// The reason why a person cannot have done this trial after those; empty if they can.
std::string why_not_next(const Study& study, const Participant& participant,
                         const std::vector<TrialRecord>& done, const TrialPlan& next);
/// The reason why this event cannot have happened in the study; empty if it can.
std::string why_no_event(const Study& study, const EventRecord& event);

/// The record of a person, as read from the files.
struct PersonRecord {
  Progress progress;
  std::size_t trials_whole = 0;  // bytes of the whole rows; 0: not even the header is whole
  std::size_t events_whole = 0;
  bool trials_torn = false;  // the last row is not whole
  bool events_torn = false;
};

/// Fails, naming file and line, on anything that no session of this study leaves. No file: nothing was done.
base::Result<PersonRecord> read_record(const StudyFolder& folder, const Participant& participant);

/// Is there an event of that kind?
bool has_event(const Progress& progress, EventKind kind);
/// Has the session ended for good: is it complete, or has the person declined?
bool has_ended(const Progress& progress);

}  // namespace icome::study
