#include "ui/sketch/stroke_picture.h"

#include <algorithm>
#include <cmath>

#include "drawing/outline/outline.h"
#include "ui/forms/colour_button.h"
#include "ui/look/theme.h"

namespace icome::ui {

using drawing::StrokePointer;
namespace {

constexpr double kMmOfPath = 1000.0;         // mm in a m
constexpr double kUnseenPixels = 0.04;       // by which an outline may be off
constexpr std::size_t kSpareOutlines = 256;  // kept beside those that are seen, for undo and drags

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

/// An outline that is exact enough at one zoom is used up to twice that zoom.
double tolerance_at(const PaperView& view, double pixel_ratio) {
  const double scale = view.pixels_per_mm() * pixel_ratio;
  return kUnseenPixels / (kMmOfPath * std::exp2(std::ceil(std::log2(scale))));
}

}  // namespace

QPainterPath line_path(const drawing::Curve& curve, drawing::CurveEnds ends, double tolerance) {
  QPainterPath path;
  path.setFillRule(Qt::WindingFill);
  for (const drawing::OutlinePiece& piece : drawing::outline_of(curve, ends, tolerance))
    add_loop(path, piece.rim);
  return path;
}

const StrokePicture::Painted& StrokePicture::painted(const StrokePointer& stroke) {
  const auto known = painted_.find(stroke.get());
  if (known != painted_.end()) return known->second;
  Painted made{
      .stroke = stroke, .line = line_path(stroke->curve, stroke->ends, tolerance_), .inside = {}, .box = {}};
  if (stroke->fill) {
    made.inside.setFillRule(Qt::WindingFill);
    add_loop(made.inside, stroke->curve.segments);
  }
  made.box = made.line.controlPointRect().united(made.inside.controlPointRect());
  return painted_.emplace(stroke.get(), std::move(made)).first->second;
}

void StrokePicture::paint(QPainter& painter, const StrokePointer& stroke) { paint(painter, painted(stroke)); }

void StrokePicture::paint(QPainter& painter, const Painted& it) {
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

/// The box in which two lists of strokes differ, mm.
QRectF StrokePicture::changed_box(const std::vector<StrokePointer>& now) {
  QRectF box;
  const auto add = [&](const StrokePointer& stroke) { box = box.united(painted(stroke).box); };
  if (now.size() == strokes_.size()) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == strokes_[i]) continue;
      add(strokes_[i]);
      add(now[i]);
    }
    return box;
  }
  const std::size_t shorter = std::min(now.size(), strokes_.size());
  std::size_t front = 0;
  while (front < shorter && now[front] == strokes_[front]) ++front;
  std::size_t back = 0;
  while (back < shorter - front && now[now.size() - 1 - back] == strokes_[strokes_.size() - 1 - back]) ++back;
  for (std::size_t i = front; i < strokes_.size() - back; ++i) add(strokes_[i]);
  for (std::size_t i = front; i < now.size() - back; ++i) add(now[i]);
  return box;
}

void StrokePicture::forget_unused() {
  if (painted_.size() <= strokes_.size() + kSpareOutlines) return;
  std::unordered_map<const drawing::Stroke*, Painted> used;
  for (const StrokePointer& stroke : strokes_) {
    const auto known = painted_.find(stroke.get());
    if (known != painted_.end()) used.emplace(known->first, std::move(known->second));
  }
  painted_ = std::move(used);
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

void StrokePicture::draw(const QRect& part) {
  QPainter painter(&image_);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(part);
  painter.fillRect(part, desk_);
  const QTransform from_mm = view_.screen_from_mm();
  painter.setTransform(from_mm);
  draw_paper(painter);
  const QRectF within = from_mm.inverted().mapRect(QRectF(part).adjusted(-1.0, -1.0, 1.0, 1.0));
  for (const StrokePointer& stroke : strokes_) {
    const Painted& it = painted(stroke);
    if (it.box.intersects(within)) paint(painter, it);
  }
}

QRect StrokePicture::show(const drawing::Drawing& drawing, const PaperView& view, QSize size,
                          double pixel_ratio) {
  const QSize pixels = (QSizeF(size) * pixel_ratio).toSize();
  std::vector<StrokePointer> now = seen_strokes(drawing);
  const QColor desk = is_dark() ? colours().base : colours().grid;
  const bool whole = image_.size() != pixels || image_.devicePixelRatio() != pixel_ratio || view_ != view ||
                     paper_ != drawing.size || desk != desk_;
  if (const double tolerance = tolerance_at(view, pixel_ratio); tolerance != tolerance_) {
    tolerance_ = tolerance;
    painted_.clear();
  }
  QRect part(QPoint(), size);
  if (!whole) {
    const QRectF box = changed_box(now);
    if (box.isEmpty())
      part = {};
    else
      part &= view.screen_from_mm().mapRect(box).toAlignedRect().adjusted(-2, -2, 2, 2);
  } else if (image_.size() != pixels) {
    image_ = QImage(pixels, QImage::Format_RGB32);
  }
  image_.setDevicePixelRatio(pixel_ratio);
  view_ = view;
  paper_ = drawing.size;
  desk_ = desk;
  strokes_ = std::move(now);
  if (!part.isEmpty()) draw(part);
  forget_unused();
  return part;
}

}  // namespace icome::ui
