#include "ui/sketch/stroke_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/parallel.h"
#include "drawing/outline/outline.h"
#include "ui/forms/colour_button.h"
#include "ui/look/theme.h"

namespace icome::ui {

using drawing::StrokePointer;
namespace {

constexpr double kMmOfPath = 1000.0;         // mm in a m
constexpr double kUnseenPixels = 0.04;       // by which an outline may be off
constexpr std::size_t kSpareOutlines = 256;  // kept beside those that are seen, for undo and drags
constexpr double kFinerThanNeeded = 8.0;  // an outline that is finer takes longer to fill than to make anew
constexpr std::size_t kStrokesOfSheet = 400;
constexpr std::size_t kMostSheets = 16;
constexpr qsizetype kMostSheetBytes = 192 << 20;  // of all together
constexpr std::size_t kStrokesForThreads = 200;   // fewer are drawn before threads have started

QPointF path_point(const drawing::Vector2& place) { return {kMmOfPath * place.x(), kMmOfPath * place.y()}; }

void add_loop(QPainterPath& path, const std::vector<drawing::CubicBezier>& edges) {
  if (edges.empty()) return;
  path.moveTo(path_point(edges.front().points[0]));
  for (const drawing::CubicBezier& edge : edges)
    path.cubicTo(path_point(edge.points[1]), path_point(edge.points[2]), path_point(edge.points[3]));
  path.closeSubpath();
}

std::vector<StrokePointer> seen_strokes(const drawing::Drawing& drawing) {
  std::vector<StrokePointer> all;
  for (const drawing::Layer& layer : drawing.layers)
    if (layer.visible) all.insert(all.end(), layer.strokes.begin(), layer.strokes.end());
  return all;
}

/// The box of a stroke with its line, mm.
QRectF paper_box(const drawing::Curve& curve) {
  if (curve.segments.empty()) return {};
  const drawing::Bounds2 box = curve.bounds();
  const double reach = kMmOfPath * (0.5 * curve.widest());
  return QRectF(path_point(box.min()), path_point(box.max())).adjusted(-reach, -reach, reach, reach);
}

/// An outline that is exact enough at one zoom is used up to twice that zoom.
double tolerance_at(const PaperView& view, double pixel_ratio) {
  const double scale = view.pixels_per_mm() * pixel_ratio;
  return kUnseenPixels / (kMmOfPath * std::exp2(std::ceil(std::log2(scale))));
}

/// Moves what an image shows by so many pixels; what was not there before is as it was. Four bytes a pixel.
void shift_image(QImage& image, QPoint by) {
  constexpr qsizetype kPixelBytes = 4;
  const int left = std::max(0, by.x()), width = image.width() - std::abs(by.x());
  const int top = std::max(0, by.y()), height = image.height() - std::abs(by.y());
  uchar* const bits = image.bits();
  for (int i = 0; i < height; ++i) {
    const int y = by.y() > 0 ? top + height - 1 - i : top + i;  // none is read after it was written
    uchar* const to = bits + y * image.bytesPerLine() + kPixelBytes * left;
    const uchar* const from = bits + (y - by.y()) * image.bytesPerLine() + kPixelBytes * (left - by.x());
    std::memmove(to, from, std::size_t(kPixelBytes * width));
  }
}

}  // namespace

QPainterPath line_path(const drawing::Curve& curve, drawing::CurveEnds ends, double tolerance) {
  QPainterPath path;
  path.setFillRule(Qt::WindingFill);
  for (const drawing::OutlinePiece& piece : drawing::outline_of(curve, ends, tolerance))
    add_loop(path, piece.rim);
  return path;
}

StrokePicture::Painted& StrokePicture::painted(const StrokePointer& stroke) {
  const auto known = painted_.find(stroke.get());
  if (known != painted_.end()) return known->second;
  Painted made;
  made.stroke = stroke;
  made.box = paper_box(stroke->curve);
  if (stroke->fill) {
    made.inside.setFillRule(Qt::WindingFill);
    add_loop(made.inside, stroke->curve.segments);
  }
  return painted_.emplace(stroke.get(), std::move(made)).first->second;
}

/// Outlines a stroke that is to be seen, unless it is outlined well enough.
void StrokePicture::outline(Painted& it) const {
  const bool is_fine = it.tolerance > 0.0 && it.tolerance <= tolerance_;
  if (is_fine && it.tolerance * kFinerThanNeeded >= tolerance_) return;
  it.line = line_path(it.stroke->curve, it.stroke->ends, tolerance_);
  it.tolerance = tolerance_;
}

void StrokePicture::paint(QPainter& painter, const StrokePointer& stroke) { paint(painter, painted(stroke)); }

void StrokePicture::paint(QPainter& painter, Painted& it) {
  outline(it);
  const drawing::Stroke& stroke = *it.stroke;
  const auto fill = [&](QPainter& on, double opacity) {
    on.setOpacity(opacity);
    if (stroke.fill) on.fillPath(it.inside, screen_colour(*stroke.fill));
    on.fillPath(it.line, screen_colour(stroke.colour));
  };
  const double opacity = painter.opacity() * stroke.opacity;
  const double before = painter.opacity();
  if (!stroke.fill || it.line.isEmpty() || opacity >= 1.0) {
    fill(painter, opacity);
  } else {
    // Line and fill of one stroke do not show through each other.
    const QTransform at = painter.transform();
    const QRect box = at.mapRect(it.box).toAlignedRect().adjusted(-2, -2, 2, 2) & image_.rect();
    const double ratio = image_.devicePixelRatio();
    QImage group((QSizeF(box.size()) * ratio).toSize(), QImage::Format_ARGB32_Premultiplied);
    if (group.isNull()) return;
    group.setDevicePixelRatio(ratio);
    group.fill(Qt::transparent);
    QPainter within(&group);
    within.setRenderHint(QPainter::Antialiasing);
    within.setTransform(at * QTransform::fromTranslate(-box.x(), -box.y()));
    fill(within, 1.0);
    within.end();
    painter.resetTransform();
    painter.setOpacity(opacity);
    painter.drawImage(box.topLeft(), group);
    painter.setTransform(at);
  }
  painter.setOpacity(before);
}

StrokePicture::Difference StrokePicture::difference_to(const std::vector<StrokePointer>& now) {
  Difference difference;
  const std::size_t shorter = std::min(now.size(), strokes_.size());
  std::size_t& front = difference.front;
  std::size_t& back = difference.back;
  while (front < shorter && now[front] == strokes_[front]) ++front;
  while (back < shorter - front && now[now.size() - 1 - back] == strokes_[strokes_.size() - 1 - back]) ++back;
  // In lists of the same length strokes are mostly replaced one by one.
  const bool is_same_count = now.size() == strokes_.size();
  for (std::size_t i = front; i < strokes_.size() - back; ++i)
    if (!is_same_count || now[i] != strokes_[i]) difference.box |= shown_[i]->box;
  for (std::size_t i = front; i < now.size() - back; ++i)
    if (!is_same_count || now[i] != strokes_[i]) difference.box |= painted(now[i]).box;
  return difference;
}

void StrokePicture::take(std::vector<StrokePointer> now, std::size_t same_in_front, std::size_t same_behind) {
  std::vector<Painted*> shown(shown_.begin(), shown_.begin() + std::ptrdiff_t(same_in_front));
  for (std::size_t i = same_in_front; i < now.size() - same_behind; ++i) shown.push_back(&painted(now[i]));
  shown.insert(shown.end(), shown_.end() - std::ptrdiff_t(same_behind), shown_.end());
  shown_ = std::move(shown);
  strokes_ = std::move(now);
  forget_unused();
}

void StrokePicture::forget_unused() {
  if (painted_.size() <= strokes_.size() + kSpareOutlines) return;
  for (auto& [stroke, it] : painted_) it.is_used = false;
  for (Painted* const it : shown_) it->is_used = true;
  std::erase_if(painted_, [](const auto& it) { return !it.second.is_used; });
}

void StrokePicture::draw_paper(QPainter& painter) const {
  constexpr int kShadowRings = 6;
  const QRectF paper(0.0, 0.0, kMmOfPath * paper_.x(), kMmOfPath * paper_.y());
  const double pixel = 1.0 / view_.pixels_per_mm();
  painter.setPen(Qt::NoPen);
  for (int i = kShadowRings; i > 0; --i) {
    painter.setBrush(QColor(0, 0, 0, is_dark() ? 22 : 9));
    const double reach = i * pixel;
    painter.drawRoundedRect(paper.adjusted(-reach, -reach, reach, reach).translated(0.0, pixel), reach,
                            reach);
  }
  painter.fillRect(paper, Qt::white);
}

/// Paints strokes from one place in the list to another, those that reach into the part.
void StrokePicture::paint_range(QPainter& painter, std::size_t from, std::size_t to, const QRect& part) {
  const QRectF within =
      view_.screen_from_mm().inverted().mapRect(QRectF(part).adjusted(-1.0, -1.0, 1.0, 1.0));
  for (std::size_t i = from; i < to; ++i)
    if (shown_[i]->box.intersects(within)) paint(painter, *shown_[i]);
}

void StrokePicture::draw_sheet(Sheet& sheet, std::size_t first, const QRect& part) {
  QPainter painter(&sheet.picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(part);
  painter.setCompositionMode(QPainter::CompositionMode_Source);
  painter.fillRect(part, Qt::transparent);
  painter.setCompositionMode(QPainter::CompositionMode_SourceOver);
  painter.setTransform(view_.screen_from_mm());
  paint_range(painter, first, first + sheet.count, part);
}

/// Draws a part of some sheets. Each is drawn by one thread, and so is each stroke, which is outlined there.
void StrokePicture::draw_sheets(const QRect& part, std::size_t from, std::size_t to) {
  std::vector<std::size_t> first(to, 0);
  std::size_t strokes = 0;
  for (std::size_t i = 0; i + 1 < to; ++i) first[i + 1] = first[i] + sheets_[i].count;
  for (std::size_t i = from; i < to; ++i) strokes += sheets_[i].count;
  const std::size_t grain = strokes < kStrokesForThreads ? to - from : 1;
  base::parallel_for(to - from, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = from + begin; i < from + end; ++i) draw_sheet(sheets_[i], first[i], part);
  });
}

/// Lays a part of all sheets over the paper.
void StrokePicture::put_together(const QRect& part) {
  QPainter painter(&image_);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(part);
  painter.fillRect(part, desk_);
  painter.setTransform(view_.screen_from_mm());
  draw_paper(painter);
  painter.resetTransform();
  const double ratio = image_.devicePixelRatio();
  const QRectF pixels(QPointF(part.topLeft()) * ratio, QSizeF(part.size()) * ratio);
  for (const Sheet& sheet : sheets_) painter.drawImage(QRectF(part), sheet.picture, pixels);
}

/// Shares all strokes out to sheets, which are still bare.
void StrokePicture::share_out() {
  const auto most =
      std::size_t(std::max<qsizetype>(1, kMostSheetBytes / std::max<qsizetype>(1, image_.sizeInBytes())));
  const std::size_t wanted = 1 + shown_.size() / kStrokesOfSheet;
  sheets_.resize(std::min({wanted, most, kMostSheets}));
  for (std::size_t i = 0; i < sheets_.size(); ++i) {
    Sheet& sheet = sheets_[i];
    sheet.count = (i + 1) * shown_.size() / sheets_.size() - i * shown_.size() / sheets_.size();
    if (sheet.picture.size() != image_.size())
      sheet.picture = QImage(image_.size(), QImage::Format_ARGB32_Premultiplied);
    sheet.picture.setDevicePixelRatio(image_.devicePixelRatio());
  }
}

void StrokePicture::draw_all() {
  share_out();
  draw_sheets(whole(), 0, sheets_.size());
  put_together(whole());
}

/// Moves the counts of sheets along with a change; it concerns the sheets from one to another.
void StrokePicture::change_counts(const Difference& change, std::size_t before, std::size_t& from,
                                  std::size_t& to) {
  std::size_t first = 0;
  from = 0;
  while (from + 1 < sheets_.size() && change.front >= first + sheets_[from].count)
    first += sheets_[from++].count;
  if (before == shown_.size()) {
    // Replaced one by one: those between them, which are not drawn anew, stay in their sheets.
    for (to = from; to < sheets_.size() && (to == from || first < before - change.back); ++to)
      first += sheets_[to].count;
    return;
  }
  std::size_t gone = before - change.front - change.back;
  std::size_t inside = change.front - first;  // strokes of the sheet before those that go
  for (to = from; to < sheets_.size() && (to == from || gone > 0); ++to) {
    const std::size_t here = std::min(gone, sheets_[to].count - inside);
    sheets_[to].count -= here;
    gone -= here;
    inside = 0;
  }
  sheets_[from].count += shown_.size() - change.front - change.back;
}

QRect StrokePicture::whole() const {
  return {QPoint(), (QSizeF(image_.size()) / image_.devicePixelRatio()).toSize()};
}

std::optional<QPoint> StrokePicture::whole_shift(const PaperView& view) const {
  const QPointF by = view.to_screen({0.0, 0.0}) - view_.to_screen({0.0, 0.0});
  PaperView shifted = view_;
  shifted.shift(by);
  const QPointF pixels = by * image_.devicePixelRatio();
  const bool is_whole = QPointF(by.toPoint()) == by && QPointF(pixels.toPoint()) == pixels;
  if (!is_whole || shifted != view || !whole().intersects(whole().translated(by.toPoint())))
    return std::nullopt;
  return by.toPoint();
}

/// Takes the pictures along, and draws what comes into view.
void StrokePicture::shift_to(const PaperView& view, QPoint by) {
  const QPoint pixels = (QPointF(by) * image_.devicePixelRatio()).toPoint();
  shift_image(image_, pixels);
  base::parallel_for(sheets_.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) shift_image(sheets_[i].picture, pixels);
  });
  view_ = view;
  for (const QRect& bare : QRegion(whole()) - QRegion(whole().translated(by))) {
    draw_sheets(bare, 0, sheets_.size());
    put_together(bare);
  }
}

/// Lays strokes that are new over all others.
void StrokePicture::lay_on_top(std::size_t first) {
  for (QImage* const picture : {&sheets_.back().picture, &image_}) {
    QPainter painter(picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setTransform(view_.screen_from_mm());
    paint_range(painter, first, shown_.size(), whole());
  }
  sheets_.back().count += shown_.size() - first;
}

/// Draws what has changed in the same view.
QRect StrokePicture::change(std::vector<StrokePointer> now) {
  const Difference difference = difference_to(now);
  const std::size_t before = strokes_.size();
  const bool is_other = before != now.size() || difference.front < before;
  take(std::move(now), difference.front, difference.back);
  if (!is_other) return {};
  const QRect part =
      whole() & view_.screen_from_mm().mapRect(difference.box).toAlignedRect().adjusted(-2, -2, 2, 2);
  if (difference.front == before) {
    lay_on_top(before);
    return part;
  }
  std::size_t from = 0, to = 0;
  change_counts(difference, before, from, to);
  if (part.isEmpty()) return part;
  draw_sheets(part, from, to);
  put_together(part);
  return part;
}

QRect StrokePicture::show(const drawing::Drawing& drawing, const PaperView& view, QSize size,
                          double pixel_ratio) {
  const QSize pixels = (QSizeF(size) * pixel_ratio).toSize();
  const QColor desk = is_dark() ? colours().base : colours().grid;
  const bool is_other = image_.size() != pixels || image_.devicePixelRatio() != pixel_ratio ||
                        paper_ != drawing.size || desk != desk_;
  std::vector<StrokePointer> now = seen_strokes(drawing);
  if (!is_other && view_ == view) return change(std::move(now));
  tolerance_ = tolerance_at(view, pixel_ratio);
  const auto shift = whole_shift(view);
  const bool is_shifted = !is_other && shift && now == strokes_;
  take(std::move(now), 0, 0);
  if (is_shifted) {
    shift_to(view, *shift);
    return whole();
  }
  if (image_.size() != pixels) image_ = QImage(pixels, QImage::Format_RGB32);
  image_.setDevicePixelRatio(pixel_ratio);
  view_ = view;
  paper_ = drawing.size;
  desk_ = desk;
  draw_all();
  return whole();
}

}  // namespace icome::ui
