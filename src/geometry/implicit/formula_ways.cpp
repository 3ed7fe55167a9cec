#include "geometry/implicit/formula_ways.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace icome::geometry {
namespace {

using Node = Expression::Node;

constexpr std::size_t kMostWays = 256;
constexpr std::size_t kMostTerms = 64;
constexpr const char* kTooManyWays =
    "its abs, min, max, if, atan2, atan(a/b), asin(sin(a)) and the like have too many combinations";

/// The least, over the ways, of the greatest of some smooth functions.
using MinMax = std::vector<std::vector<Node>>;

bool is_rising(Operation operation) {
  switch (operation) {
    case Operation::AddConstant:
    case Operation::Sqrt:
    case Operation::Exp:
    case Operation::Log:
    case Operation::Asin:
    case Operation::Atan:
    case Operation::Sinh:
    case Operation::Tanh:
      return true;
    default:
      return false;
  }
}

/// Takes an expression apart; every function of this class gives nothing where the result gets too large, or
/// where a choice is made within a function that neither rises nor falls with it.
class MinMaxSplitter {
 public:
  explicit MinMaxSplitter(Expression& expression) : expression_(expression) {}

  std::optional<MinMax> split(Node node) {
    const Expression::Step step = expression_.steps()[node];
    if (is_leaf(step.operation)) return MinMax{{node}};
    if (expression_.takes_back(step)) return std::nullopt;
    const auto a = split(step.a);
    const auto b = is_binary(step.operation) ? split(step.b) : a;
    if (!a || !b) return std::nullopt;
    if (is_smooth(*a) && is_smooth(*b) && !chooses(step.operation)) return MinMax{{node}};
    switch (step.operation) {
      case Operation::Min:
        return joined(*a, *b);
      case Operation::Max:
        return cut(*a, *b, [](std::vector<Node> one, const std::vector<Node>& other) {
          one.insert(one.end(), other.begin(), other.end());
          return one;
        });
      case Operation::Abs: {
        const auto below = negated(*a);
        if (!below) return std::nullopt;
        return cut(*a, *below, [](std::vector<Node> one, const std::vector<Node>& other) {
          one.insert(one.end(), other.begin(), other.end());
          return one;
        });
      }
      case Operation::Negate:
        return negated(*a);
      case Operation::Add:
        return sum(*a, *b);
      case Operation::Subtract: {
        const auto below = negated(*b);
        return below ? sum(*a, *below) : std::nullopt;
      }
      case Operation::Scale:
        if (step.constant >= 0.0) return mapped(step, *a);
        if (const auto below = negated(*a)) return mapped({step.operation, 0, 0, -step.constant}, *below);
        return std::nullopt;
      default:
        return is_rising(step.operation) ? std::optional(mapped(step, *a)) : std::nullopt;
    }
  }

 private:
  static bool is_smooth(const MinMax& of) { return of.size() == 1 && of.front().size() == 1; }

  static std::optional<MinMax> checked(MinMax result) {
    for (std::vector<Node>& way : result) {
      std::sort(way.begin(), way.end());
      way.erase(std::unique(way.begin(), way.end()), way.end());
      if (way.size() > kMostTerms) return std::nullopt;
    }
    if (result.size() > kMostWays) return std::nullopt;
    return result;
  }

  static std::optional<MinMax> joined(MinMax a, const MinMax& b) {
    a.insert(a.end(), b.begin(), b.end());
    return checked(std::move(a));
  }

  template <typename Combine>
  static std::optional<MinMax> cut(const MinMax& a, const MinMax& b, Combine&& combine) {
    if (a.size() * b.size() > kMostWays) return std::nullopt;
    MinMax result;
    for (const std::vector<Node>& one : a) {
      for (const std::vector<Node>& other : b) result.push_back(combine(one, other));
    }
    return checked(std::move(result));
  }

  std::optional<MinMax> sum(const MinMax& a, const MinMax& b) {
    return cut(a, b, [&](const std::vector<Node>& one, const std::vector<Node>& other) {
      std::vector<Node> sums;
      for (const Node p : one) {
        for (const Node q : other) sums.push_back(expression_.binary(Operation::Add, p, q));
      }
      return sums;
    });
  }

  MinMax mapped(const Expression::Step& step, MinMax of) {
    for (std::vector<Node>& way : of) {
      for (Node& node : way) node = expression_.rebuilt(step, node, node);
    }
    return of;
  }

  /// The negation: the greatest of the least of the negated functions, multiplied out.
  std::optional<MinMax> negated(const MinMax& of) {
    std::optional<MinMax> result = MinMax{{}};
    for (const std::vector<Node>& way : of) {
      MinMax below;
      for (const Node node : way) below.push_back({expression_.unary(Operation::Negate, node)});
      result = cut(*result, below, [](std::vector<Node> one, const std::vector<Node>& other) {
        one.insert(one.end(), other.begin(), other.end());
        return one;
      });
      if (!result) return std::nullopt;
    }
    return result;
  }

  Expression& expression_;
};

/// Makes a way of each combination of choices.
base::Result<FormulaWays> by_choices(const std::string& text) {
  auto read = FormulaPieces::parse(text);
  if (!read) return base::fail(read.error().message);
  FormulaWays result;
  for (FormulaPieces::Piece& piece : read->pieces) {
    for (const FormulaPieces::Case& by : piece.cases) {
      std::vector<FormulaWays::Term> way{
          {read->choices.size() + std::size_t(&piece - read->pieces.data()), 1.0}};
      for (std::size_t i = 0; i < read->choices.size(); ++i) {
        const FormulaPieces::ChoiceSet bit = FormulaPieces::ChoiceSet{1} << i;
        if ((by.made & bit) != 0) way.push_back({i, (by.second & bit) != 0 ? -1.0 : 1.0});
      }
      result.ways.push_back(std::move(way));
    }
  }
  result.formulas = std::move(read->choices);
  for (FormulaPieces::Piece& piece : read->pieces) result.formulas.push_back(std::move(piece.formula));
  const auto smooth = [](const Formula& formula) { return formula.is_smooth(); };
  if (!std::all_of(result.formulas.begin(), result.formulas.end(), smooth)) return base::fail(kTooManyWays);
  return result;
}

}  // namespace

base::Result<FormulaWays> FormulaWays::parse(const std::string& text) {
  Expression expression;
  const auto root = read_formula(text, expression);
  if (!root) return base::fail(root.error().message);
  const auto split = MinMaxSplitter(expression).split(*root);
  if (!split || !expression.fault().empty()) return by_choices(text);
  FormulaWays result;
  std::vector<Node> nodes;
  for (const std::vector<Node>& way : *split) {
    std::vector<FormulaWays::Term> terms;
    for (const Node node : way) {
      const auto known = std::find(nodes.begin(), nodes.end(), node);
      terms.push_back({std::size_t(known - nodes.begin()), 1.0});
      if (known != nodes.end()) continue;
      nodes.push_back(node);
      auto formula = Formula::compile(expression, node);
      if (!formula) return base::fail(formula.error().message);
      result.formulas.push_back(std::move(*formula));
    }
    result.ways.push_back(std::move(terms));
  }
  return result;
}

}  // namespace icome::geometry
