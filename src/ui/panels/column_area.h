#pragma once
#include <QScrollArea>

namespace icome::ui {

/// Scrolls what is too long, and is never narrower than what is in it beside its scroll bar.
class ColumnArea final : public QScrollArea {
 public:
  explicit ColumnArea(QWidget* parent);

  QSize minimumSizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace icome::ui
