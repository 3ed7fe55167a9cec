#include "ui/sketch/sketch_canvas.h"

#include <QApplication>
#include <QKeyEvent>
#include <QPaintEvent>
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "ui/look/theme.h"
#include "ui/sketch/selection_frame.h"

namespace icome::ui {
namespace {

constexpr double kWheelZoom = 1.0015;           // for an eighth of a degree
constexpr double kWheelTurn = 0.125;            // degrees for an eighth of a degree: a notch turns by 15
constexpr double kQuickPicture = 0.012;         // s: pictures that take longer wait until the view rests
constexpr int kViewRests = 120;                 // ms
constexpr double kPixelMetres = 0.0254 / 96.0;  // of a device-independent pixel
constexpr double kConstantPressure = 0.5;       // of a mouse whose speed does not count
constexpr int kPenReadings = 8;                 // ms from one look at a pen that pushes back to the next
constexpr double kOnionOpacity = 0.25;
constexpr double kArrowKeyStep = 1.0;  // mm; with Shift ten times as far
constexpr double kDegreesToRadians = 0.017453292519943295;

Qt::CursorShape cursor_of(SketchToolKind tool) {
  switch (tool) {
    case SketchToolKind::Pen:
    case SketchToolKind::Eraser:
    case SketchToolKind::Lasso:
      return Qt::CrossCursor;
    case SketchToolKind::Pull:
    case SketchToolKind::Connect:
      return Qt::PointingHandCursor;
    case SketchToolKind::Width:
      return Qt::SizeVerCursor;
    case SketchToolKind::Select:
    case SketchToolKind::Fill:
      break;
  }
  return Qt::ArrowCursor;
}

}  // namespace

SketchCanvas::SketchCanvas(SketchDocument& document, const SketchLook& look, QWidget* parent)
    : QWidget(parent),
      document_(document),
      look_(look),
      bench_{document_,
             look_,
             view_,
             [this](const QRect& part) { update(part); },
             [this] { return size(); },
             [this] { return devicePixelRatioF(); }},
      tools_{make_pen_tool(bench_),     make_eraser_tool(bench_), make_pull_tool(bench_),
             make_lasso_tool(bench_),   make_select_tool(bench_), make_width_tool(bench_),
             make_connect_tool(bench_), make_fill_tool(bench_)} {
  setObjectName("canvas");
  setAccessibleName("Paper");
  setAccessibleDescription("Draw with a pen or the mouse. Arrow keys move what is selected.");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setTabletTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(40 * kGrid, 40 * kGrid);
  late_picture_.setSingleShot(true);
  connect(&late_picture_, &QTimer::timeout, this, [this] { renew_picture(); });
  pen_timer_.setTimerType(Qt::PreciseTimer);
  connect(&pen_timer_, &QTimer::timeout, this, [this] { read_pen(); });
  // A pen that leaves is told to the application only.
  QApplication::instance()->installEventFilter(this);
  show_cursor();
}

CanvasTool& SketchCanvas::used() const {
  return *tools_[std::size_t(eraser_end_ ? SketchToolKind::Eraser : tool_)];
}

void SketchCanvas::choose(SketchToolKind tool) {
  if (contact_ == Contact::Tool) end(last_);
  contact_ = Contact::None;
  tool_ = tool;
  show_cursor();
  update();
}

void SketchCanvas::show_cursor() { setCursor(space_ ? Qt::OpenHandCursor : cursor_of(tool_)); }

// Painting.

void SketchCanvas::refresh() {
  onion_.clear();
  if (look_.onion) {
    std::unordered_set<const drawing::Stroke*> there;
    for (const drawing::Layer& layer : document_.shown().layers)
      for (const auto& stroke : layer.strokes) there.insert(stroke.get());
    for (const drawing::Layer& layer : document_.before().layers)
      for (const auto& stroke : layer.strokes)
        if (layer.visible && !there.contains(stroke.get())) onion_.push_back(stroke);
  }
  if (felt_pen_ != nullptr) felt_pen_->resize(document_.drawing().size);
  // The paper may be another one.
  if (is_fitted_ && contact_ == Contact::None) view_.fit(document_.drawing().size, size());
  renew_picture();
}

void SketchCanvas::renew_picture() {
  late_picture_.stop();
  const bool is_shifted = picture_.can_shift_to(view_);
  QElapsedTimer time;
  time.start();
  const QRect part = picture_.show(document_.shown(), view_, size(), devicePixelRatioF());
  if (part == rect() && !is_shifted) whole_picture_seconds_ = 1e-9 * double(time.nsecsElapsed());
  update();
}

void SketchCanvas::change_view(const std::function<void(PaperView&)>& change) {
  if (contact_ == Contact::Tool) return;  // what is being drawn stays under the pen
  change(view_);
  if (whole_picture_seconds_ < kQuickPicture || picture_.can_shift_to(view_)) return renew_picture();
  late_picture_.start(kViewRests);
  update();
}

void SketchCanvas::fit() {
  is_fitted_ = true;
  change_view([this](PaperView& view) { view.fit(document_.drawing().size, size()); });
}

void SketchCanvas::zoom(double factor) {
  is_fitted_ = false;
  change_view([&](PaperView& view) { view.zoom(QRectF(rect()).center(), factor); });
}

void SketchCanvas::turn(double degrees) {
  is_fitted_ = false;
  change_view([&](PaperView& view) { view.turn(QRectF(rect()).center(), degrees); });
}

void SketchCanvas::resizeEvent(QResizeEvent* /*event*/) {
  if (is_fitted_ && contact_ == Contact::None) view_.fit(document_.drawing().size, size());
  renew_picture();
}

bool SketchCanvas::event(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) renew_picture();
  return QWidget::event(event);
}

void SketchCanvas::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  const QRect part = event->rect();
  if (picture_.view() == view_) {
    const double ratio = picture_.image().devicePixelRatio();
    painter.drawImage(part, picture_.image(), QRectF(part.topLeft() * ratio, QSizeF(part.size()) * ratio));
  } else {
    painter.fillRect(part, colours().base);
    painter.setTransform(picture_.view().screen_from_mm().inverted() * view_.screen_from_mm());
    painter.drawImage(QPoint(), picture_.image());
    painter.resetTransform();
  }
  painter.setRenderHint(QPainter::Antialiasing);
  if (!onion_.empty()) paint_onion(painter);
  if (!document_.selection().empty())
    paint_selection(painter, document_.shown(), document_.selection(), view_);
  used().paint(painter, part);
  if (look_.force && contact_ == Contact::Tool)
    paint_force(painter, last_.at, sketch::tool_force(used().grip(), last_.place).force, view_);
  if (felt_) paint_pen(painter);
  if (hasFocus()) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(colours().accent);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
}

void SketchCanvas::paint_onion(QPainter& painter) {
  painter.setTransform(view_.screen_from_mm());
  painter.setOpacity(kOnionOpacity);
  for (const auto& stroke : onion_) picture_.paint(painter, stroke);
  painter.setOpacity(1.0);
  painter.resetTransform();
}

// Pen and mouse.

PenInput SketchCanvas::input_of(const QMouseEvent& event) {
  const double time = 0.001 * double(event.timestamp());
  const QPointF at = event.position();
  PenInput input{.at = at, .place = view_.to_paper(at), .time = time};
  input.pressure = look_.constant_width ? kConstantPressure
                                        : mouse_.at(time, kPixelMetres * drawing::Vector2(at.x(), at.y()));
  input.modifiers = event.modifiers();
  return input;
}

PenInput SketchCanvas::input_of(const QTabletEvent& event) const {
  const QPointF at = event.position();
  PenInput input{.at = at, .place = view_.to_paper(at), .time = 0.001 * double(event.timestamp())};
  input.pressure = event.pressure();
  input.is_pen = true;
  input.tilt = std::hypot(event.xTilt(), event.yTilt()) * kDegreesToRadians;
  input.modifiers = event.modifiers();
  return input;
}

void SketchCanvas::begin(const PenInput& input, bool shifts) {
  if (contact_ != Contact::None) return;
  contact_ = shifts ? Contact::Shift : Contact::Tool;
  last_ = input;
  if (shifts) return setCursor(Qt::ClosedHandCursor);
  used().press(input);
  pointer_(input);
}

void SketchCanvas::go_on(const PenInput& input) {
  const PenInput before = std::exchange(last_, input);
  if (contact_ == Contact::Tool) {
    used().drag(input);
  } else if (contact_ == Contact::Shift) {
    is_fitted_ = false;
    change_view([&](PaperView& view) { view.shift(input.at - before.at); });
  } else {
    used().hover(input);
  }
  pointer_(input);
}

void SketchCanvas::end(const PenInput& input) {
  const Contact was = std::exchange(contact_, Contact::None);
  if (was == Contact::Tool) used().release(input);
  if (was == Contact::Shift) show_cursor();
}

void SketchCanvas::tabletEvent(QTabletEvent* event) {
  event->accept();
  const PenInput input = input_of(*event);
  // By what it presses, not by what is reported of its buttons: a pen that has left draws no line to where it
  // comes back.
  const bool is_down =
      event->type() != QEvent::TabletRelease && event->pressure() > 0.0 &&
      (pen_is_down_ || event->type() == QEvent::TabletPress || (event->buttons() & Qt::LeftButton));
  if (is_down && !pen_is_down_) {
    setFocus(Qt::MouseFocusReason);
    eraser_end_ = event->pointerType() == QPointingDevice::PointerType::Eraser;
    begin(input, space_);
  } else if (!is_down && pen_is_down_) {
    end(last_);
    eraser_end_ = false;
  } else {
    go_on(input);
  }
  pen_is_down_ = is_down;
}

// A pen that pushes back.

void SketchCanvas::take_pen(sketch::FeltPen* pen) {
  felt_pen_ = pen;
  felt_.reset();
  if (pen == nullptr) return pen_timer_.stop();
  pen->resize(document_.drawing().size);
  pen_timer_.start(kPenReadings);
}

void SketchCanvas::read_pen() {
  const std::vector<sketch::PenReading> readings = felt_pen_->take();
  for (const sketch::PenReading& reading : readings) follow_pen(reading, &reading == &readings.back());
  felt_pen_->hold(contact_ == Contact::Tool ? used().grip() : sketch::ToolGrip{});
  felt_pen_->turn_around(eraser_end_ || tool_ == SketchToolKind::Eraser);
}

void SketchCanvas::follow_pen(const sketch::PenReading& reading, bool is_last) {
  constexpr std::uint32_t kEraserButton = 1;
  const bool was_down = felt_ && felt_->pressure > 0.0, is_down = reading.pressure > 0.0;
  const bool has_moved = !felt_ || felt_->place != reading.place || felt_->pressure != reading.pressure;
  felt_ = reading;
  PenInput input{.at = view_.to_screen(reading.place), .place = reading.place, .time = reading.time};
  input.pressure = reading.pressure;
  input.is_pen = true;
  if (is_down && !was_down) {
    eraser_end_ = (reading.buttons & kEraserButton) != 0;
    begin(input, false);
  } else if (was_down && !is_down) {
    end(last_);
    eraser_end_ = false;
  } else if (has_moved && is_last) {
    go_on(input);
  } else if (has_moved && contact_ == Contact::Tool && used().follows_all()) {
    last_ = input;
    used().drag(input);
  }
  if (is_last && has_moved) update();
}

/// A ring where the tip is, or would come down.
void SketchCanvas::paint_pen(QPainter& painter) const {
  constexpr double kOnPaper = 3.0, kMostAbove = 14.0;  // pixels
  const double above = felt_->height * felt_pen_->scale() / view_.on_paper(1.0);
  painter.setPen(overlay_pen());
  const double radius = kOnPaper + std::min(above, kMostAbove);
  painter.drawEllipse(view_.to_screen(felt_->place), radius, radius);
}

/// Does the mouse move a simulated pen in place of what it does else?
bool SketchCanvas::moves_pen(const QMouseEvent& event) {
  const bool shifts = space_ || contact_ == Contact::Shift || (event.buttons() & Qt::MiddleButton);
  if (felt_pen_ == nullptr || !felt_pen_->is_simulated() || shifts) return false;
  const PenInput input = input_of(event);
  felt_pen_->aim(input.place, event.buttons() & Qt::LeftButton ? input.pressure : 0.0);
  return true;
}

bool SketchCanvas::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::TabletLeaveProximity && pen_is_down_) {
    end(last_);
    pen_is_down_ = false;
    eraser_end_ = false;
  }
  return QWidget::eventFilter(watched, event);
}

void SketchCanvas::mousePressEvent(QMouseEvent* event) {
  mouse_ = {};
  if (moves_pen(*event)) return;
  const bool shifts = event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && space_);
  if (shifts || event->button() == Qt::LeftButton) begin(input_of(*event), shifts);
}

void SketchCanvas::mouseMoveEvent(QMouseEvent* event) {
  if (!moves_pen(*event)) go_on(input_of(*event));
}

void SketchCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (!moves_pen(*event) && event->buttons() == Qt::NoButton) end(input_of(*event));
}

void SketchCanvas::wheelEvent(QWheelEvent* event) {
  const double turned = event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
  is_fitted_ = false;
  change_view([&](PaperView& view) {
    r_ ? view.turn(event->position(), kWheelTurn * turned)
       : view.zoom(event->position(), std::pow(kWheelZoom, turned));
  });
  event->accept();
}

// Keys.

void SketchCanvas::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return back_out();
  if (event->key() == Qt::Key_Space) {
    space_ = true;
    return show_cursor();
  }
  if (event->key() == Qt::Key_R) {
    r_ = true;
    return;
  }
  if (!move_selection(*event)) QWidget::keyPressEvent(event);
}

void SketchCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->isAutoRepeat()) return;
  if (event->key() == Qt::Key_Space) space_ = false;
  if (event->key() == Qt::Key_R) r_ = false;
  show_cursor();
  QWidget::keyReleaseEvent(event);
}

void SketchCanvas::focusOutEvent(QFocusEvent* event) {
  space_ = false;
  r_ = false;
  show_cursor();
  QWidget::focusOutEvent(event);
}

void SketchCanvas::back_out() {
  if (contact_ == Contact::Tool) {
    contact_ = Contact::None;
    used().give_up();
  } else if (!document_.selection().empty()) {
    document_.perform(command("deselect"));
  }
}

/// By arrow keys, as it is seen: also on turned paper.
bool SketchCanvas::move_selection(const QKeyEvent& event) {
  QPointF way;
  if (event.key() == Qt::Key_Left) way = {-1.0, 0.0};
  if (event.key() == Qt::Key_Right) way = {1.0, 0.0};
  if (event.key() == Qt::Key_Up) way = {0.0, -1.0};
  if (event.key() == Qt::Key_Down) way = {0.0, 1.0};
  if (way.isNull() || contact_ != Contact::None || document_.selection().empty()) return false;
  const double step = kArrowKeyStep * (event.modifiers() & Qt::ShiftModifier ? 10.0 : 1.0);
  const QPointF by = QTransform().rotate(-view_.turned()).map(way) * step;
  document_.perform(command("move", {{"by", interaction::Value::List{by.x(), by.y()}}}));
  return true;
}

}  // namespace icome::ui
