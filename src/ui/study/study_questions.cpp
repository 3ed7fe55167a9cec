#include "ui/study/study_questions.h"

#include <algorithm>
#include <utility>

namespace icome::ui {

StudyQuestions::StudyQuestions(const study::Questionnaire& questionnaire, std::size_t language,
                               const StudyWords& words, Done done, QWidget* parent)
    : StudyPage(study_text(questionnaire.title, language), parent), done_(std::move(done)) {
  for (const study::Item& item : questionnaire.items) {
    questions_.push_back(new StudyQuestion(item, language, words, this));
    add_field(questions_.back());
  }
  add_main_button(words(StudyWord::GoOn), [this] { go_on(); });
  const bool some = std::ranges::any_of(questionnaire.items, &study::Item::required);
  const QString keys = words(StudyWord::QuestionKeys);
  show_hint(some ? words(StudyWord::NeedsAnswer) + "   \u00b7   " + keys : keys);
}

void StudyQuestions::take_keyboard() {
  questions_.empty() ? StudyPage::take_keyboard() : questions_.front()->take_keyboard();
}

void StudyQuestions::go_to(StudyQuestion& question) {
  question.take_keyboard();
  show_field(&question);
}

void StudyQuestions::enter() {
  const auto here = std::ranges::find_if(
      questions_, [this](const StudyQuestion* it) { return it->isAncestorOf(window()->focusWidget()); });
  const auto next = std::find_if(here == questions_.end() ? here : here + 1, questions_.end(),
                                 [](const StudyQuestion* it) { return it->needs_answer(); });
  next == questions_.end() ? go_on() : go_to(**next);
}

void StudyQuestions::go_on() {
  StudyQuestion* first = nullptr;
  for (StudyQuestion* question : questions_) {
    if (question->refuse() && !first) first = question;
  }
  if (first) return go_to(*first);
  std::vector<std::string> answers;
  for (const StudyQuestion* question : questions_) answers.push_back(question->answer());
  done_(answers);
}

}  // namespace icome::ui
