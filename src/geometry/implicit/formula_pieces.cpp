#include "geometry/implicit/formula_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace icome::geometry {
namespace {

using Node = Expression::Node;
using Case = FormulaPieces::Case;
using ChoiceSet = FormulaPieces::ChoiceSet;

constexpr std::size_t kMostBorders = 512;
constexpr std::size_t kMostCases = 256;  // of one part of a formula
constexpr std::size_t kMostChoices = 64;
constexpr int kMostInversions = 4;  // of one part: roots of roots
constexpr double kQuarter = 0.5 * std::numbers::pi;

/// The smooth function that a part of a formula is where choices were made by this case.
struct SmoothPart {
  Node node;
  Case by;
};

/// Do both make the choices that they share alike?
bool agree(const Case& one, const Case& other) {
  return (one.made & other.made & (one.second ^ other.second)) == 0;
}

/// Solves f = 0 for the operand of a root, a hypot, asin or acos in it: z - sqrt(x) is zero where z^2 - x
/// is and z is not negative. At the edge of its domain f is infinitely steep, or ends; the solved function
/// goes on.
class Inversion {
 public:
  Inversion(Expression& expression, Node root)
      : expression_(expression), inner_(root), value_(expression.constant(0.0)) {
    while (const auto next = next_step(inner_)) {
      const Expression::Step step = expression_.steps()[inner_];
      if (invert(step)) {
        found_ = true;
        return;
      }
      peel(step, *next);
    }
  }

  bool found() const { return found_; }
  /// A function that has the zeros of f where the limits are zero or less, and rises there where f does.
  Node solved() { return rises_ ? difference(inner_, value_) : difference(value_, inner_); }
  const std::vector<Node>& limits() const { return limits_; }

 private:
  static bool is_invertible(const Expression::Step& step) {
    switch (step.operation) {
      case Operation::Sqrt:
      case Operation::Hypot:
      case Operation::Asin:
      case Operation::Acos:
        return true;
      case Operation::ConstantPower:
        return step.constant > 0.0 && step.constant < 1.0;
      default:
        return false;
    }
  }

  /// The operand that leads to an invertible step, or the node itself if it is one; nothing otherwise.
  std::optional<Node> next_step(Node node) {
    if (++looks_ > kMostLooks) return std::nullopt;
    const Expression::Step step = expression_.steps()[node];
    if (is_invertible(step)) return node;
    switch (step.operation) {
      case Operation::Add:
      case Operation::Subtract:
        if (next_step(step.a)) return step.a;
        return next_step(step.b) ? std::optional(step.b) : std::nullopt;
      case Operation::Negate:
      case Operation::Scale:
      case Operation::AddConstant:
        return next_step(step.a) ? std::optional(step.a) : std::nullopt;
      default:
        return std::nullopt;
    }
  }

  /// Replaces the equation inner_ = value_ by one for an operand of inner_.
  void peel(const Expression::Step& step, Node operand) {
    inner_ = operand;
    switch (step.operation) {
      case Operation::Negate:
        value_ = expression_.unary(Operation::Negate, value_);
        rises_ = !rises_;
        return;
      case Operation::Scale:
        value_ = expression_.binary(Operation::Divide, value_, expression_.constant(step.constant));
        rises_ = rises_ == (step.constant > 0.0);
        return;
      case Operation::AddConstant:
        value_ = difference(value_, expression_.constant(step.constant));
        return;
      case Operation::Add:
        value_ = difference(value_, operand == step.a ? step.b : step.a);
        return;
      default:  // Subtract
        if (operand == step.a) {
          value_ = expression_.binary(Operation::Add, value_, step.b);
        } else {
          value_ = difference(step.a, value_);
          rises_ = !rises_;
        }
    }
  }

  bool invert(const Expression::Step& step) {
    if (!is_invertible(step)) return false;
    const Node zero = expression_.constant(0.0);
    inner_ = step.a;
    if (step.operation == Operation::Asin) {
      const Node most = expression_.constant(0.5 * std::numbers::pi);
      limits_ = {difference(value_, most), difference(expression_.unary(Operation::Negate, value_), most)};
      value_ = expression_.unary(Operation::Sin, value_);
      return true;
    }
    if (step.operation == Operation::Acos) {
      limits_ = {difference(zero, value_), difference(value_, expression_.constant(std::numbers::pi))};
      value_ = expression_.unary(Operation::Cos, value_);
      rises_ = !rises_;
      return true;
    }
    const double root = step.operation == Operation::ConstantPower ? 1.0 / step.constant : 2.0;
    const double whole = std::round(root);  // 1 / (1.0 / 3) may be a little off
    const bool is_whole = std::fabs(root - whole) <= 4.0 * rounding::kRelative * root;
    if (step.operation == Operation::Hypot) {
      inner_ = expression_.binary(Operation::Add, square(step.a), square(step.b));  // never ends
    } else {
      limits_ = {difference(zero, value_)};
    }
    // With its sign the power rises all along: so no path goes through the bottom of a groove, or of a pit,
    // where the walls beyond would lead apart again.
    value_ = expression_.odd_power(value_, is_whole ? whole : root);
    return true;
  }

  Node difference(Node a, Node b) { return expression_.binary(Operation::Subtract, a, b); }
  Node square(Node a) { return expression_.binary(Operation::Power, a, expression_.constant(2.0)); }

  static constexpr int kMostLooks = 4096;

  Expression& expression_;
  Node inner_, value_;  // f is zero where these are equal
  bool rises_ = true;   // f with inner_
  bool found_ = false;
  int looks_ = 0;
  std::vector<Node> limits_;
};

/// Takes an expression apart, step by step, operands first.
class FormulaSplitter {
 public:
  FormulaSplitter(Expression& expression, Node root) : expression_(expression), root_(root) {}

  void run() {
    const std::vector<Expression::Step> steps = expression_.steps();
    const std::vector<bool> used = used_steps(steps, root_);
    parts_.resize(root_ + 1);
    for (Node i = 0; i <= root_; ++i) {
      if (!used[i]) continue;
      parts_[i] = parts_of(i, steps[i]);
      find_borders(steps[i]);
      if (too_many_borders()) return;
    }
  }

  /// Goes on beyond the ends of powers and roots: each part becomes a function with the same zeros, trimmed
  /// by more choices.
  void go_on() {
    for (SmoothPart& part : parts_[root_]) {
      extend(part);
      for (int i = 0; i < kMostInversions && invert(part); ++i) continue;
    }
  }

  const std::vector<SmoothPart>& parts() const { return parts_[root_]; }
  const std::vector<Node>& choices() const { return choices_; }
  const std::vector<Node>& borders() const { return borders_; }
  bool too_many_borders() const { return borders_.size() > kMostBorders; }

 private:
  bool invert(SmoothPart& part) {
    expression_.forget_fault();
    Inversion inversion(expression_, part.node);
    if (!inversion.found()) return false;
    return replace(part, inversion.solved(), inversion.limits());
  }

  /// Replaces powers that end where their base is negative by powers of its size, without a crease.
  bool extend(SmoothPart& part) {
    const std::vector<Expression::Step> steps = expression_.steps();
    const auto ends = [](const Expression::Step& step) {
      return step.operation == Operation::ConstantPower && step.constant > 1.0;
    };
    if (std::none_of(steps.begin(), steps.end(), ends)) return false;
    const std::vector<bool> used = used_steps(steps, part.node);
    std::vector<Node> extended(part.node + 1), limits;
    expression_.forget_fault();
    for (Node i = 0; i <= part.node; ++i) {
      const Expression::Step& step = steps[i];
      if (!used[i]) continue;
      if (is_ternary(step.operation)) return false;  // the operand that it does not take sets no limits
      if (is_leaf(step.operation)) {
        extended[i] = i;
      } else if (ends(step)) {
        extended[i] = expression_.size_power(extended[step.a], step.constant);
        limits.push_back(expression_.unary(Operation::Negate, extended[step.a]));
      } else {
        extended[i] = expression_.rebuilt(step, extended[step.a], extended[step.b]);
      }
    }
    return !limits.empty() && replace(part, extended[part.node], limits);
  }

  /// Makes a part another function with the same zeros where the limits are zero or less.
  bool replace(SmoothPart& part, Node by, const std::vector<Node>& limits) {
    SmoothPart replaced{by, part.by};
    for (const Node limit : limits) {
      const Expression::Step step = expression_.steps()[limit];
      if (step.operation == Operation::Constant && step.constant <= 0.0) continue;
      const auto known = std::find(choices_.begin(), choices_.end(), limit);
      const auto number = std::size_t(known - choices_.begin());
      if (number >= kMostChoices) return false;
      const ChoiceSet bit = ChoiceSet{1} << number;
      // A limit that is a choice already may have been made the other way.
      if ((replaced.by.second & bit) != 0) return false;
      if (known == choices_.end()) choices_.push_back(limit);
      replaced.by.made |= bit;
    }
    if (!expression_.fault().empty()) return false;
    part = replaced;
    return true;
  }

  static std::vector<bool> used_steps(const std::vector<Expression::Step>& steps, Node root) {
    std::vector<bool> used(steps.size(), false);
    used[root] = true;
    for (Node i = root + 1; i-- > 0;) {
      if (!used[i] || is_leaf(steps[i].operation)) continue;
      used[steps[i].a] = true;
      if (is_binary(steps[i].operation)) used[steps[i].b] = true;
      if (is_ternary(steps[i].operation)) used[steps[i].c] = true;
    }
    return used;
  }

  std::vector<SmoothPart> parts_of(Node node, const Expression::Step& step) {
    const std::vector<SmoothPart> as_it_is{{node, {0, 0}}};
    if (is_leaf(step.operation)) return as_it_is;
    const bool turns = expression_.takes_back(step);
    if ((turns || chooses(step.operation)) && choices_.size() == kMostChoices) return as_it_is;
    std::vector<SmoothPart> parts = turns                                ? taken_back(step)
                                    : step.operation == Operation::Atan2 ? angles(step)
                                    : chooses(step.operation)            ? chosen(step)
                                                                         : combined(step);
    return parts.size() > kMostCases ? as_it_is : parts;
  }

  /// The parts of an asin, acos or atan that takes back its operand: straight lines, chosen by their slope.
  std::vector<SmoothPart> taken_back(const Expression::Step& step) {
    const Expression::Step inner = expression_.steps()[step.a];
    if (step.operation == Operation::Atan && inner.operation != Operation::Tan)
      return slopes(*expression_.quotient(step.a));
    const bool cosine = inner.operation == Operation::Cos;  // the sine of what is left to a quarter
    const ChoiceSet bit = ChoiceSet{1} << choices_.size();
    std::vector<SmoothPart> result;
    for (const SmoothPart& part : parts_[inner.a]) {
      const Node angle = cosine ? left_to(kQuarter, part.node) : part.node;
      result.push_back({line(step.operation, angle, false), {part.by.made | bit, part.by.second}});
      result.push_back({line(step.operation, angle, true), {part.by.made | bit, part.by.second | bit}});
    }
    const Node angle = cosine ? left_to(kQuarter, inner.a) : inner.a;
    choices_.push_back(expression_.unary(Operation::Negate, expression_.unary(Operation::Cos, angle)));
    return result;
  }

  /// The asin or acos of the sine of an angle, or the atan of its tangent, where the cosine is zero or more,
  /// or where it is `less`.
  Node line(Operation operation, Node angle, bool less) {
    if (operation == Operation::Atan && less)
      angle = expression_.binary(Operation::Subtract, angle, half_turn());
    if (operation != Operation::Atan && less) angle = left_to(2.0 * kQuarter, angle);
    const Node wrapped = expression_.unary(Operation::Wrap, angle);
    return operation == Operation::Acos ? left_to(kQuarter, wrapped) : wrapped;
  }
  Node half_turn() { return expression_.constant(2.0 * kQuarter); }
  Node left_to(double most, Node angle) {
    return expression_.binary(Operation::Subtract, expression_.constant(most), angle);
  }

  /// The parts of atan(a / b) where b is zero or more, and where it is less: each goes on smoothly beyond.
  std::vector<SmoothPart> slopes(const Expression::Quotient& quotient) {
    const ChoiceSet bit = ChoiceSet{1} << choices_.size();
    const std::vector<SmoothPart> one{{quotient.over, {0, 0}}};  // for a reciprocal, whose 1 has no parts
    const bool known = quotient.over < parts_.size() && !parts_[quotient.over].empty();
    std::vector<SmoothPart> result;
    for (const SmoothPart& a : known ? parts_[quotient.over] : one) {
      for (const SmoothPart& b : parts_[quotient.under]) {
        if (!agree(a.by, b.by)) continue;
        const Case by{a.by.made | b.by.made | bit, a.by.second | b.by.second};
        const Node over =
            expression_.binary(Operation::Multiply, a.node, expression_.constant(quotient.factor));
        result.push_back({expression_.binary(Operation::Atan2, over, b.node), by});
        result.push_back({expression_.binary(Operation::Atan2, expression_.unary(Operation::Negate, over),
                                             expression_.unary(Operation::Negate, b.node)),
                          {by.made, by.second | bit}});
      }
    }
    choices_.push_back(expression_.unary(Operation::Negate, quotient.under));
    return result;
  }

  std::vector<SmoothPart> combined(const Expression::Step& step) {
    std::vector<SmoothPart> result;
    const bool binary = is_binary(step.operation);
    for (const SmoothPart& a : parts_[step.a]) {
      for (const SmoothPart& b : binary ? parts_[step.b] : std::vector{a}) {
        if (!agree(a.by, b.by)) continue;
        expression_.forget_fault();
        const Node node = expression_.rebuilt(step, a.node, b.node);
        // A part without a value, as sqrt(min(x, -1)) where the choice is -1, has no surface.
        if (!expression_.fault().empty()) continue;
        result.push_back({node, {a.by.made | b.by.made, a.by.second | b.by.second}});
        if (result.size() > kMostCases) return result;
      }
    }
    return result;
  }

  /// The parts of atan2(y, x) where y is zero or more, and where it is less: turned by a quarter so that the
  /// jump is on the other side.
  std::vector<SmoothPart> angles(const Expression::Step& step) {
    const ChoiceSet bit = ChoiceSet{1} << choices_.size();
    std::vector<SmoothPart> result;
    for (const SmoothPart& y : parts_[step.a]) {
      for (const SmoothPart& x : parts_[step.b]) {
        if (!agree(y.by, x.by)) continue;
        const Case by{y.by.made | x.by.made | bit, y.by.second | x.by.second};
        const Node minus_y = expression_.unary(Operation::Negate, y.node);
        const Node above = expression_.binary(Operation::Atan2, x.node, y.node);
        const Node below = expression_.binary(Operation::Atan2, x.node, minus_y);
        result.push_back(
            {expression_.binary(Operation::Subtract, expression_.constant(kQuarter), above), by});
        result.push_back({expression_.binary(Operation::Subtract, below, expression_.constant(kQuarter)),
                          {by.made, by.second | bit}});
      }
    }
    choices_.push_back(expression_.unary(Operation::Negate, step.a));
    return result;
  }

  std::vector<SmoothPart> chosen(const Expression::Step& step) {
    const ChoiceSet bit = ChoiceSet{1} << choices_.size();
    std::vector<SmoothPart> result;
    for (const SmoothPart& a : parts_[step.a]) {
      result.push_back({a.node, {a.by.made | bit, a.by.second}});
    }
    for (const SmoothPart& b : parts_[step.operation == Operation::Abs ? step.a : step.b]) {
      const Node node =
          step.operation == Operation::Abs ? expression_.unary(Operation::Negate, b.node) : b.node;
      result.push_back({node, {b.by.made | bit, b.by.second | bit}});
    }
    choices_.push_back(choice_function(step));
    return result;
  }

  /// A function that is zero or less where the first operand is chosen.
  Node choice_function(const Expression::Step& step) {
    if (step.operation == Operation::Abs) return expression_.unary(Operation::Negate, step.a);
    if (step.operation == Operation::Select) return step.c;
    const bool smaller = step.operation == Operation::Min;
    return expression_.binary(Operation::Subtract, smaller ? step.a : step.b, smaller ? step.b : step.a);
  }

  void find_borders(const Expression::Step& step) {
    switch (step.operation) {
      case Operation::Reciprocal:
      case Operation::Sqrt:
      case Operation::ConstantPower:
      case Operation::Log:
      case Operation::Power:
      case Operation::Atan2:
        return add_zeros_of(step.a);
      case Operation::Select:
        return add_zeros_of(step.c);
      case Operation::Divide:
        return add_zeros_of(step.b);
      case Operation::Asin:
      case Operation::Acos:
        add_zeros_of(expression_.binary(Operation::Add, step.a, expression_.constant(1.0)));
        return add_zeros_of(expression_.binary(Operation::Subtract, step.a, expression_.constant(1.0)));
      case Operation::Tan:
        return add_zeros_of(expression_.unary(Operation::Cos, step.a));
      default:
        return;
    }
  }

  /// A product is zero where a factor is; a square only touches zero where its root goes through it.
  void add_zeros_of(Node node) {
    const Expression::Step step = expression_.steps()[node];
    switch (step.operation) {
      case Operation::Multiply:
        add_zeros_of(step.b);
        [[fallthrough]];
      case Operation::Negate:
      case Operation::Scale:
      case Operation::IntegerPower:
      case Operation::SizePower:
      case Operation::OddPower:
      case Operation::Sqrt:
      case Operation::ConstantPower:
        return add_zeros_of(step.a);
      case Operation::Constant:
        return;
      default:
        break;
    }
    if (node >= parts_.size() || parts_[node].empty()) return add_border(node);
    for (const SmoothPart& part : parts_[node]) add_border(part.node);
  }

  void add_border(Node node) {
    if (too_many_borders()) return;
    for (const Node side : {node, expression_.unary(Operation::Negate, node)}) {
      if (std::find(borders_.begin(), borders_.end(), side) == borders_.end()) borders_.push_back(side);
    }
  }

  Expression& expression_;
  const Node root_;
  std::vector<std::vector<SmoothPart>> parts_;  // of each step up to the root
  std::vector<Node> choices_, borders_;
};

/// One piece for each function; functions that do not depend on x, y or z have no surface.
base::Result<std::vector<FormulaPieces::Piece>> pieces_of(const Expression& expression,
                                                          const std::vector<SmoothPart>& parts) {
  std::vector<Node> nodes;
  std::vector<FormulaPieces::Piece> pieces;
  for (const SmoothPart& part : parts) {
    const auto known = std::find(nodes.begin(), nodes.end(), part.node);
    if (known == nodes.end()) {
      auto formula = Formula::compile(expression, part.node);
      if (!formula) return base::fail(formula.error().message);
      nodes.push_back(part.node);
      pieces.push_back({std::move(*formula), {part.by}});
    } else {
      pieces[std::size_t(known - nodes.begin())].cases.push_back(part.by);
    }
  }
  std::erase_if(pieces, [](const FormulaPieces::Piece& piece) { return !piece.formula.uses_place(); });
  return pieces;
}

base::Result<std::vector<Formula>> formulas_of(const Expression& expression, const std::vector<Node>& nodes) {
  std::vector<Formula> formulas;
  for (const Node node : nodes) {
    auto formula = Formula::compile(expression, node);
    if (!formula) return base::fail(formula.error().message);
    formulas.push_back(std::move(*formula));
  }
  return formulas;
}

}  // namespace

base::Result<FormulaPieces> FormulaPieces::parse(const std::string& text, Ends ends) {
  Expression expression;
  const auto root = read_formula(text, expression);
  if (!root) return base::fail(root.error().message);
  auto whole = Formula::compile(expression, *root);
  if (!whole) return base::fail(whole.error().message);
  FormulaSplitter splitter(expression, *root);
  splitter.run();
  if (ends == Ends::GoOn) splitter.go_on();
  if (splitter.too_many_borders())
    return base::fail("the formula has too many poles and edges of where it has values to follow them all.");
  auto pieces = pieces_of(expression, splitter.parts());
  auto choices = formulas_of(expression, splitter.choices());
  auto borders = formulas_of(expression, splitter.borders());
  if (!pieces) return base::fail(pieces.error().message);
  if (!choices) return base::fail(choices.error().message);
  if (!borders) return base::fail(borders.error().message);
  return FormulaPieces{std::move(*whole), std::move(*pieces), std::move(*choices), std::move(*borders)};
}

}  // namespace icome::geometry
