#pragma once
#include <cstdint>
#include <string_view>

#include "study/records/records.h"

namespace icome::study {

/// A page to be read before the session goes on.
enum class PageKind : std::uint8_t {
  Consent,
  Instructions,  // with the goal
  Condition,     // a condition begins
  Measured,      // practice is over
  Rest,          // for Trials::rest seconds
};

/// "consent", "instructions", "condition", "measured", "rest": the name of a page in an EventRecord.
std::string_view page_name(PageKind page);

/// The next step of a person.
struct Step {
  enum class Kind : std::uint8_t { Page, Questions, Trial, Over };
  Kind kind = Kind::Over;
  PageKind page = PageKind::Consent;  // of Page
  std::size_t questionnaire = 0;      // of Questions: an index of Study::questionnaires
  std::size_t position = 0;           // of the condition in the person's order
  TrialPlan trial;                    // of Trial
};

/// The protocol (thesis 6.3.4), as a function of the progress: consent; questionnaires `before`;
/// instructions; for each condition its page, practice until the criterion is met, measured trials, its
/// questionnaires and a rest; questionnaires `after-last` and `end`. A questionnaire is done when each of its
/// questions has an answer on record, even an empty one.
Step next_step(const Study& study, const Participant& participant, const Progress& progress);

/// Has practice in that condition met the criterion, or is there none? False also if the attempts are used
/// up.
bool is_practised(const Study& study, const Progress& progress, std::size_t position);

/// The share of the protocol that is done, in [0, 1], by trials and pages.
double share_done(const Study& study, const Participant& participant, const Progress& progress);

}  // namespace icome::study
