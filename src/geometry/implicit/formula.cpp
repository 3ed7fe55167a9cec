#include "geometry/implicit/formula.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/implicit/formula_allowance.h"

namespace icome::geometry {
namespace {

using base::Vector3;

constexpr std::uint64_t kIntervalWork = 8;  // times the work on a number

/// Doubts about a value in a range: it may be undefined or discontinuous, or is undefined everywhere.
struct Doubts {
  bool some = false, all = false;
};

/// The doubts about a step with operands in the given ranges.
Doubts doubts_of(Operation operation, const Interval& a, const Interval& b) {
  switch (operation) {
    case Operation::Reciprocal:
      return {a.contains(0.0), false};
    case Operation::Divide:
      return {b.contains(0.0), false};
    case Operation::Sqrt:
    case Operation::ConstantPower:
      return {a.lo < 0.0, a.hi < 0.0};
    case Operation::Log:
      return {a.lo <= 0.0, a.hi < 0.0};
    case Operation::Power:
      return {a.lo <= 0.0, a.hi < 0.0};
    case Operation::Asin:
    case Operation::Acos:
      return {a.lo < -1.0 || a.hi > 1.0, a.lo > 1.0 || a.hi < -1.0};
    case Operation::Tan:
      return {may_hold_tangent_pole(a), false};
    case Operation::Wrap:
      return {may_hold_half_turn(a), false};
    case Operation::Atan2:
      return {b.lo <= 0.0 && a.contains(0.0), false};  // jumps by 2 pi
    default:
      return {};
  }
}

template <typename Number>
Number constant_number(double value) {
  using Scalar = decltype(Number::value);
  Number number;
  number.value = jets::exactly<Scalar>(value);
  number.first.fill(jets::exactly<Scalar>(0.0));
  number.second.fill(jets::exactly<Scalar>(0.0));
  return number;
}

template <typename Number>
void set(Number& number, double value, int variable) {
  number = constant_number<Number>(value);
  if (variable < 0) return;
  number.first[static_cast<std::size_t>(variable)] = jets::exactly<decltype(Number::value)>(1.0);
}

/// A Select on numbers with their derivatives.
template <typename Number>
Number selected(const Number& condition, const Number& a, const Number& b) {
  using Scalar = decltype(Number::value);
  if constexpr (std::is_same_v<Scalar, double>) {
    if (std::isnan(condition.value)) return constant_number<Number>(condition.value);
    return condition.value <= 0.0 ? a : b;
  } else {
    if (condition.value.hi <= 0.0) return a;
    if (condition.value.lo > 0.0) return b;
    return jets::each(a, b, [](const Interval& one, const Interval& other) { return hull(one, other); });
  }
}

/// The doubts about a Select in a range of its condition, by those about its operands.
Doubts doubts_of_select(const Interval& range, const Doubts& condition, const Doubts& a, const Doubts& b) {
  if (range.hi <= 0.0) return {condition.some || a.some, condition.all || a.all};
  if (range.lo > 0.0) return {condition.some || b.some, condition.all || b.all};
  return {true, condition.all || (a.all && b.all)};
}

}  // namespace

template <typename Scalar, int Variables, int Order>
Jet<Scalar, Variables, Order> Formula::run(Registers<Jet<Scalar, Variables, Order>>& registers) const {
  using Number = Jet<Scalar, Variables, Order>;
  FormulaAllowance::count(1);
  for (const Instruction& next : program_) {
    Number& to = registers[next.to];
    if (next.operation == Operation::Constant) {
      to = constant_number<Number>(next.constant);
    } else if (is_ternary(next.operation)) {
      to = selected(registers[next.c], registers[next.a], registers[next.b]);
    } else {
      to = compute(next.operation, next.constant, registers[next.a], registers[next.b]);
    }
  }
  return registers[result_];
}

template <int Variables, int Order>
Jet<Interval, Variables, Order> Formula::run_watched(Registers<Jet<Interval, Variables, Order>>& registers,
                                                     Range& range) const {
  using Number = Jet<Interval, Variables, Order>;
  Registers<Doubts> doubts{};
  FormulaAllowance::count(kIntervalWork);
  for (const Instruction& next : program_) {
    Number& to = registers[next.to];
    if (next.operation == Operation::Constant) {
      to = constant_number<Number>(next.constant);
      doubts[next.to] = {};
      continue;
    }
    const Number &a = registers[next.a], &b = registers[next.b];
    const Doubts &of_a = doubts[next.a], &of_b = doubts[next.b];
    Doubts own;
    if (is_ternary(next.operation)) {
      own = doubts_of_select(registers[next.c].value, doubts[next.c], of_a, of_b);
      to = selected(registers[next.c], a, b);
    } else {
      own = doubts_of(next.operation, a.value, b.value);
      own = {own.some || of_a.some || of_b.some, own.all || of_a.all || of_b.all};
      to = compute(next.operation, next.constant, a, b);
    }
    // Beyond the largest number, differences and products of doubles may be NaN.
    own.some |= !(to.value.hi - to.value.lo <= rounding::kLargest);
    doubts[next.to] = own;
  }
  range = {registers[result_].value, !doubts[result_].some, doubts[result_].all};
  return registers[result_];
}

double Formula::value(const Vector3& point, double time) const {
  Registers<Jet<double, 0, 0>> registers;
  for (int i = 0; i < 3; ++i) registers[static_cast<std::size_t>(i)].value = point[i];
  registers[3].value = time;
  return run(registers).value;
}

Formula::Slope Formula::slope(const Vector3& point, double time) const {
  Registers<Jet<double, 4, 1>> registers;
  for (int i = 0; i < 3; ++i) set(registers[static_cast<std::size_t>(i)], point[i], i);
  set(registers[3], time, 3);
  const auto result = run(registers);
  return {result.value, {result.first[0], result.first[1], result.first[2]}, result.first[3]};
}

Formula::Bend Formula::bend(const Vector3& point, double time) const {
  Registers<Jet<double, 3, 2>> registers;
  for (int i = 0; i < 3; ++i) set(registers[static_cast<std::size_t>(i)], point[i], i);
  set(registers[3], time, -1);
  const auto result = run(registers);
  Bend bend{result.value, {result.first[0], result.first[1], result.first[2]}, {}};
  const auto& h = result.second;
  bend.hessian << h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5];
  return bend;
}

Formula::LineSlope Formula::on_line(const Vector3& start, const Vector3& step, double s, double time) const {
  Registers<Jet<double, 1, 1>> registers;
  for (int i = 0; i < 3; ++i) {
    registers[static_cast<std::size_t>(i)] = {start[i] + s * step[i], {step[i]}, {}};
  }
  set(registers[3], time, -1);
  const auto result = run(registers);
  return {result.value, result.first[0]};
}

Formula::Range Formula::range(const Box4& box) const {
  Registers<Jet<Interval, 0, 0>> registers;
  for (std::size_t i = 0; i < 4; ++i) registers[i].value = box[i];
  Range range;
  run_watched(registers, range);
  return range;
}

Formula::SlopeRange<3> Formula::slope_range(const Box4& box) const {
  Registers<Jet<Interval, 3, 1>> registers;
  for (std::size_t i = 0; i < 4; ++i) {
    set(registers[i], 0.0, i < 3 ? static_cast<int>(i) : -1);
    registers[i].value = box[i];
  }
  SlopeRange<3> result;
  result.slope = run_watched(registers, result.range).first;
  return result;
}

Formula::BendRange Formula::bend_range(const Box4& box) const {
  Registers<Jet<Interval, 3, 2>> registers;
  for (std::size_t i = 0; i < 4; ++i) {
    set(registers[i], 0.0, i < 3 ? static_cast<int>(i) : -1);
    registers[i].value = box[i];
  }
  BendRange result;
  const auto end = run_watched(registers, result.range);
  result.slope = end.first;
  result.bend = end.second;
  return result;
}

bool Formula::is_smooth() const {
  return std::none_of(program_.begin(), program_.end(), [](const Instruction& it) {
    return it.operation == Operation::Abs || it.operation == Operation::Min ||
           it.operation == Operation::Max || it.operation == Operation::Select;
  });
}

Formula::SlopeRange<1> Formula::line_range(const Vector3& start, const Vector3& step, const Interval& s,
                                           double time) const {
  Registers<Jet<Interval, 1, 1>> registers;
  for (int i = 0; i < 3; ++i) {
    registers[static_cast<std::size_t>(i)] = {s * step[i] + start[i], {Interval{step[i], step[i]}}, {}};
  }
  set(registers[3], time, -1);
  SlopeRange<1> result;
  result.slope = run_watched(registers, result.range).first;
  return result;
}

Formula::Range Formula::point_range(const Vector3& start, const Vector3& step, double s, double time) const {
  Box4 box;
  for (int i = 0; i < 3; ++i) box[static_cast<std::size_t>(i)] = Interval{s, s} * step[i] + start[i];
  box[3] = {time, time};
  return range(box);
}

Formula::SlopeRange<2> Formula::patch_range(const Vector3& origin, const Vector3& u, const Vector3& v,
                                            const Interval& p, const Interval& q, double time) const {
  Registers<Jet<Interval, 2, 1>> registers;
  for (int i = 0; i < 3; ++i) {
    registers[static_cast<std::size_t>(i)] = {
        p * u[i] + q * v[i] + origin[i], {Interval{u[i], u[i]}, Interval{v[i], v[i]}}, {}};
  }
  set(registers[3], time, -1);
  SlopeRange<2> result;
  result.slope = run_watched(registers, result.range).first;
  return result;
}

namespace {

/// Marks the steps that `root` needs with the number of the last step that uses them.
std::vector<std::uint32_t> last_uses(const std::vector<Expression::Step>& steps, Expression::Node root) {
  std::vector<std::uint32_t> last(steps.size(), 0);
  last[root] = static_cast<std::uint32_t>(steps.size());
  for (std::uint32_t i = root + 1; i-- > 0;) {
    if (last[i] == 0 || is_leaf(steps[i].operation)) continue;
    last[steps[i].a] = std::max(last[steps[i].a], i);
    if (is_binary(steps[i].operation)) last[steps[i].b] = std::max(last[steps[i].b], i);
    if (is_ternary(steps[i].operation)) last[steps[i].c] = std::max(last[steps[i].c], i);
  }
  return last;
}

/// Hands out registers; the one given back last comes first.
class RegisterPool {
 public:
  explicit RegisterPool(std::uint16_t first) : next_(first) {}
  std::uint16_t take() {
    if (free_.empty()) return next_++;
    const std::uint16_t last = free_.back();
    free_.pop_back();
    return last;
  }
  void give_back(std::uint16_t one) { free_.push_back(one); }

 private:
  std::vector<std::uint16_t> free_;
  std::uint16_t next_;
};

}  // namespace

base::Result<Formula> Formula::compile(const Expression& expression, Expression::Node root) {
  const std::vector<Expression::Step>& steps = expression.steps();
  const std::vector<std::uint32_t> last = last_uses(steps, root);
  std::vector<std::uint16_t> home(steps.size(), 0);
  RegisterPool pool(4);
  Formula formula;
  for (std::uint32_t i = 0; i <= root; ++i) {
    if (last[i] == 0) continue;
    const Expression::Step& step = steps[i];
    if (step.operation == Operation::Variable) {
      home[i] = static_cast<std::uint16_t>(step.a);
      formula.used_[step.a] = true;
      continue;
    }
    const bool binary = is_binary(step.operation), leaf = is_leaf(step.operation);
    const std::uint16_t a = leaf ? std::uint16_t{0} : home[step.a], b = binary ? home[step.b] : a;
    const std::uint16_t c = is_ternary(step.operation) ? home[step.c] : a;
    // The result may take an operand's register: it is written after all have been read.
    if (!leaf && last[step.a] == i && a >= 4) pool.give_back(a);
    if (b != a && last[step.b] == i && b >= 4) pool.give_back(b);
    if (c != a && c != b && last[step.c] == i && c >= 4) pool.give_back(c);
    home[i] = pool.take();
    if (home[i] >= kMostRegisters) {
      return base::fail(
          fmt::format("the formula keeps more than {} intermediate values at a time: write long sums and "
                      "products from left to right, without parentheses around their ends",
                      kMostRegisters));
    }
    formula.program_.push_back({step.operation, home[i], a, b, c, step.constant});
    if (formula.program_.size() > kMostSteps) {
      return base::fail(fmt::format(
          "the formula takes more than {} operations, too many for a haptic loop: simplify it", kMostSteps));
    }
  }
  formula.result_ = home[root];
  return formula;
}

base::Result<Formula> Formula::parse(const std::string& text) {
  Expression expression;
  const auto root = read_formula(text, expression);
  if (!root) return base::fail(root.error().message);
  return compile(expression, *root);
}

}  // namespace icome::geometry
