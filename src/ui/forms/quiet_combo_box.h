#pragma once
#include <QComboBox>
#include <QKeyEvent>
#include <QWheelEvent>

namespace icome::ui {

/// A combo box that the wheel changes only while it has the keyboard's focus; otherwise the wheel scrolls the
/// panel. Letters choose an item, even where they are shortcuts. Long items do not widen the panel.
class QuietComboBox final : public QComboBox {
 public:
  explicit QuietComboBox(QWidget* parent) : QComboBox(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(6);
  }

 protected:
  bool event(QEvent* event) override {
    if (event->type() == QEvent::ShortcutOverride) {
      const auto& key = static_cast<const QKeyEvent&>(*event);
      const bool plain = (key.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
      if (plain && !key.text().isEmpty() && key.text()[0].isPrint()) event->accept();
    }
    return QComboBox::event(event);
  }
  void wheelEvent(QWheelEvent* event) override {
    hasFocus() ? QComboBox::wheelEvent(event) : event->ignore();
  }
};

}  // namespace icome::ui
