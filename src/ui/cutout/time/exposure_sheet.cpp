#include "ui/cutout/time/exposure_sheet.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr double kSheetHeads = 44.0;    // pixels, for the names of layers and cells
constexpr double kFrameLine = 20.0;     // pixels for a frame
constexpr double kFrameNumbers = 44.0;  // pixels
constexpr double kSoundColumn = 48.0;   // pixels
constexpr double kMarkColumn = 84.0;    // pixels
constexpr double kCellColumn = 92.0;    // pixels
constexpr double kSheetMargin = kFrameNumbers + kSoundColumn + kMarkColumn;

}  // namespace

QString short_picture_name(const animation::Cell& cell, int picture) {
  if (picture < 0 || std::size_t(picture) >= cell.pictures.size()) return QString::fromUtf8("\u2013");
  const QString name = one_line(cell.pictures[std::size_t(picture)]);
  if (const qsizetype hash = name.indexOf(".icome#"); hash >= 0) return name.mid(hash + 7);
  return name.section('/', -1).section('.', 0, -2);
}

ExposureSheet::ExposureSheet(CutoutDocument& document, QWidget* parent)
    : QAbstractScrollArea(parent), document_(document) {
  setObjectName("sheet");
  setAccessibleName("Exposure sheet");
  setAccessibleDescription(
      "Frames downwards, a column for each cell. Type a picture's number and Enter; arrow keys go about.");
  setFocusPolicy(Qt::StrongFocus);
  setFrameShape(QFrame::NoFrame);
  viewport()->setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumHeight(30 * kGrid);
  refresh();
}

void ExposureSheet::refresh() {
  columns_.clear();
  const animation::Project& project = document_.project();
  for (auto layer = project.layers.rbegin(); layer != project.layers.rend(); ++layer)
    for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell)
      columns_.push_back({cell->id, layer->id, one_line(cell->name)});
  set_bars();
  viewport()->update();
}

void ExposureSheet::follow_frame() {
  const double top = top_of(document_.frame());
  if (top < kSheetHeads || top + kFrameLine > viewport()->height())
    verticalScrollBar()->setValue(
        int(std::lround(document_.frame() * kFrameLine - 0.3 * (viewport()->height() - kSheetHeads))));
  viewport()->update();
}

void ExposureSheet::show_sound(std::shared_ptr<const SoundShape> shape) {
  sound_ = std::move(shape);
  viewport()->update();
}

void ExposureSheet::set_bars() {
  const double height = viewport()->height() - kSheetHeads, width = viewport()->width() - kSheetMargin;
  verticalScrollBar()->setRange(
      0, std::max(0, int(std::ceil(document_.project().stage.length * kFrameLine - height))));
  verticalScrollBar()->setPageStep(std::max(1, int(height)));
  verticalScrollBar()->setSingleStep(int(kFrameLine));
  horizontalScrollBar()->setRange(0,
                                  std::max(0, int(std::ceil(double(columns_.size()) * kCellColumn - width))));
  horizontalScrollBar()->setPageStep(std::max(1, int(width)));
  horizontalScrollBar()->setSingleStep(int(kCellColumn));
}

void ExposureSheet::resizeEvent(QResizeEvent* /*event*/) { set_bars(); }

void ExposureSheet::scrollContentsBy(int /*dx*/, int /*dy*/) { viewport()->update(); }

bool ExposureSheet::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) viewport()->update();
  return QAbstractScrollArea::viewportEvent(event);
}

// Places.

double ExposureSheet::top_of(int frame) const {
  return kSheetHeads + frame * kFrameLine - verticalScrollBar()->value();
}

int ExposureSheet::frame_at(double y) const {
  return int(std::floor((y - kSheetHeads + verticalScrollBar()->value()) / kFrameLine));
}

double ExposureSheet::left_of(std::size_t column) const {
  return kSheetMargin + double(column) * kCellColumn - horizontalScrollBar()->value();
}

std::optional<std::size_t> ExposureSheet::column_at(double x) const {
  if (x < kSheetMargin) return std::nullopt;
  const double column = std::floor((x - kSheetMargin + horizontalScrollBar()->value()) / kCellColumn);
  if (column < 0 || column >= double(columns_.size())) return std::nullopt;
  return std::size_t(column);
}

QPointF ExposureSheet::place_of(std::size_t column, int frame) const {
  return {left_of(column) + 0.5 * kCellColumn, top_of(frame) + 0.5 * kFrameLine};
}

/// The column of the leading cell; one behind the last where there is none.
std::size_t ExposureSheet::chosen_column() const {
  const animation::Cell* const cell = document_.leading();
  const auto found = std::ranges::find_if(
      columns_, [&](const Column& column) { return cell != nullptr && column.cell == cell->id; });
  return std::size_t(found - columns_.begin());
}

void ExposureSheet::choose_column(std::size_t column) {
  if (column >= columns_.size()) return;
  document_.select({columns_[column].cell});
  const double left = left_of(column);
  if (left < kSheetMargin || left + kCellColumn > viewport()->width())
    horizontalScrollBar()->setValue(
        int(double(column) * kCellColumn - 0.3 * (viewport()->width() - kSheetMargin)));
}

void ExposureSheet::expose(CellId cell, int frame, int picture) {
  document_.perform(one_key(document_.project(), cell, Channel::Picture, frame, picture));
}

// Painting.

void ExposureSheet::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(viewport());
  const ThemeColours& theme = colours();
  painter.fillRect(viewport()->rect(), theme.base);
  painter.setRenderHint(QPainter::Antialiasing);
  const int first = std::max(0, frame_at(kSheetHeads));
  const int last = std::min(document_.last_frame(), frame_at(viewport()->height()));
  QColor wash = theme.accent;
  wash.setAlphaF(0.14F);
  painter.fillRect(QRectF(0, top_of(document_.frame()), viewport()->width(), kFrameLine), wash);
  painter.setClipRect(
      QRectF(kSheetMargin, kSheetHeads, viewport()->width() - kSheetMargin, viewport()->height()));
  for (std::size_t column = 0; column < columns_.size(); ++column) paint_column(painter, column, first, last);
  painter.setClipping(false);
  paint_margin(painter, first, last);
  paint_heads(painter);
  if (columns_.empty()) {
    painter.setPen(theme.faint);
    painter.drawText(QRectF(viewport()->rect()).adjusted(kSheetMargin, kSheetHeads, 0, 0), Qt::AlignCenter,
                     "Each cell has a column here");
  }
  if (!hasFocus()) return;
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(theme.accent);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(viewport()->rect().adjusted(0, 0, -1, -1));
}

void ExposureSheet::paint_margin(QPainter& painter, int first, int last) {
  const ThemeColours& theme = colours();
  const animation::Project& project = document_.project();
  const int second = std::max(1, int(std::lround(project.stage.rate)));
  painter.save();
  painter.setClipRect(QRectF(0, kSheetHeads, kSheetMargin, viewport()->height()));
  for (int frame = first; frame <= last; ++frame) {
    const QRectF line(0, top_of(frame), kSheetMargin, kFrameLine);
    painter.setPen(frame % second == 0 ? theme.text : theme.faint);
    painter.drawText(QRectF(0, line.top(), kFrameNumbers - 2.0 * kGrid, kFrameLine),
                     Qt::AlignVCenter | Qt::AlignRight, QString::number(frame));
    painter.setPen(frame % second == 0 ? theme.line : theme.grid);
    painter.drawLine(line.topLeft(), QPointF(viewport()->width(), line.top()));
    if (project.sound && sound_) {
      QColor ink = theme.link_text;
      ink.setAlphaF(0.75F);
      painter.setPen(ink);
      const double middle = kFrameNumbers + 0.5 * kSoundColumn, half = 0.46 * kSoundColumn;
      for (int y = 0; y < int(kFrameLine); ++y) {
        const double from = (frame + y / kFrameLine) / project.stage.rate - project.sound->start;
        const auto [least, greatest] = sound_->within(from, from + 1.0 / kFrameLine / project.stage.rate);
        if (least == 0.0F && greatest == 0.0F) continue;
        painter.drawLine(QPointF(middle + std::max(-1.0F, least) * half, line.top() + y),
                         QPointF(middle + std::min(1.0F, greatest) * half, line.top() + y));
      }
    }
  }
  for (const animation::Mark& mark : project.marks) {
    if (mark.frame < first || mark.frame > last) continue;
    const QRectF box(kFrameNumbers + kSoundColumn, top_of(mark.frame), kMarkColumn, kFrameLine);
    painter.setPen(theme.link_text);
    painter.drawText(
        box.adjusted(kGrid, 0, -kGrid, 0), Qt::AlignVCenter | Qt::AlignLeft,
        painter.fontMetrics().elidedText(one_line(mark.text), Qt::ElideRight, int(kMarkColumn) - 8));
  }
  painter.setPen(theme.line);
  for (const double x : {kFrameNumbers, kFrameNumbers + kSoundColumn, kSheetMargin})
    painter.drawLine(QPointF(x, 0), QPointF(x, viewport()->height()));
  painter.restore();
}

void ExposureSheet::paint_heads(QPainter& painter) {
  const ThemeColours& theme = colours();
  painter.fillRect(QRectF(0, 0, viewport()->width(), kSheetHeads), theme.window);
  painter.setPen(theme.line);
  painter.drawLine(QPointF(0, kSheetHeads), QPointF(viewport()->width(), kSheetHeads));
  painter.setPen(theme.faint);
  const double half = 0.5 * kSheetHeads;
  painter.drawText(QRectF(0, half, kFrameNumbers, half), Qt::AlignCenter, "Frame");
  painter.drawText(QRectF(kFrameNumbers, half, kSoundColumn, half), Qt::AlignCenter, "Sound");
  painter.drawText(QRectF(kFrameNumbers + kSoundColumn, half, kMarkColumn, half), Qt::AlignCenter, "Marks");
  painter.save();
  painter.setClipRect(QRectF(kSheetMargin, 0, viewport()->width() - kSheetMargin, kSheetHeads));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const QRectF head(left_of(i), 0, kCellColumn, kSheetHeads);
    const bool is_selected = document_.is_selected(columns_[i].cell);
    if (is_selected) painter.fillRect(head.adjusted(0, half, 0, 0), theme.selection);
    const bool begins = i == 0 || columns_[i].layer != columns_[i - 1].layer;
    if (begins) {
      const animation::Layer* const layer = document_.project().find(columns_[i].layer);
      painter.setPen(theme.faint);
      if (layer != nullptr)
        painter.drawText(QRectF(head.left() + kGrid, 0, kCellColumn * 3, half),
                         Qt::AlignVCenter | Qt::AlignLeft, one_line(layer->name));
    }
    painter.setPen(is_selected ? theme.selection_text : theme.text);
    painter.drawText(
        head.adjusted(kGrid, half, -kGrid, 0), Qt::AlignCenter,
        painter.fontMetrics().elidedText(columns_[i].name, Qt::ElideRight, int(kCellColumn) - 8));
    painter.setPen(begins ? theme.line : theme.grid);
    painter.drawLine(head.topLeft() + QPointF(0, begins ? 0 : half), head.bottomLeft());
  }
  painter.restore();
}

void ExposureSheet::paint_column(QPainter& painter, std::size_t column, int first, int last) {
  const animation::Cell* const cell = document_.project().find(columns_[column].cell);
  const double left = left_of(column);
  if (cell == nullptr || left > viewport()->width() || left + kCellColumn < kSheetMargin) return;
  for (int frame = first; frame <= last; ++frame)
    paint_box(painter, *cell, frame, QRectF(left, top_of(frame), kCellColumn, kFrameLine), frame == first);
  const bool begins = column == 0 || columns_[column].layer != columns_[column - 1].layer;
  painter.setPen(begins ? colours().line : colours().grid);
  painter.drawLine(QPointF(left, kSheetHeads), QPointF(left, top_of(last + 1)));
  painter.drawLine(QPointF(left + kCellColumn, kSheetHeads), QPointF(left + kCellColumn, top_of(last + 1)));
}

void ExposureSheet::paint_box(QPainter& painter, const animation::Cell& cell, int frame, const QRectF& box,
                              bool is_first) {
  const ThemeColours& theme = colours();
  const animation::Track& track = cell.tracks[std::size_t(Channel::Picture)];
  const int picture = animation::state_at(cell, frame).picture;
  const bool is_key = animation::key_at(track, frame) != nullptr;
  const bool is_chosen = document_.frame() == frame && document_.is_selected(cell.id);
  const bool moves = std::ranges::any_of(animation::kCameraChannels, [&](Channel channel) {
    return animation::key_at(cell.tracks[std::size_t(channel)], frame) != nullptr;
  });
  if (is_chosen) {
    painter.setPen(QPen(theme.accent, 1.6));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(box.adjusted(1, 1, -1, -1));
  }
  const QRectF room = box.adjusted(2.0 * kGrid, 0, -4.0 * kGrid, 0);
  if (is_chosen && !typed_.isEmpty()) {
    painter.setPen(theme.accent_text);
    painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft, typed_ + "|");
  } else if (is_key || frame == 0 || is_first) {
    painter.setPen(is_key || frame == 0 ? theme.text : theme.faint);
    painter.drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                     painter.fontMetrics().elidedText(short_picture_name(cell, picture), Qt::ElideRight,
                                                      int(room.width())));
  } else {
    // Held: a line down to the next exposure.
    painter.setPen(QPen(picture < 0 ? theme.grid : theme.line, 1.4));
    painter.drawLine(QPointF(room.left() + 3.0, box.top()), QPointF(room.left() + 3.0, box.bottom()));
  }
  if (!moves) return;
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme.faint);
  painter.drawEllipse(QPointF(box.right() - 2.0 * kGrid, box.center().y()), 2.6, 2.6);
}

// Mouse and keys.

void ExposureSheet::mousePressEvent(QMouseEvent* event) {
  end_typing(false);
  const QPointF at = event->position();
  if (at.y() >= kSheetHeads) document_.go_to(frame_at(at.y()));
  if (const auto column = column_at(at.x())) choose_column(*column);
}

void ExposureSheet::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton && event->position().y() >= kSheetHeads)
    document_.go_to(frame_at(event->position().y()));
}

void ExposureSheet::mouseDoubleClickEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (at.y() < kSheetHeads) return;
  if (at.x() >= kFrameNumbers + kSoundColumn && at.x() < kSheetMargin)
    return mark_(std::clamp(frame_at(at.y()), 0, document_.last_frame()));
  if (column_at(at.x())) show_pictures(event->globalPosition().toPoint());
}

void ExposureSheet::contextMenuEvent(QContextMenuEvent* event) {
  if (column_at(event->pos().x()) && event->pos().y() >= kSheetHeads) show_pictures(event->globalPos());
}

/// The list of a cell's pictures.
void ExposureSheet::show_pictures(QPoint at) {
  const animation::Cell* const cell = document_.leading();
  if (cell == nullptr || cell->id == animation::kCamera) return;
  auto* menu = new QMenu(this);
  menu->setObjectName("sheet.pictures");
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const int frame = document_.frame();
  const CellId id = cell->id;
  for (int picture = -1; picture < int(cell->pictures.size()); ++picture) {
    const QString name = picture < 0 ? QString("No picture") : shortened(short_picture_name(*cell, picture));
    menu->addAction(QString("%1  %2").arg(picture + 1).arg(name), this,
                    [=, this] { expose(id, frame, picture); });
  }
  menu->addSeparator();
  QAction* const hold = menu->addAction("Go on with the one before", this, [=, this] {
    document_.perform(deleted_keys(document_.project(), {{id, Channel::Picture, frame}}));
  });
  hold->setEnabled(animation::key_at(cell->tracks[std::size_t(Channel::Picture)], frame) != nullptr);
  menu->popup(at);
}

void ExposureSheet::type_digit(const QString& digit) {
  if (typed_.size() < 5) typed_ += digit;
  viewport()->update();
}

/// Numbers count from 1 as the list shows them; 0 exposes nothing.
void ExposureSheet::end_typing(bool use) {
  const QString typed = std::exchange(typed_, {});
  viewport()->update();
  const animation::Cell* const cell = document_.leading();
  if (!use || typed.isEmpty() || cell == nullptr || cell->id == animation::kCamera) return;
  const int picture = typed.toInt() - 1;
  if (picture >= int(cell->pictures.size()))
    return document_.remark("There is no picture " + typed.toStdString() + ": " + cell->name + " has " +
                            std::to_string(cell->pictures.size()) + ".");
  expose(cell->id, document_.frame(), picture);
}

void ExposureSheet::keyPressEvent(QKeyEvent* event) {
  const QString text = event->text();
  if (text.size() == 1 && text[0].isDigit()) return type_digit(text);
  const std::size_t column = chosen_column();
  switch (event->key()) {
    case Qt::Key_Up:
    case Qt::Key_Down:
      end_typing(true);
      return document_.go_to(document_.frame() + (event->key() == Qt::Key_Up ? -1 : 1));
    case Qt::Key_Left:
      if (column > 0) choose_column(std::min(column, columns_.size()) - 1);
      return;
    case Qt::Key_Right:
      return choose_column(column < columns_.size() ? column + 1 : 0);
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (typed_.isEmpty())
        return show_pictures(viewport()->mapToGlobal(place_of(column, document_.frame()).toPoint()));
      return end_typing(true);
    case Qt::Key_Backspace:
      typed_.chop(1);
      viewport()->update();
      return;
    case Qt::Key_Escape:
      return end_typing(false);
    default:
      QAbstractScrollArea::keyPressEvent(event);
  }
}

void ExposureSheet::focusInEvent(QFocusEvent* event) {
  viewport()->update();
  QAbstractScrollArea::focusInEvent(event);
}

void ExposureSheet::focusOutEvent(QFocusEvent* event) {
  end_typing(false);
  QAbstractScrollArea::focusOutEvent(event);
}

}  // namespace icome::ui
