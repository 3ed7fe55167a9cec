#include "geometry/implicit/implicit_pieces.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace icome::geometry {
namespace {

using base::Bounds;
using base::Vector3;
using ChoiceSet = FormulaPieces::ChoiceSet;

constexpr double kAlongside = 1e-6;    // sine of the angle up to which two pieces run along each other
constexpr double kLeastAcross = 0.01;  // the least share of a slope that counts as across

/// Calls `visit(number)` for each choice of a set, until it returns false; then the result is false.
template <typename Visit>
bool each_choice(ChoiceSet set, Visit&& visit) {
  for (; set != 0; set &= set - 1) {
    if (!visit(static_cast<std::size_t>(std::countr_zero(set)))) return false;
  }
  return true;
}

/// The state of a choice on a piece.
enum class ChoiceState { First, Second, Either, Undefined };

/// Within `slack` of its change, a choice counts as either; but where it changes along all of the piece, its
/// state behind the piece counts.
ChoiceState choice_at(const Formula& choice, const Vector3& point, const Vector3& normal, double time,
                      double slack) {
  const Formula::Slope at = choice.slope(point, time);
  const double through = at.gradient.dot(normal);
  const double steepness = at.gradient.norm();
  const double across = (at.gradient - through * normal).norm();
  if (std::isnan(at.value)) return ChoiceState::Undefined;
  if (std::fabs(at.value) > slack * std::max(across, kLeastAcross * steepness)) {
    return at.value > 0.0 ? ChoiceState::Second : ChoiceState::First;
  }
  if (across > kAlongside * steepness || steepness == 0.0) return ChoiceState::Either;
  return through < 0.0 ? ChoiceState::Second : ChoiceState::First;
}

/// The unit gradient; nothing where the formula has no gradient.
std::optional<Vector3> gradient_direction(const Formula::Slope& at) {
  const double steepness = at.gradient.norm();
  if (!(steepness > 0.0) || !std::isfinite(steepness)) return std::nullopt;
  return at.gradient / steepness;
}

/// May it take values on both sides of zero? Rounding alone may bring a sum of squares below zero.
bool may_change_sign(const Formula& formula, const Bounds& box) {
  constexpr double kNothing = 64.0 * rounding::kSmallest;
  const Interval range = formula.range(always_in(box)).value;
  return range.lo < -kNothing && range.hi > kNothing;
}

}  // namespace

ImplicitPieces::ImplicitPieces(FormulaPieces parts, const Bounds& box) : parts_(std::move(parts)) {
  for (const FormulaPieces::Piece& piece : parts_.pieces) {
    ChoiceSet needed = 0;
    for (const FormulaPieces::Case& made : piece.cases) needed |= made.made;
    needed_.push_back(needed);
  }
  std::erase_if(parts_.borders, [&](const Formula& border) { return !may_change_sign(border, box); });
  const std::size_t count = parts_.pieces.size() + parts_.borders.size();
  for (std::size_t piece = 0; piece < count; ++piece) {
    cells_.emplace_back(box, count * steps_of(piece),
                        [&](const Bounds& cell) { return may_run_in(piece, cell); });
    bounds_.extend(cells_.back().bounds());
  }
}

std::size_t ImplicitPieces::steps_of(std::size_t piece) const {
  std::size_t steps = formula(piece).steps();
  if (is_border(piece)) return steps + whole().steps();
  each_choice(needed_[piece], [&](std::size_t choice) {
    steps += parts_.choices[choice].steps();
    return true;
  });
  return steps;
}

bool ImplicitPieces::is_possible(std::size_t piece, const Decided& decided) const {
  const std::vector<FormulaPieces::Case>& cases = parts_.pieces[piece].cases;
  return std::any_of(cases.begin(), cases.end(), [&](const FormulaPieces::Case& it) {
    return (it.made & decided.choices & (it.second ^ decided.second)) == 0;
  });
}

/// May the piece run in the box at any time?
bool ImplicitPieces::may_run_in(std::size_t piece, const Bounds& box) const {
  if (sign_in_box(formula(piece), box) != 0) return false;
  if (is_border(piece)) {
    const Formula::Range range = whole().range(always_in(box));
    return !range.total && !range.never;
  }
  Decided decided;
  each_choice(needed_[piece], [&](std::size_t choice) {
    const int sign = sign_in_box(parts_.choices[choice], box);
    const ChoiceSet bit = ChoiceSet{1} << choice;
    if (sign != 0) decided.choices |= bit;
    if (sign > 0) decided.second |= bit;
    return true;
  });
  return is_possible(piece, decided);
}

std::optional<ImplicitPieces::Decided> ImplicitPieces::decided_at(ChoiceSet wanted, const Vector3& point,
                                                                  const Vector3& normal, double time,
                                                                  double slack) const {
  Decided decided;
  const bool defined = each_choice(wanted, [&](std::size_t choice) {
    const ChoiceState state = choice_at(parts_.choices[choice], point, normal, time, slack);
    const ChoiceSet bit = ChoiceSet{1} << choice;
    if (state == ChoiceState::First || state == ChoiceState::Second) decided.choices |= bit;
    if (state == ChoiceState::Second) decided.second |= bit;
    return state != ChoiceState::Undefined;
  });
  return defined ? std::optional(decided) : std::nullopt;
}

bool ImplicitPieces::covers(std::size_t piece, const Vector3& point, const Vector3& normal, double time,
                            double slack) const {
  if (is_border(piece)) return inside(point - slack * normal, time) && !inside(point + slack * normal, time);
  const auto decided = decided_at(needed_[piece], point, normal, time, slack);
  return decided && is_possible(piece, *decided);
}

std::optional<std::size_t> ImplicitPieces::border_at(const Vector3& point, double time, double slack) const {
  for (std::size_t piece = parts_.pieces.size(); piece < size(); ++piece) {
    const Formula::Slope at = formula(piece).slope(point, time);
    const auto normal = gradient_direction(at);
    if (!normal || !(std::fabs(at.value) <= slack * at.gradient.norm())) continue;
    if (covers(piece, point, *normal, time, slack)) return piece;
  }
  return std::nullopt;
}

std::optional<std::size_t> ImplicitPieces::piece_at(const Vector3& point, double time) const {
  for (std::size_t piece = 0; piece < parts_.pieces.size(); ++piece) {
    const auto decided = decided_at(needed_[piece], point, Vector3::Zero(), time, 0.0);
    if (decided && is_possible(piece, *decided)) return piece;
  }
  return std::nullopt;
}

std::size_t ImplicitPieces::bytes() const {
  const auto of_formulas = [](const std::vector<Formula>& formulas) {
    std::size_t sum = 0;
    for (const Formula& formula : formulas) sum += formula.bytes();
    return sum;
  };
  std::size_t sum = sizeof(*this) + whole().bytes() - sizeof(Formula) + of_formulas(parts_.choices) +
                    of_formulas(parts_.borders) + needed_.capacity() * sizeof(ChoiceSet);
  for (const FormulaPieces::Piece& piece : parts_.pieces) {
    sum += piece.formula.bytes() + piece.cases.capacity() * sizeof(FormulaPieces::Case);
  }
  for (const ImplicitCells& cells : cells_) sum += sizeof(cells) + cells.bytes();
  return sum;
}

}  // namespace icome::geometry
