#include "ui/window/banner_row.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kMark = 4;  // pixels, the coloured edge

QColor mark_colour(Note::Weight weight) {
  switch (weight) {
    case Note::Weight::Error:
      return colours().bad;
    case Note::Weight::Warning:
      return colours().warning;
    default:
      return colours().accent;
  }
}

QLabel* make_text(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setObjectName("banner.text");
  label->setTextFormat(Qt::PlainText);  // it may quote names from files
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // no name widens the window
  policy.setHeightForWidth(true);
  label->setSizePolicy(policy);
  return label;
}

}  // namespace

BannerStrip::BannerStrip(Note::Weight weight, QWidget* parent) : QFrame(parent), weight_(weight) {
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(kMark + 3 * kGrid, kGrid, 2 * kGrid, kGrid + 1);
  whole->setSpacing(kGrid);
  line_ = new QHBoxLayout;
  line_->setSpacing(2 * kGrid);
  whole->addLayout(line_);
}

void BannerStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colours().window);
  painter.fillRect(QRect(0, height() - 1, width(), 1), colours().line);
  painter.fillRect(QRect(0, 0, kMark, height() - 1), mark_colour(weight_));
}

BannerRow::BannerRow(const Note& note, QWidget* parent) : BannerStrip(note.weight, parent), note_(note) {
  setObjectName("banner.note");
  const QString text = QString::fromStdString(note.text);
  setAccessibleName(text);
  line()->addWidget(make_text(text, this), 1);
  if (!note.details.empty()) add_details();
  for (const Note::Remedy remedy : note.remedies) {
    auto* button = new QPushButton(label(remedy), this);
    button->setObjectName(QString("banner.") + label(remedy));
    button->setAutoDefault(false);
    connect(button, &QPushButton::clicked, this, [this, remedy] { remedy_(remedy); });
    line()->addWidget(button);
  }
  auto* close = new QToolButton(this);
  close->setObjectName("banner.close");
  close->setIcon(style()->standardIcon(QStyle::SP_TitleBarCloseButton));
  close->setAutoRaise(true);
  close->setFocusPolicy(Qt::StrongFocus);
  close->setToolTip("Close this message");
  close->setAccessibleName("Close this message");
  connect(close, &QToolButton::clicked, this, [this] { close_(); });
  line()->addWidget(close);
}

void BannerRow::add_details() {
  auto* more = new QPushButton("Details", this);
  more->setObjectName("banner.details");
  more->setCheckable(true);
  more->setAutoDefault(false);
  line()->addWidget(more);
  auto* list = new QPlainTextEdit(this);
  list->setObjectName("banner.list");
  list->setAccessibleName("Details");
  list->setReadOnly(true);
  list->setTabChangesFocus(true);
  QStringList lines;
  for (const std::string& it : note_.details) lines << QString::fromStdString(it);
  list->setPlainText(lines.join('\n'));
  constexpr int kMostLines = 8;
  const int shown = std::min(int(lines.size()), kMostLines);
  list->setFixedHeight((shown + 1) * list->fontMetrics().lineSpacing() + 2 * list->frameWidth());
  list->hide();
  layout()->addWidget(list);
  connect(more, &QPushButton::toggled, list, [list](bool on) { list->setVisible(on); });
}

ProgressRow::ProgressRow(const std::function<void()>& cancel, QWidget* parent)
    : BannerStrip(Note::Weight::Plain, parent), can_be_cancelled_(cancel != nullptr) {
  setObjectName("banner.progress");
  text_ = make_text("", this);
  bar_ = new QProgressBar(this);
  bar_->setObjectName("banner.bar");
  bar_->setTextVisible(false);
  bar_->setMinimumWidth(20 * kGrid);
  bar_->setMaximumWidth(60 * kGrid);
  line()->addWidget(text_, 2);
  line()->addWidget(bar_, 1);
  if (!cancel) return;
  auto* button = new QPushButton("Cancel", this);
  button->setObjectName("banner.cancel");
  button->setAutoDefault(false);
  connect(button, &QPushButton::clicked, this, [cancel] { cancel(); });
  line()->addWidget(button);
}

void ProgressRow::report(const QString& text, std::optional<double> part) {
  constexpr int kSteps = 1000;
  text_->setText(text);
  setAccessibleName(text);
  bar_->setRange(0, part ? kSteps : 0);
  if (part) bar_->setValue(int(kSteps * *part));
}

}  // namespace icome::ui
