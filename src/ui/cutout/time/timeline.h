#pragma once
#include <QAbstractScrollArea>
#include <functional>
#include <memory>

#include "ui/cutout/time/time_rows.h"

namespace icome::ui {

/// The keys of an animation over time: a row for marks, sound, each layer and cell, and its channels. The
/// document outlives it.
class Timeline final : public QAbstractScrollArea {
 public:
  Timeline(CutoutDocument& document, QWidget* parent);

  /// Shows the document as it is now.
  void refresh();
  /// Shows the present frame, and scrolls to it.
  void follow_frame();
  void show_sound(std::shared_ptr<const SoundShape> shape);
  void zoom(double factor);
  /// All frames side by side.
  void fit();

  /// Makes the menu of the keys under the pointer, which are selected.
  void on_menu(std::function<void(QPoint)> menu) { menu_ = std::move(menu); }
  /// Asks for the mark of a frame.
  void on_mark(std::function<void(int frame)> mark) { mark_ = std::move(mark); }

  // Places of the viewport, pixels; for tests, too.
  const std::vector<TimeRow>& rows() const { return rows_; }
  QPointF place_of(const TimeRow& row, int frame) const;
  QPointF ruler_place(int frame) const;

 protected:
  bool viewportEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void scrollContentsBy(int dx, int dy) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  enum class Contact : std::uint8_t { None, Scrub, Keys, Marquee, Shift };

  const TimeRow* row_under(QPointF at) const;
  KeyPlaces keys_under(QPointF at) const;
  void press_name(const TimeRow& row, QPointF at, bool more);
  void press_rows(QPointF at, bool more);
  void select_within();
  void go_under(double x);
  void set_bars();
  double row_y(const TimeRow& row) const;
  void paint_ruler(QPainter& painter);
  void paint_row(QPainter& painter, const TimeRow& row);
  void paint_name(QPainter& painter, const TimeRow& row, const QRectF& place);
  void paint_marks(QPainter& painter, const QRectF& place);
  void paint_sound(QPainter& painter, const QRectF& place);
  void paint_keys(QPainter& painter, const TimeRow& row, const QRectF& place);
  void paint_frame_line(QPainter& painter);

  CutoutDocument& document_;
  TimeFolds folds_;
  std::vector<TimeRow> rows_;
  FrameScale scale_;
  std::shared_ptr<const SoundShape> sound_;
  Contact contact_ = Contact::None;
  QPointF pressed_, last_;
  int moved_ = 0;  // frames that a drag moves keys by
  std::function<void(QPoint)> menu_ = [](QPoint) {};
  std::function<void(int)> mark_ = [](int) {};
};

}  // namespace icome::ui
