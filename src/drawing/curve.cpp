#include "drawing/curve.h"

#include <algorithm>
#include <cmath>

namespace icome::drawing {
namespace {

/// A place along a curve as a segment of it and a t there.
struct PlaceInSegment {
  std::size_t segment;
  double t;
};

PlaceInSegment in_segment(const Curve& curve, double place) {
  const double whole = std::clamp(std::floor(place), 0.0, curve.end() - 1.0);
  return {std::size_t(whole), place - whole};
}

double width_within(const WidthSegment& piece, double place) {
  const double length = piece.to - piece.from;
  const double part = length > 0.0 ? (place - piece.from) / length : 0.0;
  return piece.from_width + part * (piece.to_width - piece.from_width);
}

/// The widths from one place to another, on places counted by `renumber`.
template <typename Renumber>
std::vector<WidthSegment> widths_between(const Curve& curve, double from, double to,
                                         const Renumber& renumber) {
  std::vector<WidthSegment> widths;
  for (const WidthSegment& piece : curve.widths) {
    const double begin = std::max(from, piece.from);
    const double end = std::min(to, piece.to);
    if (begin < end) {
      widths.push_back(
          {renumber(begin), width_within(piece, begin), renumber(end), width_within(piece, end)});
    }
  }
  return widths;
}

}  // namespace

Vector2 Curve::at(double place) const {
  const auto [segment, t] = in_segment(*this, place);
  return segments[segment].at(t);
}

Vector2 Curve::derivative(double place) const {
  const auto [segment, t] = in_segment(*this, place);
  return segments[segment].derivative(t);
}

double Curve::width_at(double place) const {
  if (widths.empty()) return 0.0;
  const auto after = std::partition_point(widths.begin(), widths.end(),
                                          [&](const WidthSegment& piece) { return piece.to < place; });
  return width_within(after == widths.end() ? widths.back() : *after, place);
}

Bounds2 Curve::bounds() const {
  Bounds2 box;
  for (const CubicBezier& segment : segments) box.extend(segment.bounds());
  return box;
}

double Curve::mean_width() const {
  double sum = 0.0, run = 0.0;
  for (const WidthSegment& piece : widths) {
    sum += 0.5 * (piece.from_width + piece.to_width) * (piece.to - piece.from);
    run += piece.to - piece.from;
  }
  return run > 0.0 ? sum / run : 0.0;
}

double Curve::widest() const {
  double widest = 0.0;
  for (const WidthSegment& piece : widths) widest = std::max({widest, piece.from_width, piece.to_width});
  return widest;
}

Curve part_of(const Curve& curve, double from, double to) {
  const auto [first, first_t] = in_segment(curve, from);
  auto [last, last_t] = in_segment(curve, to);
  if (last_t <= 0.0 && last > first) {
    --last;
    last_t = 1.0;
  }
  Curve part;
  for (std::size_t i = first; i <= last; ++i) {
    const double begin = i == first ? first_t : 0.0;
    const double end = i == last ? last_t : 1.0;
    part.segments.push_back(curve.segments[i].part(begin, end));
  }
  // A place keeps its segment; within the two that are cut, t is stretched.
  const auto renumber = [&, first = first, first_t = first_t, last = last, last_t = last_t](double place) {
    const double segment = std::clamp(std::floor(place), double(first), double(last));
    const double begin = segment == double(first) ? first_t : 0.0;
    const double end = segment == double(last) ? last_t : 1.0;
    return segment - double(first) + (place - segment - begin) / (end - begin);
  };
  // Within a cut segment the places are stretched evenly, so that a piece that runs over its end is cut
  // there.
  for (std::size_t i = first; i <= last; ++i) {
    const double begin = std::max(from, double(i));
    const double end = std::min(to, double(i) + 1.0);
    const auto piece = widths_between(curve, begin, end, [&](double place) {
      return place >= double(i) + 1.0 ? double(i - first) + 1.0 : renumber(place);
    });
    part.widths.insert(part.widths.end(), piece.begin(), piece.end());
  }
  return part;
}

Curve reversed(const Curve& curve) {
  Curve back;
  back.closed = curve.closed;
  for (auto segment = curve.segments.rbegin(); segment != curve.segments.rend(); ++segment)
    back.segments.push_back(segment->reversed());
  for (auto piece = curve.widths.rbegin(); piece != curve.widths.rend(); ++piece) {
    back.widths.push_back(
        {curve.end() - piece->to, piece->to_width, curve.end() - piece->from, piece->from_width});
  }
  return back;
}

Curve transformed(const Curve& curve, const Eigen::Affine2d& to_other) {
  Curve moved = curve;
  for (CubicBezier& segment : moved.segments) segment = segment.transformed(to_other);
  const double scale = std::sqrt(std::abs(to_other.linear().determinant()));
  for (WidthSegment& piece : moved.widths) {
    piece.from_width *= scale;
    piece.to_width *= scale;
  }
  return moved;
}

Curve cut_at(const Curve& curve, double place) {
  const auto [cut, t] = in_segment(curve, place);
  if (t <= 0.0 || t >= 1.0) return curve;
  Curve more = curve;
  const auto [before, after] = curve.segments[cut].split(t);
  more.segments[cut] = before;
  more.segments.insert(more.segments.begin() + std::ptrdiff_t(cut) + 1, after);
  more.widths.clear();
  const double begin = double(cut);
  const auto add = [&](double from, double to, const auto& renumber) {
    const auto widths = widths_between(curve, from, to, renumber);
    more.widths.insert(more.widths.end(), widths.begin(), widths.end());
  };
  // Within the segment places are stretched on both sides of the cut, so pieces end there.
  add(0.0, begin, [](double at) { return at; });
  add(begin, place, [&, t = t](double at) { return at >= place ? begin + 1.0 : begin + (at - begin) / t; });
  add(place, begin + 1.0, [&, t = t](double at) {
    return at >= begin + 1.0 ? begin + 2.0 : begin + 1.0 + (at - place) / (1.0 - t);
  });
  add(begin + 1.0, curve.end(), [](double at) { return at + 1.0; });
  return more;
}

}  // namespace icome::drawing
