#include "ui/study/study_page.h"

#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QRegularExpression>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kColumnWidth = 210 * kGrid;
constexpr double kTitleSize = 1.7;  // times the text's
constexpr double kHintSize = 0.75;

QLabel* text_label(const QString& text, double size, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  QFont font = label->font();
  font.setPointSizeF(size * font.pointSizeF());
  label->setFont(font);
  return label;
}

/// A row with the widget in its middle, no wider than a line that is good to read.
QLayout* centred(QWidget* widget) {
  auto* row = new QHBoxLayout;
  row->setContentsMargins(12 * kGrid, 0, 12 * kGrid, 0);
  widget->setMaximumWidth(kColumnWidth);
  row->addStretch(1);
  row->addWidget(widget, 1000);
  row->addStretch(1);
  return row;
}

}  // namespace

StudyButton::StudyButton(const QString& text, bool main, QWidget* parent)
    : QPushButton(text, parent), main_(main) {
  const QSize its = fontMetrics().size(Qt::TextShowMnemonic, text);
  setMinimumSize(its.width() + 14 * kGrid, its.height() + 6 * kGrid);
}

void StudyButton::paintEvent(QPaintEvent* event) {
  if (!main_ || !isEnabled()) return QPushButton::paintEvent(event);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const ThemeColours& theme = colours();
  const QRectF room = QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5);
  painter.setPen(Qt::NoPen);
  painter.setBrush(isDown()       ? theme.accent_text.darker(120)
                   : underMouse() ? theme.accent_text.lighter(115)
                                  : theme.accent_text);
  painter.drawRoundedRect(room, kGrid, kGrid);
  painter.setPen(theme.base);
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(room.adjusted(3.0, 3.0, -3.0, -3.0), kGrid - 2.0, kGrid - 2.0);
  }
  painter.drawText(rect(), Qt::AlignCenter | Qt::TextShowMnemonic, text());
}

StudyPage::StudyPage(const QString& title, QWidget* parent)
    : QWidget(parent), area_(new QScrollArea(this)), hint_(text_label({}, kHintSize, this)) {
  auto* inside = new QWidget(area_);
  auto* column = new QWidget(inside);
  column_ = new QVBoxLayout(column);
  column_->setContentsMargins(0, 12 * kGrid, 0, 8 * kGrid);
  column_->setSpacing(5 * kGrid);
  QLabel* const heading = text_label(title, kTitleSize, column);
  heading->setObjectName("study.title");
  column_->addWidget(heading);
  auto* middle = new QVBoxLayout(inside);
  middle->setContentsMargins(0, 0, 0, 0);
  middle->addStretch(2);
  middle->addLayout(centred(column));
  middle->addStretch(3);
  area_->setWidgetResizable(true);
  area_->setFrameShape(QFrame::NoFrame);
  area_->setFocusPolicy(Qt::NoFocus);
  area_->setWidget(inside);

  auto* below = new QWidget(this);
  auto* row = new QHBoxLayout(below);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4 * kGrid);
  row->addStretch();
  buttons_ = row;
  hint_->setForegroundRole(QPalette::PlaceholderText);
  hint_->setAlignment(Qt::AlignHCenter);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 6 * kGrid);
  rows->setSpacing(6 * kGrid);
  rows->addWidget(area_, 1);
  rows->addLayout(centred(below));
  rows->addLayout(centred(hint_));
}

void StudyPage::add_text(const QString& text) {
  static const QRegularExpression kEmptyLine("\\n\\s*\\n");
  for (const QString& paragraph : text.split(kEmptyLine, Qt::SkipEmptyParts)) {
    auto* label = text_label(paragraph.trimmed(), 1.0, this);
    label->setObjectName("study.text");
    column_->addWidget(label);
  }
}

void StudyPage::add_field(QWidget* field) { column_->addWidget(field); }

void StudyPage::show_field(QWidget* field) { area_->ensureWidgetVisible(field, 0, 6 * kGrid); }

void StudyPage::add_button(const QString& text, std::function<void()> pressed) {
  auto* button = new StudyButton(text, false, this);
  button->setObjectName("study.button");
  connect(button, &QPushButton::clicked, this, std::move(pressed));
  buttons_->addWidget(button);
}

void StudyPage::add_main_button(const QString& text, std::function<void()> pressed) {
  main_ = new StudyButton(text, true, this);
  main_->setObjectName("study.main");
  connect(main_, &QPushButton::clicked, this, std::move(pressed));
  buttons_->addWidget(main_);
}

void StudyPage::show_hint(const QString& text) { hint_->setText(text); }

void StudyPage::take_keyboard() {
  main_ && main_->isEnabled() ? main_->setFocus(Qt::OtherFocusReason) : setFocus(Qt::OtherFocusReason);
}

void StudyPage::enter() {
  if (main_) main_->click();
}

bool StudyPage::scroll(int key) {
  QScrollBar* const bar = area_->verticalScrollBar();
  switch (key) {
    case Qt::Key_PageDown:
      bar->triggerAction(QAbstractSlider::SliderPageStepAdd);
      return true;
    case Qt::Key_PageUp:
      bar->triggerAction(QAbstractSlider::SliderPageStepSub);
      return true;
    default:
      return false;
  }
}

void StudyPage::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter)
    return event->setAccepted(scroll(event->key()));
  // A key that is held down must not run through the study.
  if (event->isAutoRepeat()) return;
  auto* const button = dynamic_cast<StudyButton*>(window()->focusWidget());
  button&& isAncestorOf(button) ? button->click() : enter();
}

StudyRestPage::StudyRestPage(const QString& title, QString left, QWidget* parent)
    : StudyPage(title, parent),
      words_(std::move(left)),
      left_(text_label({}, 1.0, this)),
      timer_(new QTimer(this)) {
  left_->setObjectName("study.left");
  connect(timer_, &QTimer::timeout, this, [this] { count_down(); });
}

void StudyRestPage::wait(double seconds) {
  add_field(left_);
  end_ = base::steady_nanoseconds() + std::int64_t(1e9 * seconds);
  main_button()->setEnabled(false);
  timer_->start(100);
  count_down();
}

void StudyRestPage::end_wait() {
  timer_->stop();
  left_->clear();
  main_button()->setEnabled(true);
  if (isVisible()) take_keyboard();  // not from a page that covers it
}

void StudyRestPage::count_down() {
  const std::int64_t left = end_ - base::steady_nanoseconds();
  if (left <= 0) return end_wait();
  const auto seconds = int(std::ceil(1e-9 * double(left)));
  left_->setText(words_.arg(QString("%1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QChar('0'))));
}

}  // namespace icome::ui
