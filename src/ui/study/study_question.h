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

/// One question of a questionnaire, with what it is answered by. The item outlives it.
class StudyQuestion final : public QWidget {
 public:
  StudyQuestion(const study::Item& item, std::size_t language, const StudyWords& words, QWidget* parent);

  /// As SessionRun::answered() takes it; empty: none.
  std::string answer() const { return answer_(); }
  /// Says below the question why its answer cannot be taken, until another is given; false: it can.
  bool refuse();
  bool needs_answer() const { return item_.required && answer().empty(); }
  /// The keyboard goes to what it is answered by.
  void take_keyboard();

 protected:
  /// Digits choose.
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
  QWidget* first_ = nullptr;         // that can have the keyboard
  std::function<std::string()> answer_;
};

}  // namespace icome::ui
