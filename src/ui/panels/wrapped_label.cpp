#include "ui/panels/wrapped_label.h"

#include <QEvent>

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
  const int wanted = heightForWidth(width());
  if (wanted > 0 && wanted != minimumHeight()) setMinimumHeight(wanted);
}

}  // namespace icome::ui
