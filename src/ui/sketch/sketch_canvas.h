#pragma once
#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <array>
#include <optional>

#include "sketch/feel/felt_pen.h"
#include "sketch/pen/mouse_pressure.h"
#include "ui/sketch/canvas_tool.h"
#include "ui/sketch/stroke_picture.h"

namespace icome::ui {

enum class SketchToolKind : std::uint8_t { Pen, Eraser, Pull, Lasso, Select, Width, Connect, Fill };
inline constexpr std::size_t kSketchToolCount = 8;

/// The paper of a drawing: shows it and what its tools do, and takes pen, mouse and keys. Document and look
/// outlive it.
class SketchCanvas final : public QWidget {
 public:
  SketchCanvas(SketchDocument& document, const SketchLook& look, QWidget* parent);

  void choose(SketchToolKind tool);
  SketchToolKind tool() const { return tool_; }
  /// Shows the document as it is now.
  void refresh();

  void fit();
  void zoom(double factor);   // about the middle
  void turn(double degrees);  // likewise, clockwise
  const PaperView& view() const { return view_; }
  /// Backs out of a drag, else of the selection.
  void back_out();
  /// Is something drawn or dragged now?
  bool is_busy() const { return contact_ == Contact::Tool; }

  /// Takes a pen that pushes back from now on, which outlives this; the mouse moves the hand of a simulated
  /// one. Null: none.
  void take_pen(sketch::FeltPen* pen);

  /// Hears of each place (m) that the pointer comes to, and of a pen's tilt (rad from upright).
  void on_pointer(std::function<void(const PenInput&)> pointer) { pointer_ = std::move(pointer); }

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void tabletEvent(QTabletEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  enum class Contact : std::uint8_t { None, Tool, Shift };

  CanvasTool& used() const;
  PenInput input_of(const QMouseEvent& event);
  PenInput input_of(const QTabletEvent& event) const;
  void begin(const PenInput& input, bool shifts);
  void go_on(const PenInput& input);
  void end(const PenInput& input);
  bool moves_pen(const QMouseEvent& event);
  void read_pen();
  void follow_pen(const sketch::PenReading& reading, bool is_last);
  void paint_pen(QPainter& painter) const;
  void change_view(const std::function<void(PaperView&)>& change);
  void renew_picture();
  void paint_onion(QPainter& painter);
  bool move_selection(const QKeyEvent& event);
  void show_cursor();

  SketchDocument& document_;
  const SketchLook& look_;
  PaperView view_;
  SketchBench bench_;
  std::array<std::unique_ptr<CanvasTool>, kSketchToolCount> tools_;
  SketchToolKind tool_ = SketchToolKind::Pen;
  StrokePicture picture_;
  std::vector<drawing::StrokePointer> onion_;  // what the last change took away
  double whole_picture_seconds_ = 0.0;         // what the last one took
  QTimer late_picture_;                        // while the view changes and pictures take long
  Contact contact_ = Contact::None;
  bool pen_is_down_ = false;  // that of a tablet
  bool eraser_end_ = false;   // of the pen that is down
  sketch::FeltPen* felt_pen_ = nullptr;
  QTimer pen_timer_;                        // reads it
  std::optional<sketch::PenReading> felt_;  // its last reading
  bool is_fitted_ = true;                   // the paper is seen whole, also when the canvas changes its size
  bool space_ = false, r_ = false;          // keys that are held
  PenInput last_;
  sketch::MousePressure mouse_;
  std::function<void(const PenInput&)> pointer_ = [](const PenInput&) {};
};

}  // namespace icome::ui
