#include "geometry/formula_pieces.h"

#include <algorithm>
#include <numbers>

namespace icome::geometry {
namespace {

using Node = Expression::Node;
using Case = FormulaPieces::Case;
using ChoiceSet = FormulaPieces::ChoiceSet;

constexpr std::size_t kMostBorders = 512;
constexpr std::size_t kMostCases = 256;  // of one part of a formula
constexpr std::size_t kMostChoices = 64;

/// What a part of a formula is where choices were made so.
struct SmoothPart {
  Node node;
  Case by;
};

/// Do both make the choices that they share alike?
bool agree(const Case& one, const Case& other) {
  return (one.made & other.made & (one.second ^ other.second)) == 0;
}

/// Takes an expression apart, step by step, operands first.
class FormulaSplitter {
 public:
  FormulaSplitter(Expression& expression, Node root) : expression_(expression), root_(root) {}

  void run() {
    const std::vector<Expression::Step> steps = expression_.steps();
    const std::vector<bool> used = used_steps(steps);
    parts_.resize(root_ + 1);
    for (Node i = 0; i <= root_; ++i) {
      if (!used[i]) continue;
      parts_[i] = parts_of(i, steps[i]);
      find_borders(steps[i]);
      if (too_many_borders()) return;
    }
  }

  const std::vector<SmoothPart>& parts() const { return parts_[root_]; }
  const std::vector<Node>& choices() const { return choices_; }
  const std::vector<Node>& borders() const { return borders_; }
  bool too_many_borders() const { return borders_.size() > kMostBorders; }

 private:
  std::vector<bool> used_steps(const std::vector<Expression::Step>& steps) const {
    std::vector<bool> used(steps.size(), false);
    used[root_] = true;
    for (Node i = root_ + 1; i-- > 0;) {
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
    if (chooses(step.operation) && choices_.size() == kMostChoices) return as_it_is;
    std::vector<SmoothPart> parts = step.operation == Operation::Atan2 ? angles(step)
                                    : chooses(step.operation)          ? chosen(step)
                                                                       : combined(step);
    return parts.size() > kMostCases ? as_it_is : parts;
  }

  std::vector<SmoothPart> combined(const Expression::Step& step) {
    std::vector<SmoothPart> result;
    const bool binary = is_binary(step.operation);
    for (const SmoothPart& a : parts_[step.a]) {
      for (const SmoothPart& b : binary ? parts_[step.b] : std::vector{a}) {
        if (!agree(a.by, b.by)) continue;
        expression_.forget_fault();
        const Node node = expression_.rebuilt(step, a.node, b.node);
        // Without a value, as sqrt(min(x, -1)) where the choice is -1, it has no surface.
        if (!expression_.fault().empty()) continue;
        result.push_back({node, {a.by.made | b.by.made, a.by.second | b.by.second}});
        if (result.size() > kMostCases) return result;
      }
    }
    return result;
  }

  /// atan2(y, x) where y is zero or more, and where it is less: turned by a quarter so that what jumps is on
  /// the other side.
  std::vector<SmoothPart> angles(const Expression::Step& step) {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
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

  /// Zero or less where the first operand is chosen.
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

  /// A product is zero where a factor is, and a square does not go through zero where its root does.
  void add_zeros_of(Node node) {
    const Expression::Step step = expression_.steps()[node];
    switch (step.operation) {
      case Operation::Multiply:
        add_zeros_of(step.b);
        [[fallthrough]];
      case Operation::Negate:
      case Operation::Scale:
      case Operation::IntegerPower:
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

/// One piece for each function; what does not depend on x, y or z has no surface.
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

base::Result<FormulaPieces> FormulaPieces::parse(const std::string& text) {
  Expression expression;
  const auto root = read_formula(text, expression);
  if (!root) return base::fail(root.error().message);
  auto whole = Formula::compile(expression, *root);
  if (!whole) return base::fail(whole.error().message);
  FormulaSplitter splitter(expression, *root);
  splitter.run();
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
