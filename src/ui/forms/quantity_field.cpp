#include "ui/forms/quantity_field.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QStyle>
#include <QStyleOption>
#include <QToolTip>
#include <QWheelEvent>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {

QuantityField::QuantityField(Quantity quantity, QWidget* parent) : QLineEdit(parent), quantity_(quantity) {
  setAlignment(Qt::AlignRight);
  setMinimumWidth(12 * kGrid);
  setTextMargins(2, 0, 2, 0);
  connect(this, &QLineEdit::textEdited, this, [this] {
    edited_ = text() != shown_;
    mark(false);
    if (typing_) typing_();
  });
}

void QuantityField::allow_none(const QString& meaning) {
  none_ = meaning;
  setPlaceholderText(meaning);
}

void QuantityField::show_value(std::optional<double> value) {
  value_ = value;
  mixed_ = false;
  if (edited_ && hasFocus()) return;  // keeps what is being typed
  restore();
}

void QuantityField::show_mixed() {
  mixed_ = true;
  value_.reset();
  if (edited_ && hasFocus()) return;
  restore();
}

void QuantityField::restore() {
  edited_ = false;
  mark(false);
  setPlaceholderText(mixed_ ? QString("mixed") : none_.value_or(QString()));
  const QString text = value_ ? fitting_text(*value_) : QString();
  shown_ = text;
  // Setting the text clears its undo history: typing that was committed is not undone letter by letter.
  if (text == this->text() && !isUndoAvailable() && !isRedoAvailable()) return;
  setText(text);
  setCursorPosition(0);
  if (hasFocus()) selectAll();
}

/// Text with all digits while the field has the focus; else with as many decimals as there is room for. Where
/// not even the whole number fits, it is elided.
QString QuantityField::fitting_text(double value) const {
  QString text = number_text(value, quantity_);
  if (hasFocus()) return text;
  QStyleOptionFrame frame;
  initStyleOption(&frame);
  constexpr int kBesideText = 4;  // QLineEdit's own margins, which it does not tell
  const int room = style()->subElementRect(QStyle::SE_LineEditContents, &frame, this).width() -
                   textMargins().left() - textMargins().right() - kBesideText;
  const int decimals = int(text.size() - 1 - text.indexOf('.'));
  for (int fewer = decimals - 1; fewer >= 0 && text.contains('.'); --fewer) {
    if (fontMetrics().horizontalAdvance(text) <= room) break;
    text = number_text(value, quantity_, fewer);
  }
  return fontMetrics().elidedText(text, Qt::ElideRight, room);
}

/// Is the number shown without some of its digits?
bool QuantityField::shortened() const {
  return value_ && !edited_ && text() != number_text(*value_, quantity_);
}

bool QuantityField::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip || !shortened()) return QLineEdit::event(event);
  const QString number = number_text(*value_, quantity_);
  const QString tip = toolTip().isEmpty() ? number : toolTip() + '\n' + number;
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), tip, this);
  return true;
}

void QuantityField::mark(bool refused) {
  if (property("refused").toBool() == refused) return;
  setProperty("refused", refused);
  update();
}

base::Result<std::optional<double>> QuantityField::typed_value() const {
  if (!edited_) return value_;
  const QString typed = text().simplified();
  if (typed.isEmpty()) return none_ ? std::nullopt : value_;
  const auto value = read_quantity(typed, quantity_);
  return value ? base::Result<std::optional<double>>(*value) : tl::unexpected(value.error());
}

void QuantityField::commit_text() {
  if (!edited_) return;
  stepping_ = false;
  const QString typed = text().simplified();
  if (typed.isEmpty() && (mixed_ || !none_)) return restore();
  if (typed.isEmpty()) return commit(std::nullopt, false);
  const auto value = read_quantity(typed, quantity_);
  if (value) return commit(*value, false);
  refuse(value.error().message);
}

bool QuantityField::finish() {
  commit_text();
  stepping_ = false;
  return !edited_;
}

void QuantityField::commit(std::optional<double> value, bool more) {
  if (!commit_) return;
  const bool typed = edited_;
  edited_ = false;  // so that show_value() takes effect
  const QString text = this->text();
  const auto done = commit_(value, more);
  if (done) {
    value_ = value;
    mixed_ = false;
    restore();
    if (refused_) refused_({});
    return;
  }
  if (typed) setText(text);
  edited_ = typed;
  refuse(done.error().message);
}

void QuantityField::refuse(const std::string& why) {
  mark(edited_);
  if (!edited_) restore();
  if (refused_) refused_(QString::fromStdString(why));
}

void QuantityField::step(double steps, Qt::KeyboardModifiers modifiers) {
  if (isReadOnly() || mixed_) return;
  if (edited_) commit_text();
  if (edited_) return;  // refused
  double size = step_of(quantity_);
  if (modifiers & Qt::ShiftModifier) size *= 10.0;
  if (modifiers & Qt::ControlModifier) size *= 0.1;
  const bool more = stepping_;
  stepping_ = true;
  commit(value_.value_or(0.0) + steps * size, more);
}

void QuantityField::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Up:
      return step(1.0, event->modifiers());
    case Qt::Key_Down:
      return step(-1.0, event->modifiers());
    case Qt::Key_PageUp:
      return step(10.0, event->modifiers());
    case Qt::Key_PageDown:
      return step(-10.0, event->modifiers());
    case Qt::Key_Return:
    case Qt::Key_Enter:
      commit_text();
      stepping_ = false;
      selectAll();
      return;
    case Qt::Key_Escape:
      if (!edited_) break;
      restore();
      selectAll();
      if (typing_) typing_();
      return;
    default:
      break;
  }
  QLineEdit::keyPressEvent(event);
}

void QuantityField::focusInEvent(QFocusEvent* event) {
  if (!edited_) restore();
  QLineEdit::focusInEvent(event);
}

void QuantityField::focusOutEvent(QFocusEvent* event) {
  commit_text();
  stepping_ = false;
  QLineEdit::focusOutEvent(event);
  if (!edited_) restore();
}

void QuantityField::resizeEvent(QResizeEvent* event) {
  QLineEdit::resizeEvent(event);
  if (!edited_) restore();
}

void QuantityField::wheelEvent(QWheelEvent* event) {
  if (!hasFocus()) return event->ignore();  // the panel scrolls
  constexpr double kNotch = 120.0;
  wheel_ += event->angleDelta().y();
  const double steps = std::trunc(wheel_ / kNotch);
  wheel_ -= steps * kNotch;
  if (steps != 0.0) step(steps, event->modifiers() & ~Qt::AltModifier);
  event->accept();
}

}  // namespace icome::ui
