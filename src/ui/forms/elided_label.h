#pragma once
#include <QLabel>

namespace icome::ui {

/// A line of plain text that takes no more room than there is: what does not fit is left out at its end.
class ElidedLabel final : public QLabel {
 public:
  explicit ElidedLabel(QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
};

}  // namespace icome::ui
