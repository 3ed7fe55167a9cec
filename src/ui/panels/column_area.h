#pragma once
#include <QScrollArea>

namespace icome::ui {

/// A scroll area for a column of widgets; never narrower than its content and its scroll bar together.
class ColumnArea final : public QScrollArea {
 public:
  explicit ColumnArea(QWidget* parent);

  QSize minimumSizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace icome::ui
