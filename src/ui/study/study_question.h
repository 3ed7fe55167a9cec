#pragma once
#include <QWidget>
#include <functional>
#include <string>

#include "study/definition/study.h"
#include "ui/study/study_words.h"

class QButtonGroup;
class QLabel;
class QVBoxLayout;

namespace icome::ui {

/// One question of a questionnaire, with the widgets for its answer. The item outlives it.
class StudyQuestion final : public QWidget {
 public:
  StudyQuestion(const study::Item& item, std::size_t language, const StudyWords& words, QWidget* parent);

  /// The answer as SessionRun::answered() takes it; empty: none.
  std::string answer() const { return answer_(); }
  /// Shows why the answer cannot be taken, below the question, until another is given; false: it can.
  bool refuse();
  bool needs_answer() const { return item_.required && answer().empty(); }
  /// Gives the keyboard's focus to the widgets for the answer.
  void take_keyboard();

 protected:
  /// Digits choose an answer.
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void add_choices(bool several);
  void add_rating();
  void add_slider();
  void add_ends();
  void add_number();
  void add_open_text();
  std::string chosen() const;
  QString why() const;
  QString why_no_number() const;
  void forgive();

  const study::Item& item_;
  std::size_t language_;
  StudyWords words_;
  QVBoxLayout* rows_;
  QLabel* complaint_;
  QButtonGroup* buttons_ = nullptr;  // of choices and points, in their order; null: there are none
  QWidget* first_ = nullptr;         // the first widget that takes the focus
  std::function<std::string()> answer_;
};

}  // namespace icome::ui
