#include "drawing/outline/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/outline/rim.h"

// The method. A point is painted when some disc holds it: where distance to the centre minus radius, as a
// function of the place along the curve, has a least value below zero. Such a least value lies
// - within a smooth part, where the point is on a spoke (from the centre to where the disc touches the rim),
//   and not beyond where the next spokes cross it, since the value is greatest there, not least; or
// - at an end or corner, where the point is in a sector of the disc there.
// So the spokes, cut where they cross, and the sectors make up the whole region. Each of them is wound around
// once in the same direction, and their common sides cancel out, which leaves one loop. No search for
// intersections is needed, which could go wrong.

namespace icome::drawing {
namespace {

constexpr double kSpeckShare = 0.02;  // of the tolerance: what is smaller is a point
constexpr double kSameSpecks = 4.0;   // ends of parts that are not farther apart are the same

double turn_of_tangents(const Vector2& a, const Vector2& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// The angle from the tangent to the touching points.
double lean_of(const SweepingDisc& disc) { return std::acos(-disc.radius_slope); }

Vector2 touching_point(const SweepingDisc& disc, double side) {
  return disc.centre + disc.radius * disc.touching(side);
}

/// The closing of a run of sweeping discs at one of its ends.
enum class RunEnd { Round, Flat, Open };

/// Makes the loops of one curve from its parts.
class OutlineMaker {
 public:
  OutlineMaker(const Curve& curve, CurveEnds ends, double tolerance)
      : closed_(curve.closed && curve.width_at(0.0) > 0.0 && curve.width_at(curve.end()) > 0.0),
        flat_(ends == CurveEnds::Flat && !curve.closed),
        tolerance_(tolerance),
        speck_(kSpeckShare * tolerance),
        parts_(swept_parts(curve, speck_)) {
    // A closed curve that is a point does not come back from elsewhere.
    if (parts_.size() == 1 && parts_.front().motion != DiscMotion::Sweeps) closed_ = false;
  }

  std::vector<OutlinePiece> made() && {
    if (parts_.empty()) return {};
    if (closed_) begin_after_break();
    if (ring_) {
      add_ring();
    } else {
      for (std::size_t i = 0; i < parts_.size(); ++i) add_discs(i);
      for (std::size_t i = 0; i < parts_.size(); i = add_run(i)) continue;
    }
    return std::move(pieces_);
  }

 private:
  const SweptPart* before(std::size_t i) const {
    return i > 0 ? &parts_[i - 1] : closed_ ? &parts_.back() : nullptr;
  }
  const SweptPart* after(std::size_t i) const {
    return i + 1 < parts_.size() ? &parts_[i + 1] : closed_ ? &parts_.front() : nullptr;
  }
  static double start_radius(const SweptPart& part) { return part.radius_at(part.from); }
  static double end_radius(const SweptPart& part) { return part.radius_at(part.to); }

  /// Does one part begin where the other ends? Parts without width between them are left out.
  bool adjacent(const SweptPart& a, const SweptPart& b) const {
    return (a.curve.at(a.to) - b.curve.at(b.from)).norm() <= kSameSpecks * speck_;
  }
  /// Does the first disc of `b` hold the last one of `a`, or the other way round?
  bool begins_wider(const SweptPart& a, const SweptPart& b) const {
    return adjacent(a, b) && start_radius(b) >= end_radius(a) - speck_;
  }
  bool ends_wider(const SweptPart& a, const SweptPart& b) const {
    return adjacent(a, b) && end_radius(a) >= start_radius(b) - speck_;
  }

  /// Does the disc sweep on from one part to the next without a jump?
  bool joined(const SweptPart& a, const SweptPart& b) const {
    return a.motion == DiscMotion::Sweeps && b.motion == DiscMotion::Sweeps && begins_wider(a, b) &&
           ends_wider(a, b);
  }

  /// Turns the parts of a closed curve so that no run goes on from the last to the first.
  void begin_after_break() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (joined(*before(i), parts_[i])) continue;
      std::rotate(parts_.begin(), parts_.begin() + std::ptrdiff_t(i), parts_.end());
      return;
    }
    ring_ = true;
  }

  /// The discs that are themselves part of the outline: where one has grown up to its end, or begins to
  /// shrink.
  void add_discs(std::size_t i) {
    const SweptPart& part = parts_[i];
    if (part.motion == DiscMotion::Grows) {
      const SweptPart* next = after(i);
      const bool goes_on = next && next->motion != DiscMotion::Shrinks && begins_wider(part, *next);
      if (!goes_on) add_disc(part.disc_at(part.to), next || !flat_ ? 0.0 : -1.0);
    }
    if (part.motion == DiscMotion::Shrinks) {
      const SweptPart* last = before(i);
      const bool goes_on = last && ends_wider(*last, part);
      if (!goes_on) add_disc(part.disc_at(part.from), last || !flat_ ? 0.0 : 1.0);
    }
  }

  /// A whole disc (`half` 0), or its half that lies before (1) or behind (-1) its centre.
  void add_disc(const SweepingDisc& disc, double half) {
    if (disc.radius <= speck_) return;
    const bool whole = half == 0.0 || disc.tangent.isZero(0.0);
    const Vector2 way = whole ? Vector2(1.0, 0.0) : Vector2(half * disc.tangent);
    const Vector2 across = disc.radius * Vector2(-way.y(), way.x());
    Rim rim(disc.centre + across);
    rim.arc_to(disc.centre, -std::numbers::pi, disc.centre - across, tolerance_);
    if (whole) rim.arc_to(disc.centre, -std::numbers::pi, disc.centre + across, tolerance_);
    add_loop(rim);
  }

  void add_loop(Rim& rim) {
    rim.close();
    if (!rim.edges().empty()) pieces_.push_back({std::move(rim.edges())});
  }

  /// From one part of a run to the next: around the corner on its outer side, by the centre on the inner one.
  void append_join(Rim& rim, const SweptPart& a, const SweptPart& b, double side) const {
    const SweepingDisc from = a.disc_at(a.to);
    const SweepingDisc to = b.disc_at(b.from);
    const Vector2 goal = touching_point(to, side);
    const double turn = turn_of_tangents(from.tangent, to.tangent) + side * (lean_of(to) - lean_of(from));
    if (std::abs(turn) * from.radius <= speck_) return rim.line_to(goal);
    if (side * turn < 0.0) {
      rim.arc_to(from.centre, turn, from.centre + from.radius * to.touching(side), tolerance_);
    } else {
      rim.line_to(from.centre);
      rim.line_to(to.centre);
    }
    rim.line_to(goal);
  }

  Rim side_of_run(std::size_t first, std::size_t last, double side) const {
    const SweptPart& start = parts_[first];
    Rim rim(touching_point(start.disc_at(start.from), side));
    for (std::size_t i = first; i <= last; ++i) {
      if (i > first) append_join(rim, parts_[i - 1], parts_[i], side);
      append_side(rim, parts_[i], side, tolerance_);
    }
    return rim;
  }

  void add_ring() {
    for (const double side : {1.0, -1.0}) {
      Rim rim = side_of_run(0, parts_.size() - 1, side);
      append_join(rim, parts_.back(), parts_.front(), side);
      rim.close();
      Rim turned(rim.at());
      turned.append_reversed(rim);
      add_loop(side > 0.0 ? rim : turned);
    }
  }

  RunEnd start_of_run(std::size_t first) const {
    const SweptPart* last = before(first);
    if (!last) return flat_ ? RunEnd::Flat : RunEnd::Round;
    const bool covered = last->motion == DiscMotion::Shrinks && ends_wider(*last, parts_[first]);
    return covered ? RunEnd::Open : RunEnd::Round;
  }

  RunEnd end_of_run(std::size_t last) const {
    const SweptPart* next = after(last);
    if (!next) return flat_ ? RunEnd::Flat : RunEnd::Round;
    const bool covered = next->motion == DiscMotion::Grows && begins_wider(parts_[last], *next);
    return covered ? RunEnd::Open : RunEnd::Round;
  }

  /// From the touching point on side 1 to that on side -1 around `way`, which leads out of the line; `lean`
  /// is the angle between it and the touching points.
  void append_end(Rim& rim, const SweepingDisc& disc, const Vector2& way, double lean, const Vector2& goal,
                  RunEnd end) const {
    if (end == RunEnd::Open) {
      rim.line_to(disc.centre);
    } else if (end == RunEnd::Round) {
      if (lean * disc.radius > speck_) rim.arc_to(disc.centre, -2.0 * lean, goal, tolerance_);
    } else if (const double more = lean - 0.5 * std::numbers::pi; more * disc.radius > speck_) {
      const Vector2 across = disc.radius * Vector2(-way.y(), way.x());
      rim.arc_to(disc.centre, -more, disc.centre + across, tolerance_);
      rim.line_to(disc.centre - across);
      rim.arc_to(disc.centre, -more, goal, tolerance_);
    }
    rim.line_to(goal);
  }

  /// The loop of the discs that sweep on from part `first`; gives the part after them.
  std::size_t add_run(std::size_t first) {
    if (parts_[first].motion != DiscMotion::Sweeps) return first + 1;
    std::size_t last = first;
    while (last + 1 < parts_.size() && joined(parts_[last], parts_[last + 1])) ++last;
    Rim rim = side_of_run(first, last, 1.0);
    const SweepingDisc start = parts_[first].disc_at(parts_[first].from);
    const SweepingDisc end = parts_[last].disc_at(parts_[last].to);
    append_end(rim, end, end.tangent, lean_of(end), touching_point(end, -1.0), end_of_run(last));
    rim.append_reversed(side_of_run(first, last, -1.0));
    append_end(rim, start, -start.tangent, std::numbers::pi - lean_of(start), touching_point(start, 1.0),
               start_of_run(first));
    add_loop(rim);
    return last + 1;
  }

  bool closed_;
  bool flat_;
  bool ring_ = false;  // the whole of a closed curve is one run
  double tolerance_;   // m
  double speck_;       // m
  std::vector<SweptPart> parts_;
  std::vector<OutlinePiece> pieces_;
};

}  // namespace

std::vector<OutlinePiece> outline_of(const Curve& curve, CurveEnds ends, double tolerance) {
  return OutlineMaker(curve, ends, tolerance).made();
}

}  // namespace icome::drawing
