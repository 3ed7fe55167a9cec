#include "ui/cutout/time/timeline.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QPainterPath>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr double kNames = 180.0;  // pixels for the names of rows
constexpr double kRuler = 30.0;   // pixels
constexpr double kKeyRadius = 5.0;
constexpr double kKeyReach = 6.0;
constexpr double kFoldMark = 16.0;        // pixels for the mark that folds
constexpr double kTimelineWheel = 1.002;  // for an eighth of a degree
constexpr int kEndRoom = 60;              // pixels behind the last frame

}  // namespace

Timeline::Timeline(CutoutDocument& document, QWidget* parent)
    : QAbstractScrollArea(parent), document_(document) {
  setObjectName("timeline");
  setAccessibleName("Timeline");
  setAccessibleDescription("Keys of all cells over time. Left and Right go from frame to frame.");
  setFocusPolicy(Qt::StrongFocus);
  setFrameShape(QFrame::NoFrame);
  viewport()->setMouseTracking(true);
  viewport()->setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumHeight(30 * kGrid);
  refresh();
}

void Timeline::refresh() {
  rows_ = time_rows(document_.project(), folds_);
  set_bars();
  viewport()->update();
}

void Timeline::follow_frame() {
  const double width = viewport()->width() - kNames;
  const double left = scale_.left_of(document_.frame());
  // Before it has its place in the window it has no width to speak of.
  if (width < 2.0 * scale_.frame_width) return viewport()->update();
  if (left < 0 || left + scale_.frame_width > width) {
    const double wanted = document_.frame() * scale_.frame_width - 0.2 * width;
    horizontalScrollBar()->setValue(int(std::lround(wanted)));
  }
  viewport()->update();
}

void Timeline::show_sound(std::shared_ptr<const SoundShape> shape) {
  sound_ = std::move(shape);
  viewport()->update();
}

void Timeline::zoom(double factor) {
  scale_.zoom(scale_.middle_of(document_.frame()), factor);
  set_bars();
  viewport()->update();
}

void Timeline::fit() {
  const double width = std::max(1.0, viewport()->width() - kNames - kEndRoom);
  scale_ = FrameScale();
  scale_.scroll = 0.0;
  scale_.zoom(0.0, width / (document_.project().stage.length * scale_.frame_width));
  set_bars();
  viewport()->update();
}

void Timeline::set_bars() {
  const double width = viewport()->width() - kNames;
  const double content = document_.project().stage.length * scale_.frame_width + kEndRoom;
  const double scroll = scale_.scroll;
  horizontalScrollBar()->setRange(0, std::max(0, int(std::ceil(content - width))));
  horizontalScrollBar()->setPageStep(std::max(1, int(width)));
  horizontalScrollBar()->setSingleStep(std::max(1, int(scale_.frame_width)));
  horizontalScrollBar()->setValue(int(std::lround(scroll)));
  scale_.scroll = horizontalScrollBar()->value();
  const double height = viewport()->height() - kRuler;
  verticalScrollBar()->setRange(0, std::max(0, int(std::ceil(height_of(rows_) - height))));
  verticalScrollBar()->setPageStep(std::max(1, int(height)));
  verticalScrollBar()->setSingleStep(22);
}

void Timeline::resizeEvent(QResizeEvent* /*event*/) { set_bars(); }

void Timeline::scrollContentsBy(int /*dx*/, int /*dy*/) {
  scale_.scroll = horizontalScrollBar()->value();
  viewport()->update();
}

bool Timeline::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) viewport()->update();
  return QAbstractScrollArea::viewportEvent(event);
}

// Places.

double Timeline::row_y(const TimeRow& row) const { return kRuler + row.top - verticalScrollBar()->value(); }

QPointF Timeline::place_of(const TimeRow& row, int frame) const {
  return {kNames + scale_.middle_of(frame), row_y(row) + 0.5 * row.height};
}

QPointF Timeline::ruler_place(int frame) const { return {kNames + scale_.middle_of(frame), 0.5 * kRuler}; }

const TimeRow* Timeline::row_under(QPointF at) const {
  if (at.y() < kRuler) return nullptr;
  return row_at(rows_, int(std::floor(at.y() - kRuler)) + verticalScrollBar()->value());
}

KeyPlaces Timeline::keys_under(QPointF at) const {
  const TimeRow* const row = row_under(at);
  if (row == nullptr || at.x() < kNames) return {};
  double nearest = std::max(kKeyReach, 0.5 * scale_.frame_width);
  KeyPlaces keys;
  const int about = scale_.frame_at(at.x() - kNames);
  const int reach = 1 + int(std::ceil(kKeyReach / scale_.frame_width));
  for (const auto& [frame, places] : keys_of(document_.project(), *row, about - reach, about + reach)) {
    const double away = std::abs(place_of(*row, frame).x() - at.x());
    if (away > nearest) continue;
    nearest = away;
    keys = places;
  }
  return keys;
}

// Painting.

void Timeline::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(viewport());
  painter.fillRect(viewport()->rect(), colours().base);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const TimeRow& row : rows_) paint_row(painter, row);
  if (contact_ == Contact::Marquee) {
    QColor wash = colours().accent;
    wash.setAlphaF(0.12F);
    painter.setPen(QPen(colours().accent, 1.0, Qt::DashLine));
    painter.setBrush(wash);
    painter.drawRect(QRectF(pressed_, last_).normalized());
  }
  paint_ruler(painter);
  paint_frame_line(painter);
  if (!hasFocus()) return;
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(colours().accent);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(viewport()->rect().adjusted(0, 0, -1, -1));
}

void Timeline::paint_ruler(QPainter& painter) {
  const QRectF whole(0, 0, viewport()->width(), kRuler);
  painter.fillRect(whole, colours().window);
  painter.setPen(colours().line);
  painter.drawLine(whole.bottomLeft(), whole.bottomRight());
  const animation::Stage& stage = document_.project().stage;
  painter.setPen(colours().faint);
  painter.drawText(QRectF(3 * kGrid, 0, kNames - 4 * kGrid, kRuler), Qt::AlignVCenter | Qt::AlignLeft,
                   QString("Frame %1 of %2").arg(document_.frame()).arg(stage.length));
  painter.save();
  painter.setClipRect(QRectF(kNames, 0, viewport()->width() - kNames, kRuler));
  const int step = scale_.number_step(stage.rate);
  QFont small = font();
  small.setPointSizeF(0.88 * font().pointSizeF());
  painter.setFont(small);
  const int first = std::max(0, scale_.frame_at(0.0) / step * step - step);
  const int last = std::min(stage.length - 1, scale_.frame_at(viewport()->width() - kNames) + 1);
  for (int frame = first; frame <= last; ++frame) {
    const double x = kNames + scale_.left_of(frame);
    const bool numbered = frame % step == 0;
    if (!numbered && scale_.frame_width < 4.0) continue;
    painter.setPen(colours().line);
    painter.drawLine(QPointF(x, numbered ? kRuler - 9.0 : kRuler - 4.0), QPointF(x, kRuler));
    if (!numbered) continue;
    painter.setPen(colours().text);
    painter.drawText(QPointF(x + 3.0, kRuler - 17.0), QString::number(frame));
    painter.setPen(colours().faint);
    painter.drawText(QPointF(x + 3.0, kRuler - 5.0), QString::number(frame / stage.rate, 'f', 2) + " s");
  }
  painter.restore();
}

void Timeline::paint_row(QPainter& painter, const TimeRow& row) {
  const QRectF place(0, row_y(row), viewport()->width(), row.height);
  if (place.bottom() < kRuler || place.top() > viewport()->height()) return;
  const ThemeColours& theme = colours();
  const bool is_selected = row.cell && document_.is_selected(row.cell) && row.kind == TimeRow::Kind::Cell;
  if (row.kind == TimeRow::Kind::Layer) painter.fillRect(place, theme.window);
  if (is_selected) {
    QColor wash = theme.accent;
    wash.setAlphaF(0.10F);
    painter.fillRect(place, wash);
  }
  painter.setPen(theme.grid);
  painter.drawLine(place.bottomLeft(), place.bottomRight());
  painter.save();
  painter.setClipRect(
      place.adjusted(kNames, 0, 0, 0).intersected(QRectF(viewport()->rect()).adjusted(0, kRuler, 0, 0)));
  const int second = std::max(1, int(std::lround(document_.project().stage.rate)));
  painter.setPen(theme.grid);
  const int first = std::max(0, scale_.frame_at(0.0)) / second * second;
  for (int frame = first; frame <= document_.last_frame() + 1; frame += second) {
    const double x = kNames + scale_.left_of(frame);
    if (x > place.right()) break;
    painter.drawLine(QPointF(x, place.top()), QPointF(x, place.bottom()));
  }
  switch (row.kind) {
    case TimeRow::Kind::Marks:
      paint_marks(painter, place);
      break;
    case TimeRow::Kind::Sound:
      paint_sound(painter, place);
      break;
    default:
      paint_keys(painter, row, place);
  }
  // Frames behind the last one are no part of the film.
  const double end = kNames + scale_.left_of(document_.project().stage.length);
  if (end < place.right()) {
    QColor veil = theme.window;
    veil.setAlphaF(0.75F);
    painter.fillRect(QRectF(QPointF(end, place.top()), place.bottomRight()), veil);
  }
  painter.restore();
  paint_name(painter, row, QRectF(0, place.top(), kNames, row.height));
}

void Timeline::paint_name(QPainter& painter, const TimeRow& row, const QRectF& place) {
  const ThemeColours& theme = colours();
  painter.save();
  painter.setClipRect(place.intersected(QRectF(0, kRuler, kNames, viewport()->height())));
  const bool is_selected = row.cell && document_.is_selected(row.cell) && row.kind == TimeRow::Kind::Cell;
  painter.fillRect(place, is_selected ? theme.selection : theme.window);
  painter.setPen(theme.grid);
  painter.drawLine(place.bottomLeft(), place.bottomRight());
  painter.setPen(theme.line);
  painter.drawLine(place.topRight(), place.bottomRight());
  double indent = 2.0 * kGrid;
  const bool folds = row.kind == TimeRow::Kind::Layer || row.kind == TimeRow::Kind::Cell;
  if (row.kind == TimeRow::Kind::Cell && row.layer) indent += 3.0 * kGrid;
  if (row.kind == TimeRow::Kind::Channel) indent += 11.0 * kGrid;
  if (folds) {
    const bool is_open = row.kind == TimeRow::Kind::Layer ? !folds_.folded.contains(row.layer)
                                                          : folds_.open.contains(row.cell);
    const QPointF middle(indent + 0.35 * kFoldMark, place.center().y());
    QPolygonF mark;
    if (is_open)
      mark << middle + QPointF(-4, -2) << middle + QPointF(4, -2) << middle + QPointF(0, 3);
    else
      mark << middle + QPointF(-2, -4) << middle + QPointF(3, 0) << middle + QPointF(-2, 4);
    painter.setPen(Qt::NoPen);
    painter.setBrush(is_selected ? theme.selection_text : theme.faint);
    painter.drawPolygon(mark);
    indent += kFoldMark;
  } else if (row.kind != TimeRow::Kind::Channel) {
    indent += kFoldMark;
  }
  const animation::Layer* const layer = document_.project().find(row.layer);
  const bool is_off = layer != nullptr && (!layer->visible || layer->locked);
  QFont letters = font();
  letters.setBold(row.kind == TimeRow::Kind::Layer);
  painter.setFont(letters);
  painter.setPen(is_selected ? theme.selection_text
                 : is_off || row.kind == TimeRow::Kind::Channel || row.kind == TimeRow::Kind::Sound
                     ? theme.faint
                     : theme.text);
  const QRectF room = place.adjusted(indent, 0, -kGrid, 0);
  painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                   painter.fontMetrics().elidedText(row.name, Qt::ElideRight, int(room.width())));
  painter.restore();
}

void Timeline::paint_marks(QPainter& painter, const QRectF& place) {
  painter.setFont(font());
  const auto& marks = document_.project().marks;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double x = kNames + scale_.left_of(marks[i].frame);
    const double end =
        i + 1 < marks.size() ? kNames + scale_.left_of(marks[i + 1].frame) - 2.0 : place.right();
    QColor wash = colours().link_text;
    wash.setAlphaF(0.16F);
    const double width =
        std::min(end - x, painter.fontMetrics().horizontalAdvance(one_line(marks[i].text)) + 10.0);
    const QRectF flag(x, place.top() + 3.0, std::max(3.0, width), place.height() - 6.0);
    painter.setPen(Qt::NoPen);
    painter.setBrush(wash);
    painter.drawRoundedRect(flag, 3, 3);
    painter.setPen(colours().link_text);
    painter.drawLine(flag.topLeft(), flag.bottomLeft());
    painter.drawText(flag.adjusted(5.0, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, one_line(marks[i].text));
  }
}

void Timeline::paint_sound(QPainter& painter, const QRectF& place) {
  const auto& sound = document_.project().sound;
  if (!sound || !sound_) {
    painter.setPen(colours().faint);
    painter.drawText(place.adjusted(kNames + 2 * kGrid, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft,
                     "The sound is being read, or cannot be");
    return;
  }
  const double rate = document_.project().stage.rate;
  QColor ink = colours().link_text;
  ink.setAlphaF(0.75F);
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(ink);
  const double half = 0.46 * place.height(), middle = place.center().y();
  for (int x = int(kNames); x < int(place.right()); ++x) {
    const auto seconds = [&](double pixel) {
      return (pixel - kNames + scale_.scroll) / scale_.frame_width / rate - sound->start;
    };
    const auto [least, greatest] = sound_->within(seconds(x), seconds(x + 1));
    if (least == 0.0F && greatest == 0.0F) continue;
    const double gain = std::min(sound->gain, 4.0);
    painter.drawLine(QPointF(x, middle - std::min(1.0, gain * greatest) * half),
                     QPointF(x, middle - std::max(-1.0, gain * least) * half));
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

void Timeline::paint_keys(QPainter& painter, const TimeRow& row, const QRectF& /*place*/) {
  const ThemeColours& theme = colours();
  const bool is_small = row.kind != TimeRow::Kind::Cell;
  const double radius =
      std::min(is_small ? 0.8 * kKeyRadius : kKeyRadius, std::max(2.0, 0.6 * scale_.frame_width));
  const auto span = span_of_keys(document_.project(), row);
  if (!span) return;
  if (row.kind != TimeRow::Kind::Layer && span->first < span->second) {
    painter.setPen(QPen(theme.line, 1.6));
    painter.drawLine(place_of(row, span->first), place_of(row, span->second));
  }
  const int margin = 2 + std::abs(moved_);
  const auto keys = keys_of(document_.project(), row, scale_.frame_at(0.0) - margin,
                            scale_.frame_at(viewport()->width() - kNames) + margin);
  const bool drags = contact_ == Contact::Keys && moved_ != 0;
  for (const auto& [frame, places] : keys) {
    const KeyPlace& first = *places.begin();
    const animation::Key* const key =
        animation::key_at(document_.project().find(first.cell)->tracks[std::size_t(first.channel)], frame);
    const bool chosen =
        std::ranges::any_of(places, [this](const KeyPlace& it) { return document_.keys().contains(it); });
    QColor fill = chosen ? theme.accent : is_small ? theme.faint : theme.text;
    const animation::Ease ease = key != nullptr ? key->ease : animation::Ease::Straight;
    if (chosen && drags) {
      QColor ghost = fill;
      ghost.setAlphaF(0.35F);
      paint_key(painter, place_of(row, frame), ease, ghost, ghost, radius);
      paint_key(painter, place_of(row, frame + moved_), ease, fill, theme.base, radius);
    } else {
      paint_key(painter, place_of(row, frame), ease, fill, theme.base, radius);
    }
  }
}

void Timeline::paint_frame_line(QPainter& painter) {
  const double left = kNames + scale_.left_of(document_.frame());
  const double x = kNames + scale_.middle_of(document_.frame());
  if (x < kNames || x > viewport()->width()) return;
  painter.setClipRect(QRectF(kNames, 0, viewport()->width() - kNames, viewport()->height()));
  QColor wash = colours().accent;
  wash.setAlphaF(0.14F);
  painter.fillRect(QRectF(left, kRuler, scale_.frame_width, viewport()->height()), wash);
  painter.setPen(QPen(colours().accent, 1.2));
  painter.drawLine(QPointF(x, kRuler - 8.0), QPointF(x, viewport()->height()));
  const QPointF head[] = {{x - 5.5, kRuler - 12.0},
                          {x + 5.5, kRuler - 12.0},
                          {x + 5.5, kRuler - 6.0},
                          {x, kRuler - 0.5},
                          {x - 5.5, kRuler - 6.0}};
  painter.setBrush(colours().accent);
  painter.drawPolygon(head, 5);
  painter.setClipping(false);
}

// Mouse.

void Timeline::go_under(double x) { document_.go_to(scale_.frame_at(x - kNames)); }

void Timeline::mousePressEvent(QMouseEvent* event) {
  if (contact_ != Contact::None) return;
  pressed_ = last_ = event->position();
  const bool more = event->modifiers() & Qt::ShiftModifier;
  if (event->button() == Qt::MiddleButton) {
    contact_ = Contact::Shift;
    return;
  }
  if (event->button() != Qt::LeftButton) return;
  if (pressed_.y() < kRuler) {
    contact_ = Contact::Scrub;
    return go_under(std::max(pressed_.x(), kNames));
  }
  const TimeRow* const row = row_under(pressed_);
  if (pressed_.x() < kNames) {
    if (row != nullptr) press_name(TimeRow(*row), pressed_, more);
    return;
  }
  press_rows(pressed_, more);
}

void Timeline::press_name(const TimeRow& row, QPointF at, bool more) {
  const double indent = row.kind == TimeRow::Kind::Cell && row.layer ? 5.0 * kGrid : 2.0 * kGrid;
  if (at.x() >= indent - kGrid && at.x() < indent + kFoldMark) {
    const auto turn = [](auto& set, auto id) {
      if (!set.erase(id)) set.insert(id);
    };
    if (row.kind == TimeRow::Kind::Layer) turn(folds_.folded, row.layer);
    if (row.kind == TimeRow::Kind::Cell) turn(folds_.open, row.cell);
    return refresh();
  }
  std::vector<CellId> cells = more ? document_.selection() : std::vector<CellId>();
  const auto add = [&](CellId cell) {
    if (std::ranges::find(cells, cell) == cells.end()) cells.push_back(cell);
  };
  if (row.cell) add(row.cell);
  if (const animation::Layer* const layer = document_.project().find(row.layer);
      layer != nullptr && !row.cell)
    for (const animation::Cell& cell : layer->cells) add(cell.id);
  document_.select(std::move(cells));
}

void Timeline::press_rows(QPointF at, bool more) {
  const KeyPlaces under = keys_under(at);
  if (under.empty()) {
    contact_ = Contact::Marquee;
    if (!more) document_.select_keys({});
    return;
  }
  contact_ = Contact::Keys;
  moved_ = 0;
  const bool chosen =
      std::ranges::all_of(under, [this](const KeyPlace& it) { return document_.keys().contains(it); });
  KeyPlaces keys = document_.keys();
  if (more && chosen) {
    for (const KeyPlace& it : under) keys.erase(it);
  } else if (more) {
    keys.insert(under.begin(), under.end());
  } else if (!chosen) {
    keys = under;
  }
  document_.select_keys(std::move(keys));
}

void Timeline::mouseMoveEvent(QMouseEvent* event) {
  const QPointF by = event->position() - last_;
  last_ = event->position();
  switch (contact_) {
    case Contact::Scrub:
      return go_under(std::max(last_.x(), kNames));
    case Contact::Keys:
      moved_ =
          possible_move(document_.keys(), int(std::lround((last_.x() - pressed_.x()) / scale_.frame_width)));
      break;
    case Contact::Shift:
      horizontalScrollBar()->setValue(int(std::lround(scale_.scroll - by.x())));
      verticalScrollBar()->setValue(int(std::lround(verticalScrollBar()->value() - by.y())));
      return;
    case Contact::Marquee:
      break;
    case Contact::None:
      viewport()->setCursor(keys_under(last_).empty() ? Qt::ArrowCursor : Qt::SizeHorCursor);
      return;
  }
  viewport()->update();
}

void Timeline::mouseReleaseEvent(QMouseEvent* event) {
  const auto ending = contact_ == Contact::Shift ? Qt::MiddleButton : Qt::LeftButton;
  if (event->button() != ending) return;
  const Contact contact = std::exchange(contact_, Contact::None);
  if (contact == Contact::Keys && moved_ != 0) {
    const int by = std::exchange(moved_, 0);
    KeyPlaces places = moved_places(document_.keys(), by);
    if (document_.perform(moved_keys(document_.project(), document_.keys(), by)))
      document_.select_keys(std::move(places));
  }
  if (contact == Contact::Marquee) {
    if ((last_ - pressed_).manhattanLength() < 4) {
      go_under(last_.x());
      const TimeRow* const row = row_under(last_);
      if (row != nullptr && row->cell) document_.select({row->cell});
    } else {
      select_within();
    }
  }
  viewport()->update();
}

void Timeline::select_within() {
  const QRectF marquee = QRectF(pressed_, last_).normalized();
  KeyPlaces keys = document_.keys();
  for (const TimeRow& row : rows_) {
    if (row.kind == TimeRow::Kind::Layer) continue;
    for (const auto& [frame, places] : keys_of(document_.project(), row))
      if (marquee.contains(place_of(row, frame))) keys.insert(places.begin(), places.end());
  }
  document_.select_keys(std::move(keys));
}

void Timeline::mouseDoubleClickEvent(QMouseEvent* event) {
  const TimeRow* const row = row_under(event->position());
  if (row != nullptr && row->kind == TimeRow::Kind::Marks && event->position().x() >= kNames)
    return mark_(std::clamp(scale_.frame_at(event->position().x() - kNames), 0, document_.last_frame()));
  mousePressEvent(event);
}

void Timeline::wheelEvent(QWheelEvent* event) {
  if (!(event->modifiers() & Qt::ControlModifier)) return QAbstractScrollArea::wheelEvent(event);
  scale_.zoom(std::max(0.0, event->position().x() - kNames),
              std::pow(kTimelineWheel, event->angleDelta().y()));
  set_bars();
  viewport()->update();
  event->accept();
}

void Timeline::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Left) return document_.go_to(document_.frame() - 1);
  if (event->key() == Qt::Key_Right) return document_.go_to(document_.frame() + 1);
  if (event->key() == Qt::Key_Escape) return document_.select_keys({});
  QAbstractScrollArea::keyPressEvent(event);
}

void Timeline::contextMenuEvent(QContextMenuEvent* event) {
  const KeyPlaces under = keys_under(event->pos());
  const bool chosen =
      std::ranges::all_of(under, [this](const KeyPlace& it) { return document_.keys().contains(it); });
  if (!under.empty() && !chosen) document_.select_keys(under);
  menu_(event->globalPos());
}

void Timeline::focusInEvent(QFocusEvent* event) {
  viewport()->update();
  QAbstractScrollArea::focusInEvent(event);
}

void Timeline::focusOutEvent(QFocusEvent* event) {
  viewport()->update();
  QAbstractScrollArea::focusOutEvent(event);
}

}  // namespace icome::ui
