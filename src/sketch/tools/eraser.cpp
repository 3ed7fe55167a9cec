#include "sketch/tools/eraser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sketch/tools/pick.h"

namespace icome::sketch {
namespace {

constexpr double kFoundTo = 1e-3;  // of the distance

double distance_to(std::span<const Vector2> line, const Vector2& point) {
  double least = (line.front() - point).squaredNorm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2 way = line[i] - line[i - 1];
    const double length = way.squaredNorm();
    const double part = length > 0.0 ? std::clamp((point - line[i - 1]).dot(way) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (line[i - 1] + part * way - point).squaredNorm());
  }
  return std::sqrt(least);
}

double hull_length(const CubicBezier& curve) {
  return (curve.points[1] - curve.points[0]).norm() + (curve.points[2] - curve.points[1]).norm() +
         (curve.points[3] - curve.points[2]).norm();
}

/// Collects the parts of a curve that lie beside the line. A place a length l away from one that is d from
/// the line is at least d - l and at most d + l from it, so that long pieces are decided at once.
class Beside {
 public:
  Beside(std::span<const Vector2> line, double distance) : line_(line), distance_(distance) {}

  void add(const CubicBezier& piece, double from, double to) {
    const double reach = 0.5 * hull_length(piece);
    const auto [left, right] = piece.split(0.5);
    const double away = distance_to(line_, right.points[0]);
    const bool small = reach < 0.5 * kFoundTo * distance_ || to - from < 1e-9;
    if (away - 2.0 * reach >= distance_ || (small && away >= distance_)) {
      if (!parts_.empty() && parts_.back().to == from) {
        parts_.back().to = to;
      } else {
        parts_.push_back({from, to});
      }
    } else if (away + 2.0 * reach >= distance_ && !small) {
      const double middle = 0.5 * (from + to);
      add(left, from, middle);
      add(right, middle, to);
    }
  }

  std::vector<CurvePart> take() { return std::move(parts_); }

 private:
  std::span<const Vector2> line_;
  double distance_;
  std::vector<CurvePart> parts_;
};

/// The strokes that are left of one.
std::vector<Curve> curves_left(const Curve& curve, const std::vector<CurvePart>& parts) {
  std::vector<Curve> left;
  for (const CurvePart& part : parts) {
    if (part.to <= curve.end()) {
      left.push_back(part_of(curve, part.from, part.to));
    } else {
      // Counted from its new start; what is left of the segment that was cut there is the last one, from 0
      // to 1.
      const double whole = std::floor(part.from);
      const double beyond = part.to - curve.end() - whole;
      const double stretched = beyond > 0.0 ? beyond / (part.from - whole) : beyond;
      left.push_back(part_of(opened_at(curve, part.from), 0.0, curve.end() + stretched));
    }
  }
  return left;
}

}  // namespace

std::vector<CurvePart> parts_beside(const Curve& curve, std::span<const Vector2> line, double distance) {
  Beside beside(line, distance);
  for (std::size_t i = 0; i < curve.segments.size(); ++i)
    beside.add(curve.segments[i], double(i), double(i) + 1.0);
  std::vector<CurvePart> parts = beside.take();
  if (curve.closed && parts.size() > 1 && parts.front().from == 0.0 && parts.back().to == curve.end()) {
    parts.back().to += parts.front().to;
    parts.erase(parts.begin());
  }
  return parts;
}

DrawingEdit erased(const Drawing& drawing, std::span<const Vector2> way, double radius, bool whole_strokes,
                   std::uint64_t& next_id) {
  DrawingEdit edit;
  if (way.empty()) return edit;
  Bounds2 box;
  for (const Vector2& point : way) box.extend(point);
  const Bounds2 reached(box.min() - Vector2::Constant(radius), box.max() + Vector2::Constant(radius));
  for (const Layer& layer : drawing.layers) {
    if (!can_change(layer)) continue;
    std::size_t place = 0;  // in the layer as the edit leaves it
    for (const StrokePointer& stroke : layer.strokes) {
      const Curve& curve = stroke->curve;
      const bool near = curve.bounds().intersects(reached);
      const std::vector<CurvePart> parts =
          near ? parts_beside(curve, way, radius) : std::vector<CurvePart>{{0.0, curve.end()}};
      if (parts.size() == 1 && parts[0].from == 0.0 && parts[0].to == curve.end()) {
        ++place;
        continue;
      }
      edit.emplace_back(TakeStroke{stroke->id});
      if (whole_strokes) continue;
      for (Curve& left : curves_left(curve, parts)) {
        auto rest = std::make_shared<Stroke>(*stroke);
        rest->id = StrokeId{next_id++};
        rest->curve = std::move(left);
        if (curve.closed && parts.size() > 1) rest->fill.reset();  // no part has the whole area any more
        edit.emplace_back(PutStroke{layer.id, place++, std::move(rest)});
      }
    }
  }
  return edit;
}

Curve opened_at(const Curve& closed, double place) {
  Curve cut = cut_at(closed, place);
  cut.closed = false;
  const double at = place == std::floor(place) ? place : std::floor(place) + 1.0;
  if (at <= 0.0 || at >= cut.end()) return cut;
  Curve open = part_of(cut, at, cut.end());
  const Curve rest = part_of(cut, 0.0, at);
  const double shift = open.end();
  open.segments.insert(open.segments.end(), rest.segments.begin(), rest.segments.end());
  for (WidthSegment piece : rest.widths) {
    piece.from += shift;
    piece.to += shift;
    open.widths.push_back(piece);
  }
  return open;
}

}  // namespace icome::sketch
