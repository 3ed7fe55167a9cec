#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "drawing/outline/outline.h"

namespace icome::drawing::testing {

// The judges of outlines: what they are built from shares nothing with src/drawing/outline.

/// Counts how often a closed path of cubics winds around points: crossings of a level line to the right of
/// each.
class Windings {
 public:
  explicit Windings(const std::vector<OutlinePiece>& pieces) {
    for (const OutlinePiece& piece : pieces) {
      for (const CubicBezier& edge : piece.rim) add_level_parts(edge);
    }
  }

  int around(const Vector2& p) const {
    int winding = 0;
    for (const Monotone& m : parts_) {
      const double low = m.curve.points[0].y(), high = m.curve.points[3].y();
      if ((low <= p.y()) == (high <= p.y()) || m.right < p.x()) continue;
      if (m.left > p.x() || crossing_x(m.curve, p.y()) > p.x()) winding += high > low ? 1 : -1;
    }
    return winding;
  }

 private:
  /// A part whose y only rises or only falls.
  struct Monotone {
    CubicBezier curve;
    double left, right;
  };

  void add_level_parts(const CubicBezier& edge) {
    std::vector<double> cuts = {0.0};
    const auto& p = edge.points;
    const double a = p[3].y() - p[0].y() + 3.0 * (p[1].y() - p[2].y());
    const double b = 2.0 * (p[2].y() - 2.0 * p[1].y() + p[0].y());
    const double c = p[1].y() - p[0].y();
    const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
    const double q = -0.5 * (b + std::copysign(root, b));
    for (const double t : {q / a, c / q})
      if (t > 0.0 && t < 1.0) cuts.push_back(t);
    cuts.push_back(1.0);
    std::sort(cuts.begin(), cuts.end());
    Vector2 at = p[0];
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      CubicBezier part = edge.part(cuts[i - 1], cuts[i]);
      part.points[0] = at;  // neighbours share their ends to the last bit
      if (i + 1 == cuts.size()) part.points[3] = p[3];
      at = part.points[3];
      const auto box = part.hull_bounds();
      parts_.push_back({part, box.min().x(), box.max().x()});
    }
  }

  static double crossing_x(const CubicBezier& curve, double y) {
    const bool rising = curve.points[3].y() > curve.points[0].y();
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      ((curve.at(middle).y() < y) == rising ? low : high) = middle;
    }
    return curve.at(0.5 * (low + high)).x();
  }

  std::vector<Monotone> parts_;
};

/// The discs of a curve, densely: how far a point is from all of them (m; negative inside).
class DenseDiscs {
 public:
  explicit DenseDiscs(const Curve& curve) : curve_(curve) {
    for (const WidthSegment& piece : curve.widths) {
      std::vector<double> places = {piece.from, piece.to};
      for (double whole = std::ceil(piece.from); whole < piece.to; whole += 1.0) places.push_back(whole);
      std::sort(places.begin(), places.end());
      for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] <= places[i - 1]) continue;
        const std::size_t first = discs_.size();
        for (int k = 0; k <= kSamples; ++k) {
          const double place =
              k == kSamples ? places[i] : std::lerp(places[i - 1], places[i], double(k) / kSamples);
          discs_.push_back(disc(piece, places[i - 1], place));
          discs_.back().first = first;
        }
        discs_[first].reach = discs_[first + 1].reach;
      }
    }
  }

  double distance(const Vector2& p) const { return least(p, true); }
  /// The distance without the places that are nearest just because the line ends there.
  double distance_within(const Vector2& p) const { return least(p, false); }

  /// Some point near the rim or within: where a test looks closely.
  Vector2 some_point(base::Random& random, double spread) const {
    const Disc& disc = discs_[random.index(discs_.size())];
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    // Not on the curve itself: there, ways to and fro cancel out only to rounding.
    const double reach = random.index(2) ? disc.radius + random.uniform(-spread, spread)
                                         : disc.radius * random.uniform(0.0, 1.3) + 1e-3 * spread;
    return disc.centre + reach * Vector2(std::cos(angle), std::sin(angle));
  }

 private:
  static constexpr int kSamples = 200;

  struct Disc {
    Vector2 centre;
    double radius;
    double place;
    double begin;  // of the piece: a whole place belongs to the segment of the piece
    const WidthSegment* piece;
    double reach = 0.0;  // m, by which the value may change until the next one
    std::size_t first = 0;
  };

  /// Is it where the line is first or last seen?
  bool at_an_end(const Disc& disc) const {
    const auto seen = [](const Disc& other) { return other.radius > 0.0; };
    const auto first = std::find_if(discs_.begin(), discs_.end(), seen);
    const auto last = std::find_if(discs_.rbegin(), discs_.rend(), seen);
    return first == discs_.end() || (disc.centre - first->centre).norm() < 1e-9 ||
           (disc.centre - last->centre).norm() < 1e-9;
  }

  /// The value one sample on; past the end of a piece, where the next one begins with the same disc, two on.
  static double value_beside(const std::vector<double>& value, std::size_t k, bool at_end, int step) {
    const auto at = [&](std::ptrdiff_t i) {
      return i < 0 || i >= std::ptrdiff_t(value.size()) ? 1e300 : value[std::size_t(i)];
    };
    const auto next = std::ptrdiff_t(k) + step;
    const bool same = at_end && std::abs(at(next) - value[k]) < 1e-12;
    return at(same ? next + step : next);
  }

  double least(const Vector2& p, bool with_ends) const {
    std::vector<double> value;
    for (const Disc& disc : discs_) value.push_back((p - disc.centre).norm() - disc.radius);
    const double best = *std::min_element(value.begin(), value.end());
    double least = 1e300;
    for (std::size_t k = 0; k < discs_.size(); ++k) {
      const bool first = discs_[k].first == k;
      const bool last = k + 1 == discs_.size() || discs_[k + 1].first == k + 1;
      const double before = first && with_ends ? value[k] : value_beside(value, k, first, -1);
      const double after = last && with_ends ? value[k] : value_beside(value, k, last, 1);
      if (value[k] > before || value[k] > after || value[k] > best + discs_[k].reach) continue;
      if (!with_ends && at_an_end(discs_[k])) continue;
      least = std::min({least, value[k], least_between(p, first ? k : k - 1, last ? k : k + 1)});
    }
    return least;
  }

  Disc disc(const WidthSegment& piece, double begin, double place) const {
    const auto segment = std::min(std::size_t(begin), curve_.segments.size() - 1);
    const double part = (place - piece.from) / (piece.to - piece.from);
    const Vector2 centre = curve_.segments[segment].at(place - double(segment));
    const double radius = 0.5 * std::lerp(piece.from_width, piece.to_width, part);
    const double reach =
        discs_.empty() ? 0.0
                       : (centre - discs_.back().centre).norm() + std::abs(radius - discs_.back().radius);
    return {centre, radius, place, begin, &piece, 4.0 * reach, 0};
  }

  double least_between(const Vector2& p, std::size_t low, std::size_t high) const {
    double a = discs_[low].place, b = discs_[high].place;
    const auto value = [&](double place) {
      const Disc d = disc(*discs_[low].piece, discs_[low].begin, place);
      return (p - d.centre).norm() - d.radius;
    };
    constexpr double kGolden = 0.6180339887498949;
    double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
    double at_c = value(c), at_d = value(d);
    for (int i = 0; i < 40; ++i) {
      if (at_c < at_d) {
        b = d, d = c, at_d = at_c;
        at_c = value(c = b - kGolden * (b - a));
      } else {
        a = c, c = d, at_c = at_d;
        at_d = value(d = a + kGolden * (b - a));
      }
    }
    return std::min({at_c, at_d, value(a), value(b)});
  }

  const Curve& curve_;
  std::vector<Disc> discs_;
};

/// A curve that looks for trouble.
inline Curve troublesome_curve(base::Random& random, double size) {
  const auto point = [&] { return Vector2(random.uniform(0.0, size), random.uniform(0.0, size)); };
  Curve curve;
  const std::size_t count = 1 + random.index(4);
  Vector2 at = point();
  for (std::size_t i = 0; i < count; ++i) {
    Vector2 a = point(), b = point(), end = point();
    const Vector2 way = end - at;
    switch (random.index(9)) {
      case 0:  // a straight line
        a = at + way / 3.0, b = at + 2.0 / 3.0 * way;
        break;
      case 1:  // doubled back on itself
        a = at + random.uniform(-2.0, 3.0) * way, b = at + random.uniform(-2.0, 3.0) * way;
        break;
      case 2:  // an exact cusp in the middle
        end = at + Vector2(way.x(), 0.0);
        a = end + Vector2(0.0, 0.3 * size), b = at + Vector2(0.0, 0.3 * size);
        break;
      case 3:  // a point
        a = b = end = at;
        break;
      case 4:  // no handles
        a = at, b = end;
        break;
      case 5:  // one handle of no length
        (random.index(2) ? a = at : b = end);
        break;
      case 6:  // smooth to the one before
        if (!curve.segments.empty())
          a = at + random.uniform(0.1, 1.0) * (at - curve.segments.back().points[2]);
        break;
      case 7:  // small and round
        a = at + 0.05 * (a - at), b = at + 0.05 * (b - at), end = at + 0.03 * (end - at);
        break;
      default:
        break;
    }
    curve.segments.push_back({{at, a, b, end}});
    at = end;
  }
  if (random.index(4) == 0) {
    curve.closed = true;
    curve.segments.back().points[3] = curve.segments.front().points[0];
    if (random.index(2))
      curve.segments.back().points[2] =
          2.0 * curve.segments.front().points[0] - curve.segments.front().points[1];
  }
  const double thick = size * std::pow(10.0, random.uniform(-2.5, 0.0));
  double place = 0.0;
  double width = random.index(3) ? random.uniform(0.0, thick) : 0.0;
  const auto kind = random.index(4);
  while (place < double(count)) {
    double to = kind == 0 ? double(count) : std::min(double(count), place + random.uniform(0.05, 1.5));
    double to_width = kind <= 1 ? width : random.index(5) ? random.uniform(0.0, thick) : 0.0;
    if (kind == 0 && width == 0.0) width = to_width = thick;
    curve.widths.push_back({place, width, to, to_width});
    place = to;
    width = random.index(12) ? to_width : random.uniform(0.0, thick);  // sometimes with a jump
  }
  return curve;
}

}  // namespace icome::drawing::testing
