#include "ui/panels/wrapped_label.h"

#include <QEvent>
#include <algorithm>

namespace icome::ui {

WrappedLabel::WrappedLabel(const QString& text, QWidget* parent) : QLabel(text, parent) {
  setTextFormat(Qt::PlainText);
  setWordWrap(true);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
}

void WrappedLabel::say(const QString& text) {
  if (text == this->text()) return;
  setText(text);
  fit();
}

void WrappedLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fit();
}

void WrappedLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) fit();
}

void WrappedLabel::fit() {
  // What it needs is never told as less than the minimum that it has.
  setMinimumHeight(0);
  setMinimumHeight(std::max(0, heightForWidth(width())));
}

}  // namespace icome::ui
