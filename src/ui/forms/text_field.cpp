#include "ui/forms/text_field.h"

#include <QKeyEvent>

#include "ui/look/theme.h"

namespace icome::ui {

TextField::TextField(QWidget* parent) : QLineEdit(parent) {
  setMinimumWidth(12 * kGrid);
  setTextMargins(2, 0, 2, 0);
  connect(this, &QLineEdit::textEdited, this, [this] {
    edited_ = this->text() != QString::fromStdString(text_.value_or(""));
    mark(false);
  });
}

void TextField::show_text(std::optional<std::string> text) {
  text_ = std::move(text);
  if (!(edited_ && hasFocus())) restore();
}

void TextField::restore() {
  edited_ = false;
  mark(false);
  setPlaceholderText(text_ ? QString() : QString("mixed"));
  const QString shown = QString::fromStdString(text_.value_or(""));
  // Setting the text clears its undo history: typing that was committed is not undone letter by letter.
  if (shown == text() && !isUndoAvailable() && !isRedoAvailable()) return;
  setText(shown);
  setCursorPosition(0);
}

void TextField::mark(bool refused) {
  if (property("refused").toBool() == refused) return;
  setProperty("refused", refused);
  update();
}

void TextField::commit_text() {
  if (!edited_ || !commit_) return;
  const std::string typed = text().simplified().toStdString();
  edited_ = false;
  const auto done = commit_(typed);
  if (done) {
    text_ = typed;
    restore();
  } else {
    edited_ = true;
    mark(true);
  }
  if (refused_) refused_(done ? QString() : QString::fromStdString(done.error().message));
}

bool TextField::finish() {
  commit_text();
  return !edited_;
}

void TextField::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return commit_text();
  if (event->key() == Qt::Key_Escape && edited_) return restore();
  QLineEdit::keyPressEvent(event);
}

void TextField::focusOutEvent(QFocusEvent* event) {
  commit_text();
  QLineEdit::focusOutEvent(event);
}

}  // namespace icome::ui
