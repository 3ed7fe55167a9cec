#pragma once
#include <QAbstractScrollArea>
#include <functional>
#include <memory>

#include "ui/cutout/time/time_rows.h"

namespace icome::ui {

/// The exposure sheet (X-sheet): frames downwards, and for each cell a column with the picture that is
/// exposed. A picture is chosen by its number and Enter, or from a list. The document outlives it.
class ExposureSheet final : public QAbstractScrollArea {
 public:
  ExposureSheet(CutoutDocument& document, QWidget* parent);

  void refresh();
  /// Shows the present frame, and scrolls to it.
  void follow_frame();
  void show_sound(std::shared_ptr<const SoundShape> shape);
  /// Asks for the mark of a frame.
  void on_mark(std::function<void(int frame)> mark) { mark_ = std::move(mark); }

  /// A column of the sheet: a cell's.
  struct Column {
    CellId cell;
    animation::LayerId layer;
    QString name;
  };
  const std::vector<Column>& columns() const { return columns_; }
  /// The middle of a box, pixels of the viewport.
  QPointF place_of(std::size_t column, int frame) const;
  /// Exposes a picture (-1: none) of a cell from a frame on, until the next one is.
  void expose(CellId cell, int frame, int picture);

 protected:
  bool viewportEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void scrollContentsBy(int dx, int dy) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  int frame_at(double y) const;
  double top_of(int frame) const;
  double left_of(std::size_t column) const;
  std::optional<std::size_t> column_at(double x) const;
  std::size_t chosen_column() const;
  void choose_column(std::size_t column);
  void type_digit(const QString& digit);
  void end_typing(bool use);
  void show_pictures(QPoint at);
  void set_bars();
  void paint_heads(QPainter& painter);
  void paint_margin(QPainter& painter, int first, int last);
  void paint_column(QPainter& painter, std::size_t column, int first, int last);
  void paint_box(QPainter& painter, const animation::Cell& cell, int frame, const QRectF& box, bool is_first);

  CutoutDocument& document_;
  std::vector<Column> columns_;
  std::shared_ptr<const SoundShape> sound_;
  QString typed_;  // a picture's number, while it is typed
  std::function<void(int)> mark_ = [](int) {};
};

/// The name of a picture as a sheet shows it: without its folder and ending.
QString short_picture_name(const animation::Cell& cell, int picture);

}  // namespace icome::ui
