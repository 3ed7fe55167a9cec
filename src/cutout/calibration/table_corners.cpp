#include "cutout/calibration/table_corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kLeastTable = 0.08;  // of the frame that the table must cover
constexpr int kSideSamples = 160;

/// The share of a colour that a pixel has, from -1 to 1, and from where on it counts as that colour.
struct ColourMeasure {
  double (*strength)(const std::uint8_t* bgr);
  double least;
};

/// Strength of red against the other colours, from -1 to 1; the light's strength does not matter.
double redness(const std::uint8_t* bgr) {
  const double blue = bgr[0], green = bgr[1], red = bgr[2];
  return (red - std::max(blue, green)) / (red + std::max(blue, green) + 12.0);
}
double blueness(const std::uint8_t* bgr) {
  const double blue = bgr[0], red = bgr[2];
  return (blue - red) / (red + blue + 12.0);
}
constexpr ColourMeasure kTableRed = {redness, 0.3};
constexpr ColourMeasure kPlasticBlue = {blueness, 0.12};

double strength_at(const FrameView& frame, const ColourMeasure& colour, const Vector2& place) {
  const int x = std::clamp(int(std::floor(place.x())), 0, frame.width - 2);
  const int y = std::clamp(int(std::floor(place.y())), 0, frame.height - 2);
  const double u = std::clamp(place.x() - x, 0.0, 1.0), v = std::clamp(place.y() - y, 0.0, 1.0);
  const auto at = [&](int column, int row) { return colour.strength(frame.row(row) + 3 * column); };
  return (at(x, y) * (1 - u) + at(x + 1, y) * u) * (1 - v) +
         (at(x, y + 1) * (1 - u) + at(x + 1, y + 1) * u) * v;
}

/// Outermost pixels of each row of the largest piece of a colour.
struct ColouredPiece {
  std::vector<Vector2> border;
  std::size_t pixels = 0;
};

ColouredPiece largest_piece(const FrameView& frame, const ColourMeasure& colour) {
  const auto width = std::size_t(frame.width), height = std::size_t(frame.height);
  std::vector<std::int32_t> piece_of(width * height, -1);
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> open;
  const auto has_it = [&](std::size_t at) {
    return colour.strength(frame.row(int(at / width)) + 3 * (at % width)) > colour.least;
  };
  for (std::size_t from = 0; from < piece_of.size(); ++from) {
    if (piece_of[from] != -1) continue;
    if (!has_it(from)) {
      piece_of[from] = -2;
      continue;
    }
    const auto number = std::int32_t(sizes.size());
    sizes.push_back(0);
    piece_of[from] = number;
    open.push_back(from);
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      ++sizes.back();
      const auto visit = [&](std::size_t beside) {
        if (piece_of[beside] != -1) return;
        piece_of[beside] = has_it(beside) ? number : -2;
        if (piece_of[beside] == number) open.push_back(beside);
      };
      if (at % width > 0) visit(at - 1);
      if (at % width + 1 < width) visit(at + 1);
      if (at >= width) visit(at - width);
      if (at + width < piece_of.size()) visit(at + width);
    }
  }
  ColouredPiece piece;
  if (sizes.empty()) return piece;
  const auto largest = std::int32_t(std::ranges::max_element(sizes) - sizes.begin());
  piece.pixels = sizes[std::size_t(largest)];
  for (std::size_t y = 0; y < height; ++y) {
    std::size_t first = width, last = 0;
    for (std::size_t x = 0; x < width; ++x)
      if (piece_of[y * width + x] == largest) {
        first = std::min(first, x);
        last = x;
      }
    if (first == width) continue;
    piece.border.emplace_back(double(first), double(y));
    if (last != first) piece.border.emplace_back(double(last), double(y));
  }
  return piece;
}

double turned(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

std::vector<Vector2> convex_border(std::vector<Vector2> points) {
  std::ranges::sort(points, [](const Vector2& a, const Vector2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  std::vector<Vector2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (const Vector2& point : points) {
      while (hull.size() >= first + 2 && turned(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

/// Leaves out, one after the other, the corner that takes the least area with it, until so many are left.
std::vector<Vector2> reduced_to(std::size_t count, std::vector<Vector2> hull) {
  while (hull.size() > count) {
    std::size_t least = 0;
    double least_area = 1e18;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vector2& before = hull[(i + hull.size() - 1) % hull.size()];
      const double area = std::abs(turned(before, hull[i], hull[(i + 1) % hull.size()]));
      if (area >= least_area) continue;
      least_area = area;
      least = i;
    }
    hull.erase(hull.begin() + std::ptrdiff_t(least));
  }
  return hull;
}

/// A line: all p with normal . p = offset.
struct SideLine {
  Vector2 normal;
  double offset;
};

SideLine line_through(const std::vector<Vector2>& points, const std::vector<double>& weights) {
  Vector2 middle = Vector2::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    middle += weights[i] * points[i];
    sum += weights[i];
  }
  middle /= sum;
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2 way = points[i] - middle;
    xx += weights[i] * way.x() * way.x();
    xy += weights[i] * way.x() * way.y();
    yy += weights[i] * way.y() * way.y();
  }
  const double along = 0.5 * std::atan2(2 * xy, xx - yy);
  const Vector2 normal(-std::sin(along), std::cos(along));
  return {normal, normal.dot(middle)};
}

/// Robust least squares with weights that fall to nothing (Tukey's).
SideLine robust_line(const std::vector<Vector2>& points) {
  std::vector<double> weights(points.size(), 1.0);
  SideLine line = line_through(points, weights);
  for (int round = 0; round < 12; ++round) {
    std::vector<double> misses;
    for (const Vector2& point : points) misses.push_back(std::abs(line.normal.dot(point) - line.offset));
    std::vector<double> sorted = misses;
    std::ranges::nth_element(sorted, sorted.begin() + std::ptrdiff_t(sorted.size() / 2));
    const double scale = 4.0 * std::max(0.05, 1.48 * sorted[sorted.size() / 2]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double share = misses[i] / scale;
      weights[i] = share < 1 ? (1 - share * share) * (1 - share * share) : 1e-9;
    }
    line = line_through(points, weights);
  }
  return line;
}

/// Places where the colour ends along a side, to parts of a pixel.
std::vector<Vector2> side_points(const FrameView& frame, const ColourMeasure& colour, const Vector2& from,
                                 const Vector2& to, const Lens* lens) {
  constexpr double kSearch = 12.0, kPace = 0.5;  // pixels
  std::vector<Vector2> points;
  const Vector2 along = (to - from).normalized();
  const Vector2 outwards(along.y(), -along.x());  // clockwise corners, y down
  for (int i = 0; i < kSideSamples; ++i) {
    const double share = 0.03 + 0.94 * i / (kSideSamples - 1);
    const Vector2 middle = from + share * (to - from);
    double before = strength_at(frame, colour, middle - kSearch * outwards);
    if (before < colour.least) continue;  // not the table that lies within
    for (double out = -kSearch + kPace; out <= kSearch; out += kPace) {
      const Vector2 place = middle + out * outwards;
      if (place.x() < 1 || place.y() < 1 || place.x() > frame.width - 2 || place.y() > frame.height - 2)
        break;
      const double here = strength_at(frame, colour, place);
      if (here < colour.least && before > colour.least) {
        // The colour beyond sets the level: the middle between both sides, so that blur shifts nothing.
        const double inside = strength_at(frame, colour, place - 4 * outwards),
                     outside = strength_at(frame, colour, place + 4 * outwards);
        const double level = 0.5 * (inside + outside);
        double last = strength_at(frame, colour, place - 3 * outwards);
        for (double fine = -3 + 0.25; fine <= 3; fine += 0.25) {
          const double now = strength_at(frame, colour, place + fine * outwards);
          if (now < level && last >= level) {
            const Vector2 edge =
                place + (fine - 0.25 * (level - now) / std::max(1e-9, last - now)) * outwards;
            points.push_back(lens != nullptr ? without_bending(*lens, edge) : edge);
            break;
          }
          last = now;
        }
        break;
      }
      before = here;
    }
  }
  return points;
}

Vector2 crossing_of(const SideLine& one, const SideLine& other) {
  const double determinant = one.normal.x() * other.normal.y() - one.normal.y() * other.normal.x();
  return {(one.offset * other.normal.y() - one.normal.y() * other.offset) / determinant,
          (one.normal.x() * other.offset - one.offset * other.normal.x()) / determinant};
}

}  // namespace

Vector2 with_bending(const Lens& lens, const Vector2& pixel) {
  const double x = (pixel.x() - lens.cx) / lens.fx, y = (pixel.y() - lens.cy) / lens.fy;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {lens.fx * (x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x)) + lens.cx,
          lens.fy * (y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y) + lens.cy};
}

Vector2 without_bending(const Lens& lens, const Vector2& pixel) {
  Vector2 flat = pixel;
  for (int round = 0; round < 50; ++round) {
    const Vector2 miss = pixel - with_bending(lens, flat);
    flat += miss;
    if (miss.squaredNorm() < 1e-20) break;
  }
  return flat;
}

base::Result<std::array<Vector2, 4>> find_table_corners(const FrameView& frame, const Lens* lens) {
  if (frame.width < 32 || frame.height < 32)
    return base::fail(
        fmt::format("frames of {} x {} pixels are too small for a table", frame.width, frame.height));
  const ColouredPiece piece = largest_piece(frame, kTableRed);
  const double share = double(piece.pixels) / (double(frame.width) * frame.height);
  if (share < kLeastTable)
    return base::fail(
        fmt::format("no red table is seen: the largest red part covers {:.0f} % of the frame", 100 * share));
  std::vector<Vector2> four = reduced_to(4, convex_border(piece.border));
  if (four.size() < 4) return base::fail("the red part is no quadrangle");
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i)
    area += 0.5 * (four[i].x() * four[(i + 1) % 4].y() - four[i].y() * four[(i + 1) % 4].x());
  if (area < 0) std::ranges::reverse(four);  // clockwise, y down
  constexpr double kBorder = 3.0;
  for (const Vector2& corner : four)
    if (corner.x() < kBorder || corner.y() < kBorder || corner.x() > frame.width - 1 - kBorder ||
        corner.y() > frame.height - 1 - kBorder)
      return base::fail(
          "a corner of the red table lies outside of the frame; move the camera away, or give --table");
  const auto first = std::ranges::min_element(four, {}, [](const Vector2& it) { return it.x() + it.y(); });
  std::ranges::rotate(four, first);
  std::array<SideLine, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<Vector2> points = side_points(frame, kTableRed, four[i], four[(i + 1) % 4], lens);
    if (points.size() < kSideSamples / 5)
      return base::fail("a side of the red table is hidden; take everything off its border");
    sides[i] = robust_line(points);
  }
  std::array<Vector2, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = crossing_of(sides[(i + 3) % 4], sides[i]);
  for (std::size_t i = 0; i < 4; ++i)
    if (!corners[i].allFinite() || (corners[i] - four[i]).norm() > 0.1 * frame.width)
      return base::fail("the border of the red table is no quadrangle");
  return corners;
}

base::Result<std::array<Vector2, 3>> find_triangle_corners(const FrameView& frame) {
  constexpr std::size_t kFewest = 200;  // pixels
  if (frame.width < 32 || frame.height < 32)
    return base::fail(fmt::format("frames of {} x {} pixels are too small", frame.width, frame.height));
  const ColouredPiece piece = largest_piece(frame, kPlasticBlue);
  if (piece.pixels < kFewest) return base::fail("no blue triangle is seen");
  std::vector<Vector2> three = reduced_to(3, convex_border(piece.border));
  if (three.size() < 3) return base::fail("what is blue is no triangle");
  double area = 0.5 * turned(three[0], three[1], three[2]);
  if (area < 0) std::ranges::reverse(three);
  area = std::abs(area);
  constexpr double kLeastFilled = 0.8, kMostFilled = 1.4;
  const double filled = double(piece.pixels) / std::max(1.0, area);
  if (filled < kLeastFilled || filled > kMostFilled)
    return base::fail(
        "what is blue is no whole triangle; lay one on the empty table, and take the hands away");
  std::array<SideLine, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<Vector2> points =
        side_points(frame, kPlasticBlue, three[i], three[(i + 1) % 3], nullptr);
    if (points.size() < kSideSamples / 3)
      return base::fail("a side of the triangle is hidden or leaves the frame");
    sides[i] = robust_line(points);
  }
  std::array<Vector2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = crossing_of(sides[(i + 2) % 3], sides[i]);
    if (!corners[i].allFinite() || (corners[i] - three[i]).norm() > 25.0)
      return base::fail("a corner of the triangle is hidden or leaves the frame");
  }
  return corners;
}

}  // namespace icome::cutout
