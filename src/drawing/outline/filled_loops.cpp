#include "drawing/outline/filled_loops.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "drawing/outline/straight_pieces.h"
#include "fonts/outline_union.h"

namespace icome::drawing {
namespace {

constexpr double kLoopGridSteps = 1 << 25;           // across all lines: areas of rings add up exactly
constexpr std::size_t kMostLoopsApart = 20'000;      // more are one curve
constexpr double kMostRingCorners = 200'000;         // with more the rule is taken as non-zero
constexpr std::size_t kMostEdgeLooks = 100'000'000;  // likewise
constexpr double kSameArea = 1e-7;                   // relative difference that rounding to the grid explains

std::vector<CubicBezier> closed_loop(const Curve& line) {
  std::vector<CubicBezier> loop = line.segments;
  const Vector2 start = loop.front().points[0], end = loop.back().points[3];
  if (start != end) loop.push_back(CubicBezier::line(end, start));
  return loop;
}

std::vector<CubicBezier> run_backwards(const std::vector<CubicBezier>& loop) {
  std::vector<CubicBezier> back;
  back.reserve(loop.size());
  for (auto segment = loop.rbegin(); segment != loop.rend(); ++segment) back.push_back(segment->reversed());
  return back;
}

/// Groups of lines whose boxes meet, also through others; each in ascending order.
class BoxGroups {
 public:
  BoxGroups(std::span<const Curve> lines, double beside) : group_(lines.size()) {
    std::iota(group_.begin(), group_.end(), std::size_t(0));
    std::vector<Bounds2> boxes;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Bounds2 box = lines[i].bounds();
      boxes.emplace_back(box.min().array() - beside, box.max().array() + beside);
      if (!lines[i].segments.empty()) order.push_back(i);
    }
    std::ranges::sort(order, {}, [&](std::size_t i) { return boxes[i].min().x(); });
    if (order.size() <= kMostLoopsApart) sweep(order, boxes);
    if (order.size() > kMostLoopsApart)
      for (const std::size_t i : order) group_[i] = order.front();
  }

  std::vector<std::vector<std::size_t>> take(std::span<const Curve> lines) {
    std::vector<std::vector<std::size_t>> members(group_.size());
    for (std::size_t i = 0; i < group_.size(); ++i)
      if (!lines[i].segments.empty()) members[root_of(i)].push_back(i);
    std::erase_if(members, [](const auto& some) { return some.empty(); });
    std::ranges::sort(members, {}, [](const auto& some) { return some.front(); });
    return members;
  }

 private:
  /// From left to right; what is still open is kept once for each group, with the box of all of it, so that a
  /// line inside of a large group costs one look.
  void sweep(const std::vector<std::size_t>& order, const std::vector<Bounds2>& boxes) {
    struct Open {
      std::size_t line;
      Bounds2 box;
    };
    std::vector<Open> open;
    for (const std::size_t i : order) {
      Open mine{i, boxes[i]};
      std::erase_if(open, [&](const Open& other) {
        if (other.box.max().x() < mine.box.min().x()) return true;
        if (!other.box.intersects(mine.box)) return false;
        group_[root_of(other.line)] = root_of(i);
        mine.box.extend(other.box);
        return true;
      });
      open.push_back(mine);
    }
  }

  std::size_t root_of(std::size_t i) {
    while (group_[i] != i) i = group_[i] = group_[group_[i]];
    return i;
  }

  std::vector<std::size_t> group_;
};

/// Areas of loops on a grid of whole numbers.
class LoopAreas {
 public:
  LoopAreas(const std::vector<std::vector<CubicBezier>>& loops, double tolerance) {
    Bounds2 box;
    for (const auto& loop : loops)
      for (const CubicBezier& segment : loop) box.extend(segment.hull_bounds());
    middle_ = box.center();
    step_ = std::max(box.sizes().maxCoeff(), 1e-300) / kLoopGridSteps;
    double corners = 0.0;
    for (const auto& loop : loops)
      for (const CubicBezier& segment : loop) corners += straight_pieces(segment, tolerance);
    fits_ = corners <= kMostRingCorners;
    if (!fits_) return;
    for (const auto& loop : loops) {
      rings_.push_back(ring_of(loop, tolerance));
      boxes_.push_back(box_of(rings_.back()));
    }
    fits_ = !fonts::cross_often(rings_, fonts::kMostCrossings);
  }

  /// False where the rings have too many corners, or cross too often.
  bool fits() const { return fits_; }
  double signed_area(std::size_t i) const { return ring_area(rings_[i]); }

  /// The number of other rings around a ring's first corner, by the even-odd rule each; nothing where that
  /// would take too long.
  std::optional<std::size_t> depth_of(std::size_t i) {
    const Vector2 at = rings_[i].front();
    std::size_t depth = 0;
    for (std::size_t k = 0; k < rings_.size(); ++k) {
      if (k == i || !boxes_[k].contains(at)) continue;
      looks_ += rings_[k].size();
      if (looks_ > kMostEdgeLooks) return std::nullopt;
      depth += is_within(rings_[k], at) ? 1U : 0U;
    }
    return depth;
  }

  void turn(std::size_t i) { std::ranges::reverse(rings_[i]); }
  double area_by_non_zero() const { return area_of(fonts::united(rings_)); }
  std::vector<geometry::Outline> odd_area() const { return fonts::covered_oddly(rings_); }

  static double area_of(const std::vector<geometry::Outline>& pieces) {
    double area = 0.0;
    for (const geometry::Outline& piece : pieces) {
      area += ring_area(piece.rim);
      for (const auto& hole : piece.holes) area += ring_area(hole);
    }
    return area;
  }

  std::vector<CubicBezier> loop_of(const std::vector<Vector2>& ring) const {
    std::vector<CubicBezier> loop;
    for (std::size_t i = 0; i < ring.size(); ++i)
      loop.push_back(CubicBezier::line(on_paper(ring[i]), on_paper(ring[(i + 1) % ring.size()])));
    return loop;
  }

 private:
  Vector2 on_paper(const Vector2& corner) const { return middle_ + step_ * corner; }

  std::vector<Vector2> ring_of(const std::vector<CubicBezier>& loop, double tolerance) const {
    std::vector<Vector2> ring;
    for (const CubicBezier& cubic : loop) {
      const int pieces = int(straight_pieces(cubic, tolerance));
      for (int i = 0; i < pieces; ++i)
        ring.push_back(((cubic.at(double(i) / pieces) - middle_) / step_).array().round());
    }
    return ring;
  }

  static Bounds2 box_of(const std::vector<Vector2>& ring) {
    Bounds2 box;
    for (const Vector2& corner : ring) box.extend(corner);
    return box;
  }

  static double ring_area(const std::vector<Vector2>& ring) {
    double twice = 0.0;
    Vector2 last = ring.back();
    for (const Vector2& corner : ring) {
      twice += last.x() * corner.y() - last.y() * corner.x();
      last = corner;
    }
    return 0.5 * twice;
  }

  static bool is_within(const std::vector<Vector2>& ring, const Vector2& at) {
    bool within = false;
    Vector2 a = ring.back();
    for (const Vector2& b : ring) {
      if ((a.y() > at.y()) != (b.y() > at.y()) &&
          at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        within = !within;
      a = b;
    }
    return within;
  }

  Vector2 middle_;
  double step_ = 1.0;
  std::vector<std::vector<Vector2>> rings_;
  std::vector<Bounds2> boxes_;
  std::size_t looks_ = 0;
  bool fits_ = false;
};

/// One loop that encloses what all do: from the first one's start to each other one's and back.
Curve joined_loops(const std::vector<std::vector<CubicBezier>>& loops) {
  Curve curve;
  curve.closed = true;
  if (loops.empty()) return curve;
  const Vector2 hub = loops.front().front().points[0];
  for (const auto& loop : loops) {
    const Vector2 start = loop.front().points[0];
    if (start != hub) curve.segments.push_back(CubicBezier::line(hub, start));
    curve.segments.insert(curve.segments.end(), loop.begin(), loop.end());
    if (start != hub) curve.segments.push_back(CubicBezier::line(hub, start).reversed());
  }
  return curve;
}

/// Turns loops so that the non-zero rule fills what the even-odd rule does; false where lines cross so that
/// it cannot, or are too many to find out.
bool turn_for_even_odd(std::vector<std::vector<CubicBezier>>& loops, LoopAreas& areas, double odd_area) {
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto depth = areas.depth_of(i);
    if (!depth) return false;
    const bool is_hole = *depth % 2 == 1;
    if ((areas.signed_area(i) < 0.0) == is_hole) continue;
    loops[i] = run_backwards(loops[i]);
    areas.turn(i);
  }
  // An area that is wound around an odd number of times is part of what is wound around at all: as large, it
  // is that.
  const double all = areas.area_by_non_zero();
  return all - odd_area <= kSameArea * all;
}

FilledLoops filled_by_even_odd(std::vector<std::vector<CubicBezier>> loops, double tolerance) {
  FilledLoops filled;
  LoopAreas areas(loops, tolerance);
  if (!areas.fits()) {
    filled.likeness = FillLikeness::NonZeroInstead;
    filled.curve = joined_loops(loops);
    return filled;
  }
  const std::vector<geometry::Outline> odd = areas.odd_area();
  if (!turn_for_even_odd(loops, areas, LoopAreas::area_of(odd))) {
    filled.likeness = FillLikeness::StraightPieces;
    loops.clear();
    for (const geometry::Outline& piece : odd) {
      loops.push_back(areas.loop_of(piece.rim));
      for (const auto& hole : piece.holes) loops.push_back(areas.loop_of(hole));
    }
  }
  filled.curve = joined_loops(loops);
  return filled;
}

}  // namespace

std::vector<FilledLoops> filled_loops(std::span<const Curve> lines, FillRule rule, double beside,
                                      double tolerance) {
  std::vector<FilledLoops> all;
  for (std::vector<std::size_t>& members : BoxGroups(lines, beside).take(lines)) {
    std::vector<std::vector<CubicBezier>> loops;
    for (const std::size_t i : members) loops.push_back(closed_loop(lines[i]));
    FilledLoops filled;
    if (rule == FillRule::EvenOdd)
      filled = filled_by_even_odd(std::move(loops), tolerance);
    else
      filled.curve = joined_loops(loops);
    filled.members = std::move(members);
    all.push_back(std::move(filled));
  }
  return all;
}

}  // namespace icome::drawing
