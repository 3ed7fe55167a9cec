#pragma once
#include <QLabel>

namespace icome::ui {

/// A line of plain text that is elided at its end where it does not fit, rather than asking for more room.
class ElidedLabel final : public QLabel {
 public:
  explicit ElidedLabel(QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
};

}  // namespace icome::ui
