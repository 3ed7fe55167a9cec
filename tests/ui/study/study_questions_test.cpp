#include "ui/study/study_questions.h"

#include <QAbstractButton>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTest>
#include <optional>

#include "ui/desktop_test.h"

namespace icome::ui {
namespace {

using study::Item;
using study::ItemKind;

study::Level level(const char* id, const char* name) {
  study::Level made;
  made.id = id;
  made.name = {name};
  return made;
}

Item item(const char* id, ItemKind kind, bool required = true) {
  Item made;
  made.id = id;
  made.kind = kind;
  made.text = {id};
  made.required = required;
  return made;
}

class StudyQuestionsTest : public ::testing::Test {
 protected:
  StudyQuestionsTest() {
    application();
    its_.title = {"About you"};
  }

  Item& add(const char* id, ItemKind kind, bool required = true) {
    its_.items.push_back(item(id, kind, required));
    Item& made = its_.items.back();
    if (kind == ItemKind::Choice || kind == ItemKind::Choices)
      made.choices = {level("few", "Few"), level("some", "Some"), level("many", "Many")};
    if (kind == ItemKind::Rating) made.points = 7;
    return made;
  }
  void show(const char* language = "en") {
    page_ = std::make_unique<StudyQuestions>(
        its_, 0, StudyWords(language), [this](const auto& answers) { answers_ = answers; }, nullptr);
    page_->setAttribute(Qt::WA_DontShowOnScreen);
    page_->resize(900, 700);
    page_->show();
    page_->take_keyboard();
  }
  QWidget& question(const char* id) {
    auto* found = page_->findChild<QWidget*>(QString("study.") + id);
    EXPECT_TRUE(found) << id;
    return *found;
  }
  template <typename Widget>
  Widget& field(const char* id) {
    auto* found = question(id).findChild<Widget*>();
    EXPECT_TRUE(found) << id;
    return *found;
  }
  /// What stands in red below a question; empty: nothing.
  QString complaint(const char* id) {
    const auto* label = question(id).findChild<QLabel*>("complaint");
    return label->isVisible() ? label->text() : QString();
  }
  void key(const char* id, Qt::Key key) { QTest::keyClick(&question(id), key); }
  void go_on() { page_->findChild<QAbstractButton*>("study.main")->click(); }

  using Answers = std::vector<std::string>;
  study::Questionnaire its_;
  std::unique_ptr<StudyQuestions> page_;
  std::optional<Answers> answers_;  // once the page is done
};

TEST_F(StudyQuestionsTest, EveryKindGivesItsAnswer) {
  add("one", ItemKind::Choice);
  add("several", ItemKind::Choices);
  add("points", ItemKind::Rating);
  add("age", ItemKind::Number);
  add("remarks", ItemKind::OpenText);
  show();
  key("one", Qt::Key_2);
  key("several", Qt::Key_1);
  key("several", Qt::Key_3);
  key("points", Qt::Key_5);
  field<QLineEdit>("age").setText(" 33,5 ");
  field<QPlainTextEdit>("remarks").setPlainText("It was\nfine. ");
  go_on();
  EXPECT_EQ(answers_, (Answers{"some", "few,many", "5", "33.5", "It was\nfine."}));
}

TEST_F(StudyQuestionsTest, LongAnswersStandInSeveralLines) {
  Item& one = add("one", ItemKind::Choice);
  const QString words = QString("forces & no forces, ").repeated(10).trimmed();
  one.choices[0].name = {words.toStdString()};
  show();
  const QString text = field<QAbstractButton>("one").text().replace("&&", "&");
  for (const QString& line : text.split('\n')) EXPECT_LE(line.size(), 64);
  EXPECT_GE(text.count('\n'), 3);
  EXPECT_EQ(QString(text).replace('\n', ' '), words);
}

TEST_F(StudyQuestionsTest, ANumberThatCanBeReadInTwoWaysIsRefused) {
  add("age", ItemKind::Number);
  show();
  field<QLineEdit>("age").setText("1,000");
  go_on();
  EXPECT_FALSE(answers_);
  EXPECT_EQ(complaint("age"), "Please give a number.");
  field<QLineEdit>("age").setText("0,125");
  go_on();
  EXPECT_EQ(answers_, Answers{"0.125"});
}

TEST_F(StudyQuestionsTest, WhatIsNotRequiredMayStayEmpty) {
  for (const ItemKind kind :
       {ItemKind::Choice, ItemKind::Choices, ItemKind::Rating, ItemKind::Number, ItemKind::OpenText})
    add(("q" + std::to_string(int(kind))).c_str(), kind, false);
  show();
  go_on();
  EXPECT_EQ(answers_, Answers(5));
}

TEST_F(StudyQuestionsTest, WhatIsMissingIsToldBesideItsQuestionUntilItIsAnswered) {
  add("one", ItemKind::Choice);
  add("remarks", ItemKind::OpenText, false);
  add("points", ItemKind::Rating);
  show("nl");
  go_on();
  EXPECT_FALSE(answers_);
  EXPECT_EQ(complaint("one"), "Gelieve deze vraag te beantwoorden.");
  EXPECT_EQ(complaint("remarks"), "");
  EXPECT_EQ(complaint("points"), "Gelieve deze vraag te beantwoorden.");
  key("one", Qt::Key_1);
  EXPECT_EQ(complaint("one"), "");
  key("points", Qt::Key_7);
  go_on();
  EXPECT_EQ(answers_, (Answers{"few", "", "7"}));
}

TEST_F(StudyQuestionsTest, ANumberOutOfItsRangeIsToldTheRange) {
  Item& age = add("age", ItemKind::Number);
  age.least = 16.0;
  age.most = 99.0;
  show();
  for (const char* text : {"", "12", "many", "100"}) {
    field<QLineEdit>("age").setText(text);
    go_on();
    EXPECT_FALSE(answers_) << text;
    EXPECT_EQ(complaint("age"), "Please give a number from 16 to 99.") << text;
  }
  field<QLineEdit>("age").setText("16");
  go_on();
  EXPECT_EQ(answers_, Answers{"16"});
}

TEST_F(StudyQuestionsTest, EnterLeadsToWhatIsStillToBeAnsweredAndThenOn) {
  add("one", ItemKind::Choice);
  add("remarks", ItemKind::OpenText, false);
  add("two", ItemKind::Choice);
  show();
  key("one", Qt::Key_1);
  QTest::keyClick(page_->focusWidget(), Qt::Key_Return);
  EXPECT_FALSE(answers_);
  EXPECT_TRUE(question("two").isAncestorOf(page_->focusWidget()));
  QTest::keyClick(page_->focusWidget(), Qt::Key_3);
  QTest::keyClick(page_->focusWidget(), Qt::Key_Return);
  EXPECT_EQ(answers_, (Answers{"few", "", "many"}));
}

TEST_F(StudyQuestionsTest, InATextEnterIsALineAndCtrlEnterGoesOn) {
  add("remarks", ItemKind::OpenText);
  show();
  auto& text = field<QPlainTextEdit>("remarks");
  QTest::keyClicks(&text, "1st");
  QTest::keyClick(&text, Qt::Key_Return);
  QTest::keyClicks(&text, "2nd");
  EXPECT_FALSE(answers_);
  QTest::keyClick(&text, Qt::Key_Return, Qt::ControlModifier);
  EXPECT_EQ(answers_, Answers{"1st\n2nd"});
}

TEST_F(StudyQuestionsTest, AKeyThatChoosesNothingChangesNothing) {
  add("one", ItemKind::Choice, false);
  show();
  key("one", Qt::Key_4);
  key("one", Qt::Key_0);
  go_on();
  EXPECT_EQ(answers_, Answers{""});
}

TEST_F(StudyQuestionsTest, AScaleOfManyPointsIsNoAnswerBeforeItIsMoved) {
  add("points", ItemKind::Rating).points = 101;
  show();
  go_on();
  EXPECT_FALSE(answers_);
  EXPECT_EQ(complaint("points"), "Please answer this question.");
  field<QSlider>("points").setValue(72);
  go_on();
  EXPECT_EQ(answers_, Answers{"72"});
}

}  // namespace
}  // namespace icome::ui
