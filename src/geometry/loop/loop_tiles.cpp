#include "geometry/loop/loop_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/loop/loop_walk.h"

namespace icome::geometry {
namespace {

constexpr double kNarrow = 0.26;       // sine of the angle between a tile's normals and its axis: 15 degrees
constexpr double kTameBend = 0.9;      // of the ball's own curvature
constexpr double kFoldedBend = 1.001;  // likewise: from here on the ball surely cannot touch
constexpr double kNegligibleGap =
    1e-5;                            // of the radius: allowed between any two nearest places of a small tile
constexpr double kLeastWide = 1e-5;  // of the surface: tiles are not cut further
constexpr int kMostTileDepth = 12;   // bisections
constexpr int kMostBlindDepth = 8;   // where the surface is degenerate, so that nothing bounds its bends
constexpr int kApexRings = 4;        // by which the surface around an extraordinary vertex is judged
constexpr int kMostApexLevels = 12;  // rings cut off one by one
constexpr double kApexRoom = 1.5;    // curvatures around it grow, but slowly
constexpr double kTileRounding = 1e-14;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The columns are two directions across a unit vector.
Eigen::Matrix<double, 3, 2> across_axis(const Vector3& axis) {
  Eigen::Matrix<double, 3, 2> frame;
  frame.col(0) = axis.unitOrthogonal();
  frame.col(1) = axis.cross(frame.col(0));
  return frame;
}

using Matrix2 = Eigen::Matrix2d;

/// Bounds on the bends of a quartic triangle over the plane across an axis.
struct Bending {
  double slope = kInfinite;                             // the most, against the plane
  std::array<double, 2> most = {kInfinite, kInfinite};  // 1/m, curving in: front, back
  std::array<double, 2> least = {0.0, 0.0};             // 1/m, everywhere in some direction, at least
};

/// The triangle's derivatives in Bernstein form: ten first ones, six second ones.
struct Derivatives {
  std::array<Vector3, 10> s, t;
  std::array<Vector3, 6> ss, st, tt;

  explicit Derivatives(const QuarticTriangle& shape) {
    const auto point = [&](int j, int k) { return vector3(shape.points[QuarticTriangle::index(j, k)]); };
    for (int k = 0, n = 0; k < 4; ++k) {
      for (int j = 0; j < 4 - k; ++j, ++n) {
        s[n] = 4.0 * (point(j + 1, k) - point(j, k));
        t[n] = 4.0 * (point(j, k + 1) - point(j, k));
      }
    }
    for (int k = 0, n = 0; k < 3; ++k) {
      for (int j = 0; j < 3 - k; ++j, ++n) {
        ss[n] = 12.0 * (point(j + 2, k) - 2.0 * point(j + 1, k) + point(j, k));
        st[n] = 12.0 * (point(j + 1, k + 1) - point(j + 1, k) - point(j, k + 1) + point(j, k));
        tt[n] = 12.0 * (point(j, k + 2) - 2.0 * point(j, k + 1) + point(j, k));
      }
    }
  }

  Vector3 mean_normal() const {
    Vector3 of_s = Vector3::Zero(), of_t = Vector3::Zero();
    for (int i = 0; i < 10; ++i) {
      of_s += s[i];
      of_t += t[i];
    }
    return of_s.cross(of_t).stableNormalized();
  }
};

/// The larger and the smaller eigenvalue.
std::array<double, 2> eigenvalues(const Matrix2& m) {
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double apart = std::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
  return {mean + apart, mean - apart};
}

/// The unit eigenvector of the larger eigenvalue.
Vector2 first_direction(const Matrix2& m) {
  const double angle = 0.5 * std::atan2(2.0 * m(0, 1), m(0, 0) - m(1, 1));
  return {std::cos(angle), std::sin(angle)};
}

// The surface is a graph over the plane, where the derivative of the map onto the plane stays near its mean.
// By the convex-hull property Bernstein coefficients bound all derivatives.
Bending bending_of(const Derivatives& d, const Vector3& axis) {
  const Eigen::Matrix<double, 3, 2> frame = across_axis(axis);
  const auto on_plane = [&](const Vector3& v) -> Vector2 { return frame.transpose() * v; };
  Matrix2 mean = Matrix2::Zero();
  for (int i = 0; i < 10; ++i) {
    mean.col(0) += 0.1 * on_plane(d.s[i]);
    mean.col(1) += 0.1 * on_plane(d.t[i]);
  }
  Bending result;
  if (!(std::abs(mean.determinant()) > 1e-12 * mean.squaredNorm())) return result;
  const Matrix2 inverse = mean.inverse();  // onto parameters that are measured on the plane
  double stretch = 0.0, rise = 0.0;
  for (int i = 0; i < 10; ++i) {
    Matrix2 change;
    change << on_plane(d.s[i]), on_plane(d.t[i]);
    stretch = std::max(stretch, (change * inverse - Matrix2::Identity()).norm());
    const Vector2 up(axis.dot(d.s[i]), axis.dot(d.t[i]));
    rise = std::max(rise, (inverse.transpose() * up).norm());
  }
  if (!(stretch < 0.9)) return result;
  result.slope = rise / (1.0 - stretch);
  std::array<Matrix2, 6> heights;
  Matrix2 middle = Matrix2::Zero();
  double sideways = 0.0;
  for (int i = 0; i < 6; ++i) {
    const auto second = [&](const Vector3& direction) -> Matrix2 {
      Matrix2 m;
      m << direction.dot(d.ss[i]), direction.dot(d.st[i]), direction.dot(d.st[i]), direction.dot(d.tt[i]);
      return inverse.transpose() * m * inverse;
    };
    heights[i] = second(axis);
    middle += heights[i] / 6.0;
    sideways = std::max(sideways, std::hypot(second(frame.col(0)).norm(), second(frame.col(1)).norm()));
  }
  const double doubt = result.slope * sideways;
  const double least_length = (1.0 - stretch) * (1.0 - stretch);
  const double most_length =
      (1.0 + stretch) * (1.0 + stretch) * std::pow(1.0 + result.slope * result.slope, 1.5);
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const Vector2 direction = first_direction(sign * middle);
    double most = 0.0, least = kInfinite;
    for (const Matrix2& height : heights) {
      most = std::max(most, eigenvalues(sign * height)[0]);
      least = std::min(least, direction.dot(sign * height * direction));
    }
    result.most[side] = (most + doubt) / least_length;
    result.least[side] = std::max(0.0, least - doubt) / most_length;
  }
  return result;
}

/// The most by which a side of the triangle bends as a curve, 1/m: it matters to a ball beside a rim.
double bending_of_side(const QuarticTriangle& shape, int side) {
  constexpr int kDegree = QuarticTriangle::kDegree;
  std::array<Vector3, kDegree + 1> points;
  for (int i = 0; i <= kDegree; ++i) {
    const int at = side == 0   ? QuarticTriangle::index(i, 0)
                   : side == 1 ? QuarticTriangle::index(kDegree - i, i)
                               : QuarticTriangle::index(0, kDegree - i);
    points[i] = vector3(shape.points[at]);
  }
  const Vector3 along = (points[kDegree] - points[0]).stableNormalized();
  double least = kInfinite, most = 0.0, tilt = 0.0;
  for (int i = 0; i < kDegree; ++i) {
    const Vector3 first = 4.0 * (points[i + 1] - points[i]);
    least = std::min(least, along.dot(first));
    tilt = std::max(tilt, (first - along.dot(first) * along).norm());
  }
  if (!(least > 0.0)) return kInfinite;
  for (int i = 0; i + 1 < kDegree; ++i) {
    const Vector3 second = 12.0 * (points[i + 2] - 2.0 * points[i + 1] + points[i]);
    const double onwards = along.dot(second);
    most = std::max(most, (second - onwards * along).norm() + std::abs(onwards) * tilt / least);
  }
  return most / (least * least);
}

/// Enlarges the tile's cylinder so that it encloses the point.
void enclose(LoopTile& tile, const Vector3& point) {
  const Vector3 away = point - tile.centre;
  const double along = tile.axis.dot(away);
  tile.wide = std::max(tile.wide, (away - along * tile.axis).norm());
  tile.low = std::min(tile.low, along);
  tile.high = std::max(tile.high, along);
}

/// Enlarges the tile's spread and bends to those of a part of it, times `room`.
void take_bending(LoopTile& tile, const Bending& bending, double room) {
  const double spread = std::isfinite(bending.slope) ? bending.slope / std::hypot(1.0, bending.slope) : 1.0;
  tile.spread = std::max(tile.spread, std::min(1.0, room * spread));
  for (const int side : {0, 1}) tile.bend[side] = std::max(tile.bend[side], room * bending.most[side]);
}

}  // namespace

/// Makes the tiles of one piece after the other.
class LoopTiles::Builder {
 public:
  Builder(const LoopPatches& patches, double radius, LoopTiles& result)
      : patches_(patches), curvature_(1.0 / radius), result_(result) {}

  /// False when there are too many.
  bool build() {
    result_.first_root_.reserve(patches_.count() + 1);
    for (std::uint32_t piece = 0; piece < patches_.count(); ++piece) {
      result_.first_root_.push_back(std::uint32_t(result_.roots_.size()));
      cut(piece);
      if (result_.tiles_.size() > kMost) return false;
    }
    result_.first_root_.push_back(std::uint32_t(result_.roots_.size()));
    result_.tiles_.shrink_to_fit();
    result_.halves_.shrink_to_fit();
    result_.roots_.shrink_to_fit();
    result_.tree_ = BoxTree(boxes_);
    return true;
  }

 private:
  void cut(std::uint32_t piece) {
    LoopCell cell;
    if (patches_.regular(piece)) {
      patches_.load(piece, cell);
      begin_root();
      cut(piece, cell, cell.shape, {Vector2(0.0, 0.0), Vector2(1.0, 0.0), Vector2(0.0, 1.0)}, 0);
      return;
    }
    LoopFanPoints fan;
    patches_.load(piece, fan);
    const int last = std::min(kMostApexLevels, std::max(0, fan.levels - kApexRings));
    for (int level = 0; level < last; ++level) {
      const LoopTile whole = apex_tile(piece, fan, level);
      if (tame(whole)) {
        begin_root();
        add(whole);
        return;
      }
      for (int part = 0; part < 3; ++part) {
        LoopPatches::load(fan, level, part, cell);
        const auto corner = [&](double s, double t) {
          return Vector2((s - cell.s0) / cell.scale, (t - cell.t0) / cell.scale);
        };
        begin_root();
        cut(piece, cell, cell.shape, {corner(0, 0), corner(1, 0), corner(0, 1)}, 0);
      }
    }
    LoopTile rest = apex_tile(piece, fan, last);
    rest.tame = true;  // so small that its curvature does not matter
    begin_root();
    add(rest);
  }

  void begin_root() { result_.roots_.push_back(std::uint32_t(result_.halves_.size())); }

  void cut(std::uint32_t piece, const LoopCell& cell, const QuarticTriangle& shape,
           const std::array<Vector2, 3>& corners, int depth) {
    const LoopTile tile = plain_tile(piece, cell, shape, corners);
    const int most = std::isfinite(tile.bend[0]) ? kMostTileDepth : kMostBlindDepth;
    if (tame(tile) || depth >= most || small(tile) || result_.tiles_.size() > kMost) {
      add(tile);
      return;
    }
    const std::size_t here = result_.halves_.size();
    result_.halves_.emplace_back();
    QuarticTriangle one, other;
    bisect(shape, one, other);
    const Vector2 middle = 0.5 * (corners[1] + corners[2]);
    cut(piece, cell, one, {middle, corners[0], corners[1]}, depth + 1);
    result_.halves_[here].second = std::uint32_t(result_.halves_.size());
    cut(piece, cell, other, {middle, corners[2], corners[0]}, depth + 1);
  }

  LoopTile plain_tile(std::uint32_t piece, const LoopCell& cell, const QuarticTriangle& shape,
                      const std::array<Vector2, 3>& corners) {
    LoopTile tile;
    tile.piece = piece;
    tile.corners = corners;
    tile.sharp = sharp(tile);
    const auto& p = shape.points;
    tile.centre = cell.origin + vector3(p[0] + p[4] + p[14]) / 3.0;
    const Derivatives derivatives(shape);
    tile.axis = derivatives.mean_normal();
    Bending bending;
    if (tile.axis.squaredNorm() > 0.5) {
      // A cell that is turned round has both derivatives reversed, bisected ones keep their orientation.
      bending = bending_of(derivatives, tile.axis);
    } else {
      tile.axis = Vector3::UnitZ();
    }
    take_bending(tile, bending, 1.0);
    for (int i = 0; i < 3; ++i)
      if (sharp_side(tile, i)) take_rim(tile, bending_of_side(shape, i));
    for (const int side : {0, 1})
      tile.folded[side] = !tile.sharp && bending.least[side] > kFoldedBend * curvature_;
    hull_.setEmpty();
    for (const Vector4& point : p) {
      const Vector3 place = cell.origin + vector3(point);
      hull_.extend(place);
      enclose(tile, place);
    }
    return tile;
  }

  /// The tile of everything around an extraordinary vertex after `level` subdivisions.
  LoopTile apex_tile(std::uint32_t piece, const LoopFanPoints& fan, int level) {
    const double size = std::ldexp(1.0, -level);
    LoopTile tile;
    tile.piece = piece;
    tile.corners = {Vector2(0.0, 0.0), Vector2(size, 0.0), Vector2(0.0, size)};
    const FanRule rule = patches_.rule(piece);
    tile.sharp = sharp(tile) || rule == FanRule::Spike || rule == FanRule::Corner || rule == FanRule::Dart;
    hull_.setEmpty();
    const int rings = std::min(fan.levels, level + kApexRings);
    std::vector<Vector3> points;
    std::vector<Derivatives> parts;
    for (int ring = level; ring < rings; ++ring) {
      for (int part = 0; part < 3; ++part) {
        LoopCell cell;
        LoopPatches::load(fan, ring, part, cell);
        parts.emplace_back(cell.shape);
        if (part == 0 && ends_at(patches_, piece, 0)) take_rim(tile, bending_of_side(cell.shape, 0));
        if (part == 2 && ends_at(patches_, piece, 2)) take_rim(tile, bending_of_side(cell.shape, 2));
        for (const Vector4& point : cell.shape.points) points.push_back(cell.origin + vector3(point));
      }
    }
    tile.axis = Vector3::Zero();
    for (const Derivatives& part : parts) tile.axis += part.mean_normal();
    tile.axis = tile.axis.stableNormalized();
    if (!(tile.axis.squaredNorm() > 0.5)) tile.axis = Vector3::UnitZ();
    tile.centre = fan.apex;
    for (const Derivatives& part : parts) take_bending(tile, bending_of(part, tile.axis), kApexRoom);
    const double rest = fan.reach(rings);
    for (const Vector3& point : points) {
      hull_.extend(point);
      enclose(tile, point);
    }
    for (int axis = 0; axis < 3; ++axis) {
      hull_.extend(Vector3(fan.apex + rest * Vector3::Unit(axis)));
      hull_.extend(Vector3(fan.apex - rest * Vector3::Unit(axis)));
    }
    tile.wide = std::max(tile.wide, rest);
    const double lift = rest * std::min(1.0, tile.spread);
    tile.low = std::min(tile.low, -lift);
    tile.high = std::max(tile.high, lift);
    return tile;
  }

  bool tame(const LoopTile& tile) const {
    if (tile.spread > kNarrow) return false;
    for (const int side : {0, 1}) {
      if (!tile.folded[side] && tile.bend[side] > kTameBend * curvature_) return false;
    }
    return true;
  }

  /// Do two nearest places on it, if there are any, differ too little to matter?
  bool small(const LoopTile& tile) const {
    if (tile.wide < kLeastWide * patches_.size()) return true;
    const double turn = tile.wide * std::max(tile.bend[0], tile.bend[1]);
    return tile.spread <= kNarrow && tile.wide * turn * turn * curvature_ < kNegligibleGap;
  }

  /// Does the side from corner `which` on lie on a rim or a crease?
  bool sharp_side(const LoopTile& tile, int which) const {
    const Vector2 &one = tile.corners[which], &other = tile.corners[(which + 1) % 3];
    return (one.y() == 0.0 && other.y() == 0.0 && ends_at(patches_, tile.piece, 0)) ||
           (one.x() == 0.0 && other.x() == 0.0 && ends_at(patches_, tile.piece, 2));
  }

  bool sharp(const LoopTile& tile) const {
    return sharp_side(tile, 0) || sharp_side(tile, 1) || sharp_side(tile, 2);
  }

  static void take_rim(LoopTile& tile, double bend) {
    for (double& most : tile.bend) most = std::max(most, bend);
  }

  void add(LoopTile tile) {
    tile.tame = tile.tame || tame(tile);
    const double rounding = kTileRounding * (patches_.size() + tile.centre.norm());
    tile.wide += rounding;
    tile.low -= rounding;
    tile.high += rounding;
    const Vector3 margin = Vector3::Constant(rounding);
    boxes_.push_back(float_box(Bounds(hull_.min() - margin, hull_.max() + margin)));
    result_.halves_.push_back({result_.count(), 0});
    result_.tiles_.push_back(tile);
  }

  const LoopPatches& patches_;
  const double curvature_;  // 1/m, of the ball
  LoopTiles& result_;
  Bounds hull_;  // of the tile looked at last
  std::vector<FloatBox> boxes_;
};

base::Result<LoopTiles> LoopTiles::create(const LoopPatches& patches, double radius) {
  LoopTiles tiles;
  if (!Builder(patches, radius, tiles).build())
    return base::fail(fmt::format("it bends so much that it takes more than {} parts", kMost));
  return tiles;
}

std::uint32_t LoopTiles::find(std::uint32_t piece, double u, double v) const {
  std::uint32_t root = first_root_[piece];
  const std::uint32_t rest = first_root_[piece + 1] - 1;
  double a = u, b = v;
  if (root < rest) {  // an extraordinary vertex with rings
    int exponent = 0;
    std::frexp(u + v, &exponent);
    const auto level = std::uint32_t(std::max(0, -exponent));
    if (!(u + v > 0.0) || root + 3 * level >= rest) {
      root = rest;
    } else {
      const double scale = std::ldexp(1.0, int(level) + 1);
      const int part = scale * u >= 1.0 ? 0 : scale * v >= 1.0 ? 2 : 1;
      root += 3 * level + std::uint32_t(part);
      LoopCell cell;
      LoopPatches::place_part(int(level), part, cell);
      a = cell.scale * u + cell.s0;
      b = cell.scale * v + cell.t0;
    }
  }
  std::uint32_t half = roots_[root];
  for (double c = 1.0 - a - b; halves_[half].second != 0;) {
    // The halves' corners are the middle of the second side, the first and second, or the third and first.
    if (a >= b) {
      const double of_middle = 2.0 * b;
      b = a - b;
      a = c;
      c = of_middle;
      ++half;
    } else {
      const double of_middle = 2.0 * a;
      a = b - a;
      b = c;
      c = of_middle;
      half = halves_[half].second;
    }
  }
  return halves_[half].tile;
}

std::size_t LoopTiles::bytes() const {
  return sizeof(*this) + tiles_.capacity() * sizeof(LoopTile) + halves_.capacity() * sizeof(Half) +
         (roots_.capacity() + first_root_.capacity()) * sizeof(std::uint32_t) + tree_.bytes();
}

}  // namespace icome::geometry
