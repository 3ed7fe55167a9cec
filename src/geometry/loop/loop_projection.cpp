#include "geometry/loop/loop_projection.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

constexpr int kFootSteps = 60;
constexpr int kFootHalvings = 20;
constexpr double kFarFromApex = 1e-3;  // share of the way that is left
constexpr int kMostNoisySteps = 12;
constexpr double kFootDone = 1e-13;     // of the surface's size: the rest of the way along the surface
constexpr double kLeastBending = 1e-3;  // Newton's matrix is kept at least this much of the surface's metric
constexpr double kFootRounding = 4e-16;

/// The squared distance's model at a place, over the cell's s and t.
struct Model {
  double half_square = 0.0;  // m^2, half the squared distance to the goal
  double gs, gt;             // its downhill derivative
  double ss, st, tt;         // the surface's metric
  double hss, hst, htt;      // Newton's matrix
  double left = 0.0;         // m, from the place to the goal along the tangent plane
  double scale = 1.0;        // of the cell
};

/// Keeps Newton's matrix positive: its eigenvalues against the metric are 1 - distance * curvature, which
/// beyond a centre of curvature are taken by their size.
void keep_positive(Model& m) {
  const double det = m.ss * m.tt - m.st * m.st;
  const double mixed = m.hss * m.tt + m.htt * m.ss - 2.0 * m.hst * m.st;
  const double det_h = m.hss * m.htt - m.hst * m.hst;
  // x^2 det - x mixed + det_h = 0
  const double root = std::sqrt(std::max(0.0, mixed * mixed - 4.0 * det * det_h));
  const double low = (mixed - root) / (2.0 * det), high = (mixed + root) / (2.0 * det);
  if (low >= kLeastBending) return;
  const double new_low = std::max(kLeastBending, std::abs(low));
  const double new_high = std::max(kLeastBending, std::abs(high));
  // H' = a M + b H maps both eigenvalues.
  const double gap = high - low;
  const double b = gap > 1e-9 * (std::abs(high) + std::abs(low)) ? (new_high - new_low) / gap : 0.0;
  const double a = b == 0.0 ? std::max(new_low, new_high) : new_low - b * low;
  m.hss = a * m.ss + b * m.hss;
  m.hst = a * m.st + b * m.hst;
  m.htt = a * m.tt + b * m.htt;
}

Model model_at(const LoopCursor& cursor, const Vector3& goal) {
  const QuarticJet2 jet = evaluate2(cursor.cell().shape, cursor.s(), cursor.t());
  const Vector4 rest = vector4(goal - cursor.cell().origin) - jet.value;
  Model m;
  m.half_square = 0.5 * rest.squaredNorm();
  m.gs = rest.dot(jet.ds);
  m.gt = rest.dot(jet.dt);
  m.ss = jet.ds.squaredNorm();
  m.st = jet.ds.dot(jet.dt);
  m.tt = jet.dt.squaredNorm();
  m.hss = m.ss - rest.dot(jet.dss);
  m.hst = m.st - rest.dot(jet.dst);
  m.htt = m.tt - rest.dot(jet.dtt);
  m.scale = cursor.cell().scale;
  const double det = m.ss * m.tt - m.st * m.st;
  if (det > 1e-20 * m.ss * m.tt) {
    m.left =
        std::sqrt(std::max(0.0, (m.tt * m.gs * m.gs - 2.0 * m.st * m.gs * m.gt + m.ss * m.gt * m.gt) / det));
    keep_positive(m);
  } else {  // the derivatives are parallel: downhill, carefully
    const double largest = std::max({m.ss, m.tt, 1e-300});
    m.left = std::sqrt((m.gs * m.gs + m.gt * m.gt) / largest);
    m.hss = m.htt = 2.0 * largest;
    m.hst = 0.0;
  }
  return m;
}

/// A step over the piece's parameters, or along a boundary edge (0 or 2) by `along` of its lengths.
struct Step {
  double du = 0.0, dv = 0.0;
  int edge = -1;
  double along = 0.0;
  double left = 0.0;      // m, the length that the step is to remove
  double decrease = 0.0;  // m^2, of half the squared distance, expected
};

Step step_along(const Model& m, int edge) {
  // Edge 2 runs against v.
  const double g = edge == 0 ? m.gs : -m.gt;
  const double h = edge == 0 ? m.hss : m.htt, metric = edge == 0 ? m.ss : m.tt;
  Step step;
  step.edge = edge;
  const double way = std::clamp(g / std::max(h, kLeastBending * metric), -1.0, 1.0);
  step.along = way / m.scale;
  step.left = std::abs(g) / std::sqrt(std::max(metric, 1e-300));
  step.decrease = 0.5 * g * way;
  return step;
}

Step next_step(const LoopPatches& patches, const LoopSpot& spot, const Model& m) {
  const double det = m.hss * m.htt - m.hst * m.hst;
  double ds = (m.htt * m.gs - m.hst * m.gt) / det, dt = (m.hss * m.gt - m.hst * m.gs) / det;
  const double largest = std::max(std::abs(ds), std::abs(dt));
  if (!(largest < 1e300)) return {};
  if (largest > 1.0) {
    ds /= largest;
    dt /= largest;
  }
  const bool stuck_0 = spot.v == 0.0 && dt * m.scale < 0.0 && ends_at(patches, spot.piece, 0);
  const bool stuck_2 = spot.u == 0.0 && ds * m.scale < 0.0 && ends_at(patches, spot.piece, 2);
  if (stuck_0 && stuck_2) {  // in a corner of one piece: along the better edge, unless both lead out
    const Step one = step_along(m, 0), other = step_along(m, 2);
    if (one.along > 0.0 && (other.along >= 0.0 || one.decrease > other.decrease)) return one;
    return other.along < 0.0 ? other : Step{};
  }
  if (stuck_0) return step_along(m, 0);
  if (stuck_2) return step_along(m, 2);
  Step step;
  step.du = ds / m.scale;
  step.dv = dt / m.scale;
  step.left = m.left;
  step.decrease = 0.5 * (m.gs * ds + m.gt * dt);
  return step;
}

LoopSpot taken(const LoopPatches& patches, const LoopSpot& spot, const Step& step, double share) {
  if (step.edge >= 0) return walk_along(patches, spot, step.edge, share * step.along);
  return walk(patches, spot, share * step.du, share * step.dv);
}

/// Searches around an extraordinary vertex for a way down.
class ApexSearch {
 public:
  ApexSearch(const LoopPatches& patches, LoopCursor& cursor, const Vector3& goal)
      : patches_(patches), cursor_(cursor), goal_(goal) {}

  /// Is there a way down? Then the spot is moved further down.
  bool leave(LoopSpot& spot) {
    // The caller's cursor stands at the vertex.
    apex_ = cursor_.fan().apex;
    const Vector3 rest = goal_ - apex_;
    const double done = kFootDone * patches_.size();
    const Vector3 normal = cursor_.fan().normal;
    const FanRule rule = patches_.rule(spot.piece);
    const bool flat = (rule == FanRule::Smooth || rule == FanRule::Dart) && !normal.isZero(0.0);
    if (flat && (rest - normal * normal.dot(rest)).norm() <= done) return false;
    best_ = done;
    look_around(spot.piece);
    return best_ > done && descend(spot);
  }

 private:
  void look_around(std::uint32_t piece) {
    std::uint32_t first = piece;
    for (std::uint32_t at = piece; at != LoopPatches::kNone;) {
      first = at;
      at = next_at_vertex(patches_, at, false);
      if (at == piece) break;
    }
    std::uint32_t at = first;
    do {
      look(at);
      at = next_at_vertex(patches_, at, true);
    } while (at != LoopPatches::kNone && at != first);
  }

  void look(std::uint32_t piece) {
    constexpr std::array<double, 5> kDirections = {0.0, 0.25, 0.5, 0.75, 1.0};
    const int level = std::max(0, std::min(20, cursor_.fan().levels - 2));
    const double radius = std::ldexp(1.0, -level);
    for (const double direction : kDirections) {
      const double u = radius * (1.0 - direction), v = radius * direction;
      if (!cursor_.go(piece, u, v)) continue;
      const Vector3 away = place() - apex_;
      const double length = away.norm();
      if (!(length > 0.0)) continue;
      const double score = away.dot(goal_ - apex_) / length;
      if (score > best_) {
        best_ = score;
        piece_ = piece;
        direction_ = direction;
      }
    }
  }

  bool descend(LoopSpot& spot) {
    const double before = (goal_ - apex_).squaredNorm();
    cursor_.go(piece_, 1.0 - direction_, direction_);
    for (int level = 0; level < cursor_.fan().levels; ++level) {
      if (level + 1 < cursor_.fan().levels && cursor_.fan().reach(level) > 4.0 * best_) continue;
      const double radius = std::ldexp(1.0, -level);
      const LoopSpot there = {piece_, radius * (1.0 - direction_), radius * direction_};
      if (!cursor_.go(there.piece, there.u, there.v)) return false;
      if ((goal_ - place()).squaredNorm() >= before) continue;
      spot = there;
      return true;
    }
    return false;
  }

  Vector3 place() const {
    return cursor_.cell().origin + vector3(evaluate(cursor_.cell().shape, cursor_.s(), cursor_.t()).value);
  }

  const LoopPatches& patches_;
  LoopCursor& cursor_;
  const Vector3& goal_;
  Vector3 apex_;
  double best_ = 0.0;  // m, the goal's component along the best direction
  std::uint32_t piece_ = 0;
  double direction_ = 0.0;
};

/// Is the extraordinary vertex itself the foot? Newton's steps would only halve the way to it.
bool foot_is_apex(const LoopPatches& patches, const LoopCursor& cursor, const LoopSpot& spot,
                  const Vector3& goal) {
  if (patches.regular(spot.piece) || patches.rule(spot.piece) != FanRule::Smooth || spot.u + spot.v > 0.25) {
    return false;
  }
  const Vector3 rest = goal - cursor.fan().apex;
  const Vector3& normal = cursor.fan().normal;
  return !normal.isZero(0.0) && (rest - normal * normal.dot(rest)).norm() <= kFootDone * patches.size();
}

/// One descent: its current spot and the model there.
class Descent {
 public:
  Descent(const LoopPatches& patches, LoopCursor& cursor, const LoopSpot& from, const Vector3& goal)
      : patches_(patches), cursor_(cursor), goal_(goal), spot_(clamped(from)) {}

  LoopSpot run() {
    for (int steps = 0; steps < kFootSteps && advance(); ++steps) continue;
    return spot_;
  }

 private:
  /// Makes one step; false when the descent ends at the spot.
  bool advance() {
    if (!known_) {
      if (!cursor_.go(spot_.piece, spot_.u, spot_.v)) {
        spot_.u = spot_.v = 0.0;
        return ApexSearch(patches_, cursor_, goal_).leave(spot_);
      }
      here_ = model_at(cursor_, goal_);
      known_ = true;
    }
    if (foot_is_apex(patches_, cursor_, spot_, goal_)) {
      spot_.u = spot_.v = 0.0;
      return false;
    }
    if (apex_is_nearer()) {
      spot_.u = spot_.v = 0.0;
      known_ = false;
      return true;
    }
    const Step step = next_step(patches_, spot_, here_);
    if (!(step.left > kFootDone * patches_.size())) return false;
    if (step.edge < 0 && step.du == 0.0 && step.dv == 0.0) return false;
    if (!patches_.regular(spot_.piece) && cursor_.reach() < kFarFromApex * step.left) {
      // Steps are no longer than the cells here: too short to lead away.
      spot_.u = spot_.v = 0.0;
      known_ = false;
      return true;
    }
    double share = 1.0;
    for (int halvings = 0; halvings < kFootHalvings; ++halvings, share *= 0.5) {
      switch (try_step(step, share)) {
        case Outcome::Better:
          return true;
        case Outcome::End:
          return false;
        case Outcome::Worse:
          break;
      }
    }
    return false;
  }

  /// Is the vertex nearer? Corners and spikes often are the foot; polynomials only lead ever nearer to them.
  bool apex_is_nearer() const {
    if (patches_.regular(spot_.piece) || spot_.u + spot_.v > 0.0625) return false;
    const FanRule rule = patches_.rule(spot_.piece);
    if (rule == FanRule::Smooth || rule == FanRule::Crease) return false;
    return 0.5 * (goal_ - cursor_.fan().apex).squaredNorm() < here_.half_square;
  }

  enum class Outcome { Better, Worse, End };

  Outcome try_step(const Step& step, double share) {
    const LoopSpot there = taken(patches_, spot_, step, share);
    if (there.piece == spot_.piece && there.u == spot_.u && there.v == spot_.v) return Outcome::End;
    if (!cursor_.go(there.piece, there.u, there.v)) {
      if (0.5 * (goal_ - cursor_.fan().apex).squaredNorm() >= here_.half_square) return Outcome::Worse;
      known_ = false;
      spot_ = there;
      return Outcome::Better;
    }
    const Model next = model_at(cursor_, goal_);
    // If squares no longer tell better from worse, the rest of the way must shrink. A step that only led to
    // another piece's view of the same place is taken, too.
    const double distance = std::sqrt(2.0 * here_.half_square);
    const double rounding =
        kFootRounding * distance * (distance + goal_.cwiseAbs().maxCoeff() + patches_.size());
    const bool noise =
        share * step.decrease < 8.0 * rounding || std::abs(next.half_square - here_.half_square) <= rounding;
    if (noise) {
      const double left = step.edge < 0 ? next.left : step_along(next, step.edge).left;
      if (++noisy_steps_ > kMostNoisySteps) return Outcome::End;
      if (next.half_square > here_.half_square + 8.0 * rounding) return Outcome::Worse;
      if (there.piece == spot_.piece && left >= step.left) return Outcome::End;
    } else if (next.half_square >= here_.half_square) {
      return Outcome::Worse;
    }
    spot_ = there;
    here_ = next;
    return Outcome::Better;
  }

  const LoopPatches& patches_;
  LoopCursor& cursor_;
  const Vector3& goal_;
  LoopSpot spot_;
  Model here_;
  bool known_ = false;
  int noisy_steps_ = 0;
};

}  // namespace

LoopSpot loop_projection(const LoopPatches& patches, LoopCursor& cursor, const LoopSpot& from,
                         const Vector3& goal) {
  return Descent(patches, cursor, from, goal).run();
}

}  // namespace icome::geometry
