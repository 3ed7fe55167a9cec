#include "ui/panels/column_area.h"

#include <QEvent>
#include <QScrollBar>
#include <algorithm>

#include "ui/look/theme.h"

namespace icome::ui {

ColumnArea::ColumnArea(QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

QSize ColumnArea::minimumSizeHint() const {
  constexpr int kNarrowest = 64 * kGrid;
  const QSize own = QScrollArea::minimumSizeHint();
  const int within = widget() ? widget()->minimumSizeHint().width() : 0;
  return {std::max(kNarrowest, within + verticalScrollBar()->sizeHint().width()), own.height()};
}

/// Updates the least width when the widget in it becomes wider or narrower.
bool ColumnArea::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

}  // namespace icome::ui
