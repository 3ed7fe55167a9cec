#include "ui/study/study_words.h"

#include <gtest/gtest.h>

namespace icome::ui {
namespace {

TEST(StudyWords, ThereIsAWordForEverythingInEveryLanguageWithTheSameNumbersInIt) {
  const StudyWords english("en");
  for (const std::string_view language : kStudyLanguages) {
    const StudyWords words(language);
    for (int i = 0; i < kStudyWordCount; ++i) {
      const QString its = words(StudyWord(i));
      EXPECT_FALSE(its.trimmed().isEmpty()) << language << " " << i;
      for (const char* number : {"%1", "%2"})
        EXPECT_EQ(its.count(number), english(StudyWord(i)).count(number)) << language << " " << i;
    }
  }
}

TEST(StudyWords, TwoLanguagesHaveNoSentenceInCommon) {
  const StudyWords english("en");
  for (const StudyWord word : {StudyWord::Agree, StudyWord::Interrupt, StudyWord::Thanks}) {
    for (const char* language : {"nl", "de", "fr"})
      EXPECT_NE(StudyWords(language)(word), english(word)) << language;
  }
}

TEST(StudyWords, ARegionIsPassedOverAndEnglishStandsInForWhatIsNotThere) {
  EXPECT_EQ(StudyWords("nl-BE")(StudyWord::GoOn), "Verder");
  EXPECT_EQ(StudyWords("de_AT")(StudyWord::GoOn), "Weiter");
  EXPECT_EQ(StudyWords("sv")(StudyWord::GoOn), "Go on");
  EXPECT_EQ(StudyWords("")(StudyWord::GoOn), "Go on");
}

TEST(StudyText, IsThatOfTheLanguageOrNothing) {
  EXPECT_EQ(study_text({"Age", "Leeftijd"}, 1), "Leeftijd");
  EXPECT_EQ(study_text({}, 0), "");
}

}  // namespace
}  // namespace icome::ui
