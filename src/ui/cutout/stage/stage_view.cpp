#include "ui/cutout/stage/stage_view.h"

#include <QContextMenuEvent>
#include <QDragEnterEvent>
#include <QKeyEvent>
#include <QMimeData>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "ui/actions/recent_files.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::Affine2;
using animation::Vector2;

constexpr double kStageWheelZoom = 1.0015;  // for an eighth of a degree
constexpr double kDragBegins = 3.0;         // pixels: a click that trembles moves nothing
constexpr double kFrameReach = 5.0;         // pixels around the camera's frame that count as it
constexpr double kNudge = 1.0;              // px of the stage; with Shift ten times as far
constexpr double kOnionOpacityNear = 0.3;
constexpr double kOnionFades = 0.6;  // from one pose to the next further away

double way_length(QPointF way) { return std::hypot(way.x(), way.y()); }

/// Distance of a place from a straight piece, pixels.
double distance_from_piece(QPointF at, QPointF a, QPointF b) {
  const QPointF way = b - a;
  const double square = QPointF::dotProduct(way, way);
  const double part = square > 0 ? std::clamp(QPointF::dotProduct(at - a, way) / square, 0.0, 1.0) : 0.0;
  return way_length(at - a - part * way);
}

/// Another pose: what was before in red, what comes in green, as on paper. Only cells that lie otherwise
/// there.
animation::OnionSkin onion_skin(const CutoutDocument& document, int frame, int away, bool before) {
  animation::OnionSkin skin;
  for (const auto& [cell, state] : animation::states_at(document.project(), frame)) {
    const auto now = document.shown().find(cell);
    if (now == document.shown().end() || !(now->second == state)) skin.states.emplace(cell, state);
  }
  skin.look.opacity = kOnionOpacityNear * std::pow(kOnionFades, away - 1);
  skin.look.tint =
      before ? animation::Tint{{0.90F, 0.22F, 0.20F}, 0.6} : animation::Tint{{0.13F, 0.62F, 0.30F}, 0.6};
  return skin;
}

std::vector<animation::OnionSkin> onion_of(const CutoutDocument& document, const CutoutLook& look) {
  std::vector<animation::OnionSkin> skins;
  for (const bool before : {true, false}) {
    const int most = before ? look.onion_before : look.onion_after;
    for (int away = most; away >= 1; --away) {
      const int frame = document.frame() + (before ? -1 : 1) * away * look.step;
      if (frame >= 0 && frame <= document.last_frame())
        skins.push_back(onion_skin(document, frame, away, before));
    }
  }
  return skins;
}

}  // namespace

StageView::StageView(CutoutDocument& document, const CutoutLook& look, QWidget* parent)
    : QWidget(parent), document_(document), look_(look) {
  setObjectName("stage");
  setAccessibleName("Stage");
  setAccessibleDescription(
      "Click on a cell to select it and drag to move it. Arrow keys move what is selected.");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAcceptDrops(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(60 * kGrid, 40 * kGrid);
}

Affine2 StageView::screen_from_stage() const {
  Affine2 page = scale_.screen_from_page();
  if (!look_.through_camera) return page;
  const animation::Stage& stage = document_.project().stage;
  return page * animation::picture_from_stage(document_.project(), document_.shown(),
                                              {.through_camera = true}, stage.width, stage.height);
}

void StageView::refresh() {
  if (is_fitted_) {
    const animation::Stage& stage = document_.project().stage;
    scale_.fit(Vector2(stage.width, stage.height), size());
  }
  is_stale_ = true;
  update();
}

void StageView::follow_frame() {
  // While it is recorded, cells that are held without being moved are held, too.
  if (contact_ == Contact::Press && document_.is_recording()) contact_ = Contact::Drag;
  // A drag goes on from frame to frame while the animation runs.
  if (contact_ == Contact::Drag && !pivot_) drag_to(last_, strict_);
  show_moved();
}

void StageView::show_moved() {
  is_moved_ = true;
  update();
}

void StageView::fit() {
  is_fitted_ = true;
  refresh();
}

void StageView::zoom(double factor) {
  is_fitted_ = false;
  scale_.zoom(QRectF(rect()).center(), factor);
  refresh();
}

void StageView::show_words(const QString& words) {
  if (words == words_) return;
  words_ = words;
  update();
}

void StageView::show_recording(bool recording) {
  if (recording == is_recording_) return;
  is_recording_ = recording;
  update();
}

bool StageView::event(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) refresh();
  if (event->type() == QEvent::ShortcutOverride) {
    // Esc and Enter answer a question; arrow keys move cells; else they are shortcuts of the window.
    const auto& key = static_cast<const QKeyEvent&>(*event);
    const bool moves = key.key() >= Qt::Key_Left && key.key() <= Qt::Key_Down &&
                       !(key.modifiers() & (Qt::ControlModifier | Qt::AltModifier)) &&
                       !document_.selection().empty();
    const bool answers = is_asking() && (key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter);
    if (moves || answers) event->accept();
  }
  return QWidget::event(event);
}

void StageView::resizeEvent(QResizeEvent* /*event*/) { refresh(); }

// Painting.

/// The part of the picture in which cells lie otherwise than they were drawn.
QRegion StageView::changed_part(const Affine2& pixels_from_stage) {
  constexpr double kRim = 2.0;        // pixels around a cell that it may touch
  constexpr int kMostParts = 8;       // more are drawn as one
  constexpr double kNearlyAll = 0.6;  // of the picture: then all of it is drawn
  QRegion changed;
  const auto add = [&](const animation::Cell& cell, const CellStates& states) {
    const auto found = states.find(cell.id);
    if (found == states.end()) return;
    const auto corners = animation::outline_of(cell, found->second, document_.pictures());
    if (!corners) return;
    QPolygonF outline;
    for (const Vector2& corner : *corners) outline << point_of(pixels_from_stage * corner);
    const QRectF around = outline.boundingRect().adjusted(-kRim, -kRim, kRim, kRim);
    changed += around.intersected(QRectF(picture_.rect())).toAlignedRect();
  };
  for (const animation::Layer& layer : document_.project().layers) {
    if (!layer.visible) continue;
    for (const animation::Cell& cell : layer.cells) {
      const CellStates& drawn = drawn_;
      const auto before = drawn.find(cell.id), now = document_.shown().find(cell.id);
      const bool is_same =
          before != drawn_.end() && now != document_.shown().end() && before->second == now->second;
      if (is_same) continue;
      add(cell, drawn_);
      add(cell, document_.shown());
    }
  }
  changed &= picture_.rect();
  if (changed.rectCount() > kMostParts) changed = changed.boundingRect();
  double area = 0;
  for (const QRect& part : changed) area += double(part.width()) * part.height();
  const double whole = double(picture_.width()) * picture_.height();
  return area > kNearlyAll * whole ? QRegion(picture_.rect()) : changed;
}

void StageView::draw_part(const QRect& part, const Affine2& pixels_from_stage) {
  animation::FrameOptions options;
  options.through_camera = look_.through_camera;
  options.backdrop = animation::Backdrop::Stage;
  options.picture_from_stage = Eigen::Translation2d(-part.x(), -part.y()) * pixels_from_stage;
  const std::ptrdiff_t row_words = picture_.bytesPerLine() / 4;
  auto* const words = reinterpret_cast<std::uint32_t*>(picture_.bits()) + part.y() * row_words + part.x();
  const animation::PixelsView view(words, part.width(), part.height(), row_words);
  animation::draw_frame(document_.project(), document_.shown(), document_.pictures(), options, view);
}

void StageView::renew_picture() {
  const double ratio = devicePixelRatioF();
  const QSize pixels = (QSizeF(size()) * ratio).toSize();
  const Affine2 map = Eigen::Scaling(ratio) * screen_from_stage();
  if (picture_.size() != pixels || map.matrix() != drawn_map_.matrix()) is_stale_ = true;
  if (picture_.size() != pixels) picture_ = QImage(pixels, QImage::Format_ARGB32_Premultiplied);
  const QRegion parts = is_stale_ ? QRegion(picture_.rect()) : changed_part(map);
  for (const QRect& part : parts) draw_part(part, map);
  picture_.setDevicePixelRatio(ratio);
  drawn_ = document_.shown();
  drawn_map_ = map;
  is_stale_ = is_moved_ = false;
  skins_ = QImage();
  if (look_.onion) renew_skins({.through_camera = look_.through_camera, .picture_from_stage = map});
}

/// Other poses, over the frame, as a background would hide them below it.
void StageView::renew_skins(const animation::FrameOptions& options) {
  skins_ = QImage(picture_.size(), QImage::Format_ARGB32_Premultiplied);
  animation::FrameOptions skins = options;
  skins.backdrop = animation::Backdrop::None;
  skins.onion = onion_of(document_, look_);
  const animation::PixelsView onto(reinterpret_cast<std::uint32_t*>(skins_.bits()), skins_.width(),
                                   skins_.height(), skins_.bytesPerLine() / 4);
  animation::draw_frame(document_.project(), {}, document_.pictures(), skins, onto);
  skins_.setDevicePixelRatio(picture_.devicePixelRatio());
}

void StageView::paintEvent(QPaintEvent* /*event*/) {
  if ((is_stale_ || is_moved_) && !size().isEmpty()) renew_picture();
  QPainter painter(this);
  painter.fillRect(rect(), is_dark() ? colours().base : colours().window);
  painter.drawImage(QPoint(), picture_);
  if (!skins_.isNull()) painter.drawImage(QPoint(), skins_);
  painter.setRenderHint(QPainter::Antialiasing);
  paint_surroundings(painter);
  if (look_.constraints) paint_constraints(painter, document_, screen_from_stage());
  if (contact_ != Contact::Drag) paint_hover(painter);
  if (auto frame = handle_frame(document_, screen_from_stage())) {
    if (pivot_) frame->pivot = point_of(screen_from_stage() * *pivot_);
    paint_handles(painter, *frame, under_);
  }
  if (contact_ == Contact::Marquee) {
    QColor wash = colours().accent;
    wash.setAlphaF(0.12F);
    painter.setPen(QPen(colours().accent, 1.0, Qt::DashLine));
    painter.setBrush(wash);
    painter.drawRect(QRectF(pressed_, last_).normalized());
  }
  if (is_asking()) paint_question(painter);
  if (document_.project().cell_count() == 0) paint_beginning(painter);
  if (!words_.isEmpty()) paint_words(painter);
  if (is_recording_) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colours().bad, 6.0));
    painter.drawRect(rect());
  }
  if (hasFocus()) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(colours().accent);
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
  }
  painted_();
}

/// The border of the stage, or what the film leaves out; and the camera's frame on the stage.
void StageView::paint_surroundings(QPainter& painter) {
  const animation::Stage& stage = document_.project().stage;
  const QTransform page = transform_of(scale_.screen_from_page());
  const QRectF whole = page.mapRect(QRectF(0, 0, stage.width, stage.height));
  painter.setBrush(Qt::NoBrush);
  if (look_.through_camera) {
    QPainterPath outside;
    outside.addRect(rect());
    outside.addRect(whole);
    QColor veil = is_dark() ? colours().base : colours().window;
    veil.setAlphaF(0.82F);
    painter.fillPath(outside, veil);
  }
  painter.setPen(QPen(colours().line, 1.0));
  painter.drawRect(whole);
  const auto camera = corners_of(document_, animation::kCamera);
  if (look_.through_camera || !look_.camera_frame || !camera || document_.is_selected(animation::kCamera))
    return;
  QPolygonF frame;
  for (const Vector2& corner : *camera) frame << point_of(screen_from_stage() * corner);
  QColor light = colours().link_text;
  painter.setPen(QPen(light, 1.2, Qt::DashLine));
  painter.drawPolygon(frame);
  const QRectF word =
      QRectF(frame.front() + QPointF(4.0, 4.0), painter.fontMetrics().size(0, "camera") + QSize(10, 2));
  QColor chip = colours().window;
  chip.setAlphaF(0.8F);
  painter.setPen(Qt::NoPen);
  painter.setBrush(chip);
  painter.drawRoundedRect(word, 3, 3);
  painter.setPen(colours().faint);
  painter.drawText(word, Qt::AlignCenter, "camera");
}

void StageView::paint_hover(QPainter& painter) {
  if (!hovered_ || document_.is_selected(*hovered_) || is_asking()) return;
  const auto corners = corners_of(document_, *hovered_);
  if (!corners) return;
  QPolygonF outline;
  for (const Vector2& corner : *corners) outline << point_of(screen_from_stage() * corner);
  QColor line = colours().accent;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(255, 255, 255, 120), 2.6));
  painter.drawPolygon(outline);
  painter.setPen(QPen(line, 1.2, Qt::DotLine));
  painter.drawPolygon(outline);
}

void StageView::paint_question(QPainter& painter) {
  const Affine2 map = screen_from_stage();
  QPolygonF way;
  for (const Vector2& place : places_) way << point_of(map * place);
  painter.setPen(QPen(colours().accent, 1.8));
  painter.setBrush(colours().accent);
  for (const QPointF& at : way) painter.drawEllipse(at, 3.5, 3.5);
  if (!way.isEmpty()) {
    way << last_;
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(way);
  }
  const QRectF words = QRectF(rect()).adjusted(0, 3.0 * kGrid, 0, 0);
  const QRectF place = painter.fontMetrics().boundingRect(
      words.toRect(), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, asked_);
  painter.setPen(QPen(colours().line, 1.0));
  painter.setBrush(colours().raised);
  painter.drawRoundedRect(place.adjusted(-12, -6, 12, 6), 6, 6);
  painter.setPen(colours().text);
  painter.drawText(words, Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, asked_);
}

void StageView::paint_words(QPainter& painter) {
  QFont large = font();
  large.setPixelSize(std::clamp(height() / 3, 24, 220));
  large.setBold(true);
  QPainterPath letters;
  letters.addText(0, 0, large, words_);
  letters.translate(QRectF(rect()).center() - letters.boundingRect().center());
  QColor line = colours().window;
  line.setAlphaF(0.9F);
  painter.strokePath(letters, QPen(line, 10.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.fillPath(letters, colours().bad);
}

/// Tells how to begin, while there is nothing to see.
void StageView::paint_beginning(QPainter& painter) {
  const animation::Stage& stage = document_.project().stage;
  const QRectF page =
      transform_of(scale_.screen_from_page()).mapRect(QRectF(0, 0, stage.width, stage.height));
  const world::Colour& ground = stage.background;
  const bool is_light = 0.3F * ground[0] + 0.59F * ground[1] + 0.11F * ground[2] > 0.5F;
  QFont heading = font();
  heading.setPointSizeF(1.5 * font().pointSizeF());
  painter.setFont(heading);
  painter.setPen(is_light ? QColor(60, 64, 70) : QColor(225, 228, 232));
  const QRectF above(page.left(), page.center().y() - 60, page.width(), 40);
  painter.drawText(above, Qt::AlignCenter, "Nothing is on the stage yet");
  painter.setFont(font());
  painter.setPen(is_light ? QColor(95, 100, 108) : QColor(180, 186, 194));
  painter.drawText(QRectF(page.left(), above.bottom(), page.width(), 80), Qt::AlignHCenter | Qt::AlignTop,
                   "Drop pictures here (PNG, SVG, drawings of designs),\n"
                   "or add them with Ctrl+I. Move a cell, press Space, move it again:\n"
                   "every Space is the next frame.");
}

// Mouse.

std::optional<CellId> StageView::cell_under(QPointF at) {
  return animation::cell_at(document_.project(), document_.shown(), document_.pictures(), on_stage(at));
}

bool StageView::camera_under(QPointF at) {
  if (look_.through_camera || !look_.camera_frame) return false;
  const auto corners = corners_of(document_, animation::kCamera);
  if (!corners) return false;
  const Affine2 map = screen_from_stage();
  for (std::size_t i = 0; i < 4; ++i)
    if (distance_from_piece(at, point_of(map * (*corners)[i]), point_of(map * (*corners)[(i + 1) % 4])) <=
        kFrameReach)
      return true;
  return false;
}

void StageView::show_cursor(QPointF at) {
  Qt::CursorShape shape = Qt::ArrowCursor;
  if (contact_ == Contact::Shift)
    shape = Qt::ClosedHandCursor;
  else if (is_asking())
    shape = Qt::CrossCursor;
  else if (under_ == StageGrip::Turn || under_ == StageGrip::Pivot)
    shape = Qt::PointingHandCursor;
  else if (under_ == StageGrip::Scale)
    shape = Qt::SizeAllCursor;
  else if (hovered_ || camera_under(at))
    shape = Qt::SizeAllCursor;
  if (cursor().shape() != shape) setCursor(shape);
}

void StageView::mousePressEvent(QMouseEvent* event) {
  if (contact_ != Contact::None) return;
  pressed_ = last_ = event->position();
  if (event->button() == Qt::MiddleButton) {
    contact_ = Contact::Shift;
    show_cursor(last_);
  }
  if (event->button() == Qt::LeftButton) press(event->position(), event->modifiers());
}

void StageView::press(QPointF at, Qt::KeyboardModifiers modifiers) {
  if (is_asking()) return add_place(at);
  const auto frame = handle_frame(document_, screen_from_stage());
  const StageGrip grip = frame ? grip_at(*frame, at, modifiers & Qt::ControlModifier) : StageGrip::None;
  const bool is_handle = grip != StageGrip::None && grip != StageGrip::Move;
  const bool more = modifiers & Qt::ShiftModifier;
  if (!is_handle) {
    std::optional<CellId> cell = cell_under(at);
    if (!cell && camera_under(at)) cell = animation::kCamera;
    if (!cell) {
      contact_ = Contact::Marquee;
      return;
    }
    std::vector<CellId> selected = document_.selection();
    if (more && document_.is_selected(*cell)) {
      std::erase(selected, *cell);
    } else if (more) {
      selected.push_back(*cell);
    } else if (!document_.is_selected(*cell)) {
      selected = {*cell};
    }
    document_.select(std::move(selected));
  }
  contact_ = Contact::Press;
  drag_frame_ = document_.frame();
  drag_ = begin_drag(document_, is_handle ? grip : StageGrip::Move, on_stage(at));
  if (!document_.is_recording() || drag_.grip == StageGrip::Pivot) return;
  contact_ = Contact::Drag;
  drag_to(at, false);
}

void StageView::drag_to(QPointF at, bool strict) {
  if (drag_.grip == StageGrip::Pivot) {
    pivot_ = on_stage(at);
    update();
    return;
  }
  const bool is_there = document_.frame() == drag_frame_;
  document_.try_out(dragged(document_, drag_, on_stage(at), strict), is_there ? &drag_.start : nullptr);
}

void StageView::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  const QPointF by = at - last_;
  last_ = at;
  pointer_(on_stage(at));
  if (contact_ == Contact::Shift) {
    is_fitted_ = false;
    scale_.shift(by);
    return refresh();
  }
  if (contact_ == Contact::Press && way_length(at - pressed_) >= kDragBegins) contact_ = Contact::Drag;
  strict_ = event->modifiers() & Qt::ShiftModifier;
  if (contact_ == Contact::Drag) return drag_to(at, strict_);
  if (contact_ == Contact::None) {
    const auto frame = handle_frame(document_, screen_from_stage());
    const bool takes_pivot = event->modifiers() & Qt::ControlModifier;
    under_ = frame && !is_asking() ? grip_at(*frame, at, takes_pivot) : StageGrip::None;
    hovered_ = cell_under(at);
    show_cursor(at);
  }
  update();
}

void StageView::mouseReleaseEvent(QMouseEvent* event) {
  const bool ends = event->button() == (contact_ == Contact::Shift ? Qt::MiddleButton : Qt::LeftButton);
  if (!ends || contact_ == Contact::None) return;
  const Contact contact = std::exchange(contact_, Contact::None);
  if (contact == Contact::Marquee)
    select_within(QRectF(pressed_, last_).normalized(), event->modifiers() & Qt::ShiftModifier);
  if (contact == Contact::Drag) {
    const CellId cell = document_.selection().empty() ? CellId() : document_.selection().front();
    if (const auto command = pivot_ ? pivot_command(document_, cell, *pivot_) : std::nullopt)
      document_.perform(*command);
    else
      document_.keep();
  }
  pivot_.reset();
  show_cursor(event->position());
  update();
}

void StageView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (!is_asking()) return mousePressEvent(event);
  if (places_.size() >= least_places_) end_question(true);
}

void StageView::select_within(const QRectF& marquee, bool more) {
  std::vector<CellId> cells = more ? document_.selection() : std::vector<CellId>();
  const Affine2 map = screen_from_stage();
  for (const animation::Layer& layer : document_.project().layers) {
    if (!layer.visible || layer.locked) continue;
    for (const animation::Cell& cell : layer.cells) {
      const auto corners = corners_of(document_, cell.id);
      if (!corners || std::ranges::find(cells, cell.id) != cells.end()) continue;
      const Vector2 middle = 0.25 * ((*corners)[0] + (*corners)[1] + (*corners)[2] + (*corners)[3]);
      if (marquee.contains(point_of(map * middle))) cells.push_back(cell.id);
    }
  }
  document_.select(std::move(cells));
}

void StageView::wheelEvent(QWheelEvent* event) {
  is_fitted_ = false;
  scale_.zoom(event->position(), std::pow(kStageWheelZoom, event->angleDelta().y()));
  refresh();
  event->accept();
}

void StageView::leaveEvent(QEvent* /*event*/) {
  hovered_.reset();
  under_ = StageGrip::None;
  update();
}

void StageView::contextMenuEvent(QContextMenuEvent* event) {
  if (contact_ != Contact::None || is_asking()) return;
  const auto cell = cell_under(event->pos());
  if (cell && !document_.is_selected(*cell)) document_.select({*cell});
  menu_(event->globalPos());
}

void StageView::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void StageView::dropEvent(QDropEvent* event) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files.push_back(path_of(url.toLocalFile()));
  if (!files.empty()) drop_(files);
}

// Keys, and questions for places.

bool StageView::nudge(const QKeyEvent& event) {
  const double step = event.modifiers() & Qt::ShiftModifier ? 10.0 * kNudge : kNudge;
  Vector2 by = Vector2::Zero();
  if (event.key() == Qt::Key_Left) by.x() = -step;
  if (event.key() == Qt::Key_Right) by.x() = step;
  if (event.key() == Qt::Key_Up) by.y() = -step;
  if (event.key() == Qt::Key_Down) by.y() = step;
  if (by.isZero() || document_.selection().empty() || contact_ != Contact::None) return false;
  // A key that is held down is one step to undo, as long as nothing else is done meanwhile.
  const bool goes_on = event.isAutoRepeat() && document_.steps() == steps_before_nudge_ + 1;
  if (!goes_on) steps_before_nudge_ = document_.steps();
  document_.try_out(nudged(document_, by));
  document_.keep();
  document_.join_steps(steps_before_nudge_);
  return true;
}

void StageView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return back_out();
  if (is_asking() && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)) {
    if (places_.size() >= least_places_) end_question(true);
    return;
  }
  if (is_asking() && event->key() == Qt::Key_Backspace && !places_.empty()) {
    places_.pop_back();
    update();
    return;
  }
  if (!nudge(*event)) QWidget::keyPressEvent(event);
}

void StageView::let_go() {
  contact_ = Contact::None;
  pivot_.reset();
  document_.give_up();
  update();
}

void StageView::back_out() {
  if (is_asking()) return end_question(false);
  if (contact_ != Contact::None) return let_go();
  if (document_.tried()) return document_.give_up();
  document_.select({});
}

void StageView::ask_places(const QString& words, std::size_t least, std::size_t most,
                           std::function<void(const std::vector<Vector2>&)> use) {
  asked_ = words;
  least_places_ = least;
  most_places_ = most;
  places_.clear();
  use_places_ = std::move(use);
  setFocus();
  question_(asked_);
  update();
}

void StageView::add_place(QPointF at) {
  places_.push_back(on_stage(at));
  if (places_.size() >= most_places_) end_question(true);
  update();
}

void StageView::end_question(bool use) {
  const auto then = std::exchange(use_places_, nullptr);
  const std::vector<Vector2> places = std::exchange(places_, {});
  question_({});
  update();
  if (use && then) then(places);
}

}  // namespace icome::ui
