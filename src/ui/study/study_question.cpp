#include "ui/study/study_question.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QRadioButton>
#include <QRegularExpression>
#include <QSlider>
#include <QStyle>
#include <QVBoxLayout>

#include "study/run/session_run.h"
#include "ui/look/theme.h"

namespace icome::ui {

using study::Item;
using study::ItemKind;

namespace {

constexpr int kMostButtons = 11;  // of a rating: more could not be told apart

/// A field for several lines of text; Tab leaves it, and Ctrl+Enter is left to the page.
class AnswerText final : public QPlainTextEdit {
 public:
  explicit AnswerText(QWidget* parent) : QPlainTextEdit(parent) {
    setTabChangesFocus(true);
    setFixedHeight(4 * fontMetrics().lineSpacing() + 6 * kGrid);
  }

 protected:
  void keyPressEvent(QKeyEvent* event) override {
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (enter && event->modifiers().testFlag(Qt::ControlModifier)) return event->ignore();
    QPlainTextEdit::keyPressEvent(event);
  }
};

/// "1,5" is a number as well; "1,000" and "1.000" are made invalid, as each may mean two numbers.
std::string typed_number(const QString& text) {
  static const QRegularExpression kThousands("^[+-]?[1-9][0-9]{0,2}([.,][0-9]{3})+$");
  const QString number = text.trimmed();
  return kThousands.match(number).hasMatch() ? number.toStdString() + "?"
                                             : QString(number).replace(',', '.').toStdString();
}

QString shown_number(double number) { return QString::number(number, 'g', 10); }

/// The text broken into lines: buttons do not break lines themselves, and would cut the text off.
QString in_lines(const QString& text) {
  constexpr qsizetype kLongestLine = 64;  // letters, which fit into any window that people read in
  QString lines;
  qsizetype length = 0;
  for (const QString& word : text.split(' ')) {
    const bool fits = length == 0 || length + 1 + word.size() <= kLongestLine;
    if (!lines.isEmpty()) lines += fits ? ' ' : '\n';
    length = fits && length > 0 ? length + 1 + word.size() : word.size();
    lines += word;
  }
  return lines;
}

QLabel* note_label(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

}  // namespace

StudyQuestion::StudyQuestion(const Item& item, std::size_t language, const StudyWords& words, QWidget* parent)
    : QWidget(parent),
      item_(item),
      language_(language),
      words_(words),
      rows_(new QVBoxLayout(this)),
      complaint_(new QLabel(this)) {
  setObjectName("study." + QString::fromStdString(item.id));
  rows_->setContentsMargins(0, 0, 0, 3 * kGrid);
  rows_->setSpacing(3 * kGrid);
  auto* question = new QLabel(study_text(item.text, language) + (item.required ? " *" : ""), this);
  question->setTextFormat(Qt::PlainText);
  question->setWordWrap(true);
  QFont font = question->font();
  font.setWeight(QFont::DemiBold);
  question->setFont(font);
  rows_->addWidget(question);
  switch (item.kind) {
    case ItemKind::Choice:
      add_choices(false);
      break;
    case ItemKind::Choices:
      rows_->addWidget(note_label(words_(StudyWord::SeveralAnswers), this));
      add_choices(true);
      break;
    case ItemKind::Rating:
      item.points <= kMostButtons ? add_rating() : add_slider();
      add_ends();
      break;
    case ItemKind::Number:
      add_number();
      break;
    case ItemKind::OpenText:
      add_open_text();
      break;
  }
  first_->setAccessibleDescription(question->text());
  complaint_->setObjectName("complaint");
  complaint_->setTextFormat(Qt::PlainText);
  complaint_->setWordWrap(true);
  QPalette red = complaint_->palette();
  red.setColor(QPalette::WindowText, colours().bad_text);
  complaint_->setPalette(red);
  complaint_->hide();
  rows_->addWidget(complaint_);
}

void StudyQuestion::add_choices(bool several) {
  buttons_ = new QButtonGroup(this);
  buttons_->setExclusive(!several);
  for (const study::Level& choice : item_.choices) {
    const QString name = in_lines(study_text(choice.name, language_)).replace('&', "&&");
    QAbstractButton* const button =
        several ? static_cast<QAbstractButton*>(new QCheckBox(name, this)) : new QRadioButton(name, this);
    buttons_->addButton(button, int(buttons_->buttons().size()));
    rows_->addWidget(button, 0, Qt::AlignLeft);
  }
  connect(buttons_, &QButtonGroup::idToggled, this, [this] { forgive(); });
  first_ = buttons_->button(0);
  answer_ = [this] { return chosen(); };
}

/// Ids of the chosen answers, with a comma between several.
std::string StudyQuestion::chosen() const {
  std::string ids;
  for (std::size_t i = 0; i < item_.choices.size(); ++i) {
    if (!buttons_->button(int(i))->isChecked()) continue;
    if (!ids.empty()) ids += ',';
    ids += item_.choices[i].id;
  }
  return ids;
}

void StudyQuestion::add_rating() {
  buttons_ = new QButtonGroup(this);
  auto* row = new QHBoxLayout;
  for (int point = 1; point <= item_.points; ++point) {
    auto* button = new QRadioButton(QString::number(point), this);
    buttons_->addButton(button, point - 1);
    row->addWidget(button);
    if (point < item_.points) row->addStretch();
  }
  rows_->addLayout(row);
  connect(buttons_, &QButtonGroup::idToggled, this, [this] { forgive(); });
  first_ = buttons_->button(0);
  answer_ = [this] {
    const int checked = buttons_->checkedId();
    return checked < 0 ? std::string() : std::to_string(checked + 1);
  };
}

/// The slider counts only once it was moved or released: its first place is nobody's answer.
void StudyQuestion::add_slider() {
  auto* slider = new QSlider(Qt::Horizontal, this);
  slider->setRange(1, item_.points);
  slider->setValue((1 + item_.points) / 2);
  auto* shown = new QLabel("\u2013", this);
  shown->setAlignment(Qt::AlignHCenter);
  const auto choose = [this, slider, shown] {
    shown->setText(QString::number(slider->value()));
    forgive();
  };
  connect(slider, &QSlider::valueChanged, this, choose);
  connect(slider, &QSlider::sliderReleased, this, choose);
  rows_->addWidget(shown);
  rows_->addWidget(slider);
  first_ = slider;
  answer_ = [shown] {
    bool chosen = false;
    const int point = shown->text().toInt(&chosen);
    return chosen ? std::to_string(point) : std::string();
  };
}

/// Adds the meanings of the two ends of a rating scale.
void StudyQuestion::add_ends() {
  auto* row = new QHBoxLayout;
  QLabel* const low = note_label(study_text(item_.low, language_), this);
  QLabel* const high = note_label(study_text(item_.high, language_), this);
  high->setAlignment(Qt::AlignRight);
  row->addWidget(low, 1);
  row->addWidget(high, 1);
  rows_->addLayout(row);
}

void StudyQuestion::add_number() {
  auto* line = new QLineEdit(this);
  line->setFixedWidth(50 * kGrid);
  line->setTextMargins(kGrid, kGrid, kGrid, kGrid);
  if (item_.least && item_.most)
    line->setPlaceholderText(shown_number(*item_.least) + " \u2013 " + shown_number(*item_.most));
  connect(line, &QLineEdit::textChanged, this, [this] { forgive(); });
  auto* row = new QHBoxLayout;
  row->addWidget(line);
  row->addWidget(note_label(QString::fromStdString(item_.unit), this), 1);
  rows_->addLayout(row);
  first_ = line;
  answer_ = [line] { return typed_number(line->text()); };
}

void StudyQuestion::add_open_text() {
  auto* text = new AnswerText(this);
  connect(text, &QPlainTextEdit::textChanged, this, [this] { forgive(); });
  rows_->addWidget(text);
  first_ = text;
  answer_ = [text] { return text->toPlainText().trimmed().toStdString(); };
}

QString StudyQuestion::why_no_number() const {
  const auto number = [](double value) { return shown_number(value); };
  if (item_.least && item_.most)
    return words_(StudyWord::NumberBetween).arg(number(*item_.least), number(*item_.most));
  if (item_.least) return words_(StudyWord::NumberFrom).arg(number(*item_.least));
  if (item_.most) return words_(StudyWord::NumberUpTo).arg(number(*item_.most));
  return words_(StudyWord::NumberMissing);
}

/// The reason why the answer cannot be taken, in the person's language; empty: it can.
QString StudyQuestion::why() const {
  const std::string its = answer();
  if (study::why_no_answer(item_, its).empty()) return {};
  return item_.kind == ItemKind::Number ? why_no_number() : words_(StudyWord::AnswerMissing);
}

bool StudyQuestion::refuse() {
  const QString reason = why();
  complaint_->setText(reason);
  complaint_->setVisible(!reason.isEmpty());
  first_->setProperty("refused", !reason.isEmpty());
  first_->update();
  return !reason.isEmpty();
}

void StudyQuestion::forgive() {
  if (complaint_->isHidden()) return;
  complaint_->hide();
  first_->setProperty("refused", false);
  first_->update();
}

void StudyQuestion::take_keyboard() {
  QWidget* const checked = buttons_ ? buttons_->checkedButton() : nullptr;
  (checked ? checked : first_)->setFocus(Qt::TabFocusReason);
}

void StudyQuestion::keyPressEvent(QKeyEvent* event) {
  const int digit = event->key() - Qt::Key_0;
  QAbstractButton* const button =
      buttons_ && digit >= 1 && digit <= 9 ? buttons_->button(digit - 1) : nullptr;
  if (!button) return event->ignore();
  button->setFocus(Qt::ShortcutFocusReason);
  button->click();
}

}  // namespace icome::ui
