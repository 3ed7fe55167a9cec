#pragma once
#include <QString>
#include <string>
#include <string_view>

#include "study/definition/study.h"

namespace icome::ui {

/// A text that the program itself shows to a participant of a study. %1 and %2 stand for numbers.
enum class StudyWord : std::uint8_t {
  GoOn,
  Agree,
  Disagree,
  DeclinedTitle,
  Declined,
  PartOf,  // %1 of %2
  OnlyPart,
  Part,
  PartWithPractice,
  MeasuredTitle,
  Measured,
  RestTitle,
  Rest,
  RestLeft,      // %1: time
  Loading,       // a scene
  BringPointer,  // to the start
  HoldStill,     // %1: seconds
  Start,
  MouseKeys,
  TrialOf,     // %1 of %2
  PracticeOf,  // %1 of %2
  Practice,    // %1
  NeedsAnswer,
  SeveralAnswers,
  AnswerMissing,
  NumberMissing,
  NumberBetween,  // %1 and %2
  NumberFrom,     // %1
  NumberUpTo,     // %1
  PageKeys,
  QuestionKeys,
  InterruptTitle,
  Interrupt,
  InterruptNo,
  InterruptYes,
  TroubleTitle,
  Trouble,
  TryAgain,
  EndHere,
  ThanksTitle,
  Thanks,
  Close,
};
inline constexpr int kStudyWordCount = int(StudyWord::Close) + 1;

/// The languages of these texts: "en" first, which stands in for all others.
inline constexpr std::string_view kStudyLanguages[] = {"en", "nl", "de", "fr"};

/// The program's words in one language.
class StudyWords {
 public:
  /// `language` is "nl", say, or "nl-BE" for any Dutch.
  explicit StudyWords(std::string_view language);

  QString operator()(StudyWord word) const;

 private:
  std::size_t column_ = 0;  // of kStudyLanguages
};

/// A text of the study in its language number `language`; empty where it has none.
QString study_text(const study::Text& text, std::size_t language);

}  // namespace icome::ui
