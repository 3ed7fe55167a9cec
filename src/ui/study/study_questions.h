#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ui/study/study_page.h"
#include "ui/study/study_question.h"

namespace icome::ui {

/// A questionnaire, all of it on one page. Enter goes to the next question that needs an answer and has none,
/// and on when there is none. The questionnaire outlives it.
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
  std::vector<StudyQuestion*> questions_;  // the page's
};

}  // namespace icome::ui
