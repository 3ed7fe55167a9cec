#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ui/study/study_page.h"
#include "ui/study/study_question.h"

namespace icome::ui {

/// A questionnaire on one page. Enter goes to the next question that needs an answer and has none; where
/// there is no such question, it finishes the page. The questionnaire outlives it.
class StudyQuestions final : public StudyPage {
 public:
  /// `done` gets an answer for each item, in their order, when all can be taken.
  using Done = std::function<void(const std::vector<std::string>& answers)>;
  StudyQuestions(const study::Questionnaire& questionnaire, std::size_t language, const StudyWords& words,
                 Done done, QWidget* parent);

  void take_keyboard() override;

 protected:
  void enter() override;

 private:
  void go_on();
  void go_to(StudyQuestion& question);

  Done done_;
  std::vector<StudyQuestion*> questions_;  // owned by the page
};

}  // namespace icome::ui
