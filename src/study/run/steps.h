#pragma once
#include <cstdint>
#include <string_view>

#include "study/records/records.h"

namespace icome::study {

/// What is to be read before it goes on.
enum class PageKind : std::uint8_t {
  Consent,
  Instructions,  // with the goal
  Condition,     // begins
  Measured,      // practice is over
  Rest,          // for Trials::rest seconds
};

/// "consent", "instructions", "condition", "measured", "rest": what an EventRecord of a page is named.
std::string_view page_name(PageKind page);

/// What a person does next.
struct Step {
  enum class Kind : std::uint8_t { Page, Questions, Trial, Over };
  Kind kind = Kind::Over;
  PageKind page = PageKind::Consent;  // of Page
  std::size_t questionnaire = 0;      // of Questions: of Study::questionnaires
  std::size_t position = 0;           // of the condition in the person's order
  TrialPlan trial;                    // of Trial
};

/// The protocol (thesis 6.3.4), as a function of what was done: consent; questionnaires `before`;
/// instructions; for each condition its page, practice until the criterion is met, measured trials, its
/// questionnaires and a rest; questionnaires `after-last` and `end`. A questionnaire is done when each of its
/// questions has an answer on record, be it an empty one.
Step next_step(const Study& study, const Participant& participant, const Progress& progress);

/// Whether practice in that condition has met the criterion, or there is none; false as well where attempts
/// are used up.
bool is_practised(const Study& study, const Progress& progress, std::size_t position);

/// The share of the protocol that is done, in [0, 1], by trials and pages.
double share_done(const Study& study, const Participant& participant, const Progress& progress);

}  // namespace icome::study
