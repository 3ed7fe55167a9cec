#include "geometry/implicit/implicit_crossing.h"

#include <array>
#include <cmath>

#include "geometry/implicit/formula_allowance.h"

namespace icome::geometry {
namespace {

// Evaluations of intervals before the answer is "no further than here, to be sure". A way through a
// hundred sheets takes some hundreds, and they take tens of microseconds.
constexpr int kMostCells = 1024;
constexpr std::size_t kMostLineHalvings = 60;

/// A part of the way.
struct LinePart {
  double a, b;
};

/// Goes along the way from its beginning, part by part, and remembers on which side it is. F is f, or -f
/// where ways out are looked for: it is negative behind the surface.
class CrossingSearch {
 public:
  CrossingSearch(const Formula& formula, const ImplicitLine& line,
                 base::FunctionRef<bool(double s, bool jump)> counts)
      : formula_(formula),
        line_(line),
        counts_(counts),
        sign_(line.from_behind ? -1.0 : 1.0),
        length_(line.step.norm()) {}

  std::optional<double> run() {
    look_at_start();
    std::array<LinePart, kMostLineHalvings + 2> stack;
    std::size_t size = 0;
    stack[size++] = {line_.first, line_.last};
    for (int left = kMostCells; size > 0; --left) {
      const LinePart cell = stack[--size];
      if (left == 0 || FormulaAllowance::spent()) return cell.a;
      switch (look_at(cell)) {
        case Outcome::Crossing:
          // A way in from within slack begins at its start, if the surface already runs there.
          if (starts_inwards_ && level_ > 0.0 && counts_(line_.first, jump_)) return line_.first;
          if (counts_(found_, jump_)) return found_;
          in_front_ = false;
          level_ = 0.0;
          break;
        case Outcome::Clear:
          break;
        case Outcome::Unclear: {
          const double middle = cell.a + 0.5 * (cell.b - cell.a);
          stack[size++] = {middle, cell.b};
          stack[size++] = {cell.a, middle};
        }
      }
    }
    return std::nullopt;
  }

 private:
  enum class Outcome { Clear, Crossing, Unclear };

  bool is_front(double value) const { return line_.from_behind ? value < 0.0 : !(value < 0.0); }
  double value(double s) const { return formula_.value(line_.start + s * line_.step, line_.time); }
  double height(double s) const { return sign_ * value(s) + level_; }
  /// |F| up to which a place near s counts as lying on the surface, for a distance in metres.
  double band(double s, double distance) const {
    const double steepness = formula_.slope(line_.start + s * line_.step, line_.time).gradient.norm();
    return std::isfinite(steepness) ? distance * steepness : 0.0;
  }

  /// A start within slack of the surface counts as being in front: until the way is clear of the surface,
  /// the level that it must not go through lies that much deeper.
  void look_at_start() {
    const Formula::LineSlope at = formula_.on_line(line_.start, line_.step, line_.first, line_.time);
    in_front_ = is_front(at.value);
    if (!line_.starts_freely) return;
    const double doubt = band(line_.first, line_.slack);
    if (!(std::fabs(at.value) <= doubt)) return;
    in_front_ = true;
    level_ = doubt;
    starts_inwards_ = sign_ * at.slope < 0.0;
  }

  bool surely_front(const Formula::Range& range) const {
    if (line_.from_behind) return range.total && range.value.hi < 0.0;
    return range.never || range.value.lo >= 0.0;
  }
  bool surely_behind(const Formula::Range& range) const {
    if (line_.from_behind) return level_ == 0.0 && (range.never || range.value.lo >= 0.0);
    return range.total && range.value.hi < -level_;
  }

  bool above_level(const Interval& value) const {
    return (line_.from_behind ? -value.hi : value.lo) >= -level_;
  }

  Outcome clear_front(bool steady) {
    in_front_ = true;
    steady_ = steady;
    level_ = 0.0;
    return Outcome::Clear;
  }
  Outcome crossing(double s, bool jump) {
    found_ = s;
    jump_ = jump;
    return Outcome::Crossing;
  }
  Outcome behind_from(double s) { return in_front_ ? crossing(s, !steady_) : Outcome::Clear; }

  Outcome look_at(const LinePart& cell) {
    Formula::SlopeRange<1> at = formula_.line_range(line_.start, line_.step, {cell.a, cell.b}, line_.time);
    if (surely_front(at.range)) return clear_front(at.range.total);
    if (surely_behind(at.range)) return behind_from(cell.a);
    const double width = cell.b - cell.a;
    const double middle = cell.a + 0.5 * width;
    const bool tiny = width * length_ <= 0.1 * line_.slack || middle <= cell.a || middle >= cell.b ||
                      width <= (line_.last - line_.first) * 0x1p-52;
    if (at.range.total) {
      const Interval slope = at.slope[0] * sign_;
      if (slope.lo > 0.0) return look_at_rising(cell);
      if (slope.hi < 0.0) return look_at_falling(cell);
      // The mean value form: much narrower where the slope hardly varies.
      const Formula::Range there = formula_.point_range(line_.start, line_.step, middle, line_.time);
      const Interval mean = there.value + at.slope[0] * Interval{cell.a - middle, cell.b - middle};
      at.range.value = intersection(at.range.value, mean);
      if (surely_front(at.range)) return clear_front(at.range.total);
      if (surely_behind(at.range)) return behind_from(cell.a);
      // Along the surface, from within slack: still in front.
      if (level_ > 0.0 && above_level(at.range.value)) return Outcome::Clear;
      // Too near to the surface all along: only later parts show on which side the way goes on.
      if (magnitude(at.range.value) <= band(middle, 0.1 * line_.slack)) return Outcome::Clear;
    }
    if (!tiny) return Outcome::Unclear;
    steady_ = at.range.total;
    if (!(is_front(value(cell.b)) || height(cell.b) >= 0.0)) return behind_from(cell.a);
    if (is_front(value(cell.b))) in_front_ = true;
    return Outcome::Clear;
  }

  Outcome look_at_rising(const LinePart& cell) {
    if (is_front(value(cell.b))) return clear_front(true);
    if (in_front_ && height(cell.a) < 0.0) return crossing(cell.a, !steady_);
    return Outcome::Clear;
  }

  Outcome look_at_falling(const LinePart& cell) {
    if (is_front(value(cell.b))) return clear_front(true);
    const double before = height(cell.a);
    if (height(cell.b) >= 0.0) return Outcome::Clear;
    if (before >= 0.0) return crossing(root(cell, before), false);
    return behind_from(cell.a);
  }

  /// The zero of the height in a cell in which it falls: by Newton's method, and by halving where that
  /// leaves the cell.
  double root(const LinePart& cell, double before) const {
    double a = cell.a, b = cell.b;
    const double enough = std::max(0.01 * line_.slack / length_, 0x1p-52 * line_.last);
    double s = a;
    Formula::LineSlope at{0.0, 0.0};
    double above = before;
    for (int i = 0; i < 80; ++i) {
      at = formula_.on_line(line_.start, line_.step, s, line_.time);
      above = sign_ * at.value + level_;
      (above >= 0.0 ? a : b) = s;
      double next = s - above / (sign_ * at.slope);
      if (!(next > a && next < b)) next = a + 0.5 * (b - a);
      const double moved = std::fabs(next - s);
      s = next;
      if (moved <= enough || b - a <= enough) break;
    }
    return s;
  }

  const Formula& formula_;
  const ImplicitLine& line_;
  const base::FunctionRef<bool(double s, bool jump)> counts_;
  const double sign_;
  const double length_;
  bool in_front_ = false;
  double level_ = 0.0;  // F above this much below zero counts as in front
  bool starts_inwards_ = false;
  double found_ = 0.0;
  bool jump_ = false;   // may f be discontinuous or undefined at the found crossing?
  bool steady_ = true;  // was f surely continuous where it was last looked at?
};

}  // namespace

std::optional<double> first_crossing(const Formula& formula, const ImplicitLine& line,
                                     base::FunctionRef<bool(double s, bool jump)> counts) {
  if (!(line.last >= line.first) || !(line.step.norm() > 0.0)) return std::nullopt;
  return CrossingSearch(formula, line, counts).run();
}

std::optional<double> first_crossing(const Formula& formula, const ImplicitLine& line) {
  return first_crossing(formula, line, [](double, bool) { return true; });
}

}  // namespace icome::geometry
