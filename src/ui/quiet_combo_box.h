#pragma once
#include <QComboBox>
#include <QWheelEvent>

namespace icome::ui {

/// Wheels scroll the panel, and do not change what they happen to be over; with the keyboard's focus they
/// choose. Long items do not widen the panel.
class QuietComboBox final : public QComboBox {
 public:
  explicit QuietComboBox(QWidget* parent) : QComboBox(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(6);
  }

 protected:
  void wheelEvent(QWheelEvent* event) override {
    hasFocus() ? QComboBox::wheelEvent(event) : event->ignore();
  }
};

}  // namespace icome::ui
