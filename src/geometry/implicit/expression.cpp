#include "geometry/implicit/expression.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <utility>

#include "geometry/algebra/jet.h"

namespace icome::geometry {
namespace {

const char* name_of(Operation operation) {
  switch (operation) {
    case Operation::Abs:
      return "abs";
    case Operation::Sqrt:
      return "sqrt";
    case Operation::Exp:
      return "exp";
    case Operation::Log:
      return "log";
    case Operation::Sin:
      return "sin";
    case Operation::Cos:
      return "cos";
    case Operation::Tan:
      return "tan";
    case Operation::Asin:
      return "asin";
    case Operation::Acos:
      return "acos";
    case Operation::Atan:
      return "atan";
    case Operation::Sinh:
      return "sinh";
    case Operation::Cosh:
      return "cosh";
    case Operation::Tanh:
      return "tanh";
    case Operation::Add:
      return "+";
    case Operation::Subtract:
      return "-";
    case Operation::Multiply:
      return "*";
    case Operation::Divide:
      return "/";
    case Operation::Power:
      return "^";
    case Operation::Atan2:
      return "atan2";
    case Operation::Hypot:
      return "hypot";
    case Operation::Min:
      return "min";
    case Operation::Max:
      return "max";
    default:
      return "";
  }
}

std::string written(Operation operation, double a, double b) {
  const std::string name = name_of(operation);
  if (!is_binary(operation)) return fmt::format("{}({})", name, a);
  if (name.size() == 1) return fmt::format("{} {} {}", a, name, b);
  return fmt::format("{}({}, {})", name, a, b);
}

bool is_even(double exponent) { return std::fmod(exponent, 2.0) == 0.0; }

bool commutes(Operation operation) {
  return operation == Operation::Add || operation == Operation::Multiply || operation == Operation::Min ||
         operation == Operation::Max || operation == Operation::Hypot;
}

}  // namespace

std::size_t Expression::Hash::operator()(const Step& step) const {
  std::uint64_t hash = static_cast<std::uint64_t>(step.operation);
  for (const std::uint64_t part : {std::uint64_t{step.a}, std::uint64_t{step.b}, std::uint64_t{step.c},
                                   std::bit_cast<std::uint64_t>(step.constant)}) {
    hash = (hash ^ part) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

Expression::Node Expression::shared(const Step& step) {
  const auto [found, is_new] = known_.try_emplace(step, static_cast<Node>(steps_.size()));
  if (is_new) steps_.push_back(step);
  return found->second;
}

Expression::Node Expression::variable(std::uint32_t number) {
  return shared({Operation::Variable, number, 0, 0.0});
}

Expression::Node Expression::constant(double value) {
  return shared({Operation::Constant, 0, 0, value + 0.0});  // no -0: it would differ from 0
}

Expression::Node Expression::folded(Operation operation, Node a, Node b) {
  using Number = Jet<double, 0, 0>;
  const double first = value(a), second = is_binary(operation) ? value(b) : 0.0;
  const double result = compute(operation, 0.0, Number{first, {}, {}}, Number{second, {}, {}}).value;
  if (!std::isfinite(result) && fault_.empty()) {
    fault_ = fmt::format("{} is not a finite number", written(operation, first, second));
  }
  return constant(std::isfinite(result) ? result : 0.0);
}

Expression::Node Expression::unary(Operation operation, Node a) {
  if (operation == Operation::Negate) return negated(a);
  if (is_constant(a)) return folded(operation, a, a);
  if (operation == Operation::Sqrt) return raised(a, 0.5);
  return shared({operation, a, 0, 0.0});
}

Expression::Node Expression::binary(Operation operation, Node a, Node b) {
  // A base is folded with a whole exponent below: the step Power has no values for negative bases.
  if (is_constant(a) && is_constant(b) && operation != Operation::Power) return folded(operation, a, b);
  switch (operation) {
    case Operation::Add:
      return added(a, b);
    case Operation::Subtract:
      return subtracted(a, b);
    case Operation::Multiply:
      return multiplied(a, b);
    case Operation::Divide:
      return divided(a, b);
    case Operation::Power:
      return raised(a, b);
    case Operation::Min:
    case Operation::Max:
      if (a == b) return a;
      break;
    default:
      break;
  }
  if (commutes(operation) && b < a) std::swap(a, b);
  return shared({operation, a, b, 0.0});
}

Expression::Node Expression::select(Node condition, Node a, Node b) {
  if (a == b) return a;
  if (is_constant(condition)) return value(condition) <= 0.0 ? a : b;
  return shared({Operation::Select, a, b, 0.0, condition});
}

Expression::Node Expression::rebuilt(const Step& step, Node a, Node b) {
  switch (step.operation) {
    case Operation::AddConstant:
      return is_constant(a) ? constant(value(a) + step.constant) : sum(a, step.constant);
    case Operation::Scale:
      return is_constant(a) ? constant(value(a) * step.constant) : scaled(a, step.constant);
    case Operation::IntegerPower:
    case Operation::ConstantPower:
      return raised(a, step.constant);
    case Operation::SizePower:
      return size_power(a, step.constant);
    case Operation::OddPower:
      return odd_power(a, step.constant);
    default:
      return is_binary(step.operation) ? binary(step.operation, a, b) : unary(step.operation, a);
  }
}

Expression::Node Expression::negated(Node a) {
  if (is_constant(a)) return constant(-value(a));
  const Step step = steps_[a];
  if (step.operation == Operation::Negate) return step.a;
  if (step.operation == Operation::Scale) return scaled(step.a, -step.constant);
  return shared({Operation::Negate, a, 0, 0.0});
}

Expression::Node Expression::sum(Node a, double constant) {
  const Step step = steps_[a];
  if (step.operation == Operation::AddConstant) return sum(step.a, step.constant + constant);
  return constant == 0.0 ? a : shared({Operation::AddConstant, a, 0, constant});
}

Expression::Node Expression::scaled(Node a, double factor) {
  const Step step = steps_[a];
  if (factor == 0.0) return constant(0.0);
  if (factor == 1.0) return a;
  if (step.operation == Operation::Scale) return scaled(step.a, step.constant * factor);
  if (step.operation == Operation::Negate) return scaled(step.a, -factor);
  if (factor == -1.0) return negated(a);
  return shared({Operation::Scale, a, 0, factor});
}

Expression::Node Expression::added(Node a, Node b) {
  if (is_constant(a)) return sum(b, value(a));
  if (is_constant(b)) return sum(a, value(b));
  if (a == b) return scaled(a, 2.0);
  if (steps_[b].operation == Operation::Negate) return subtracted(a, steps_[b].a);
  if (steps_[a].operation == Operation::Negate) return subtracted(b, steps_[a].a);
  if (b < a) std::swap(a, b);
  return shared({Operation::Add, a, b, 0.0});
}

Expression::Node Expression::subtracted(Node a, Node b) {
  if (is_constant(b)) return sum(a, -value(b));
  if (is_constant(a)) return sum(negated(b), value(a));
  if (a == b) return constant(0.0);
  if (steps_[b].operation == Operation::Negate) return added(a, steps_[b].a);
  return shared({Operation::Subtract, a, b, 0.0});
}

Expression::Node Expression::multiplied(Node a, Node b) {
  if (is_constant(a)) return scaled(b, value(a));
  if (is_constant(b)) return scaled(a, value(b));
  const auto base_and_exponent = [&](Node node) {
    const Step step = steps_[node];
    return step.operation == Operation::IntegerPower ? std::pair(step.a, step.constant)
                                                     : std::pair(node, 1.0);
  };
  const auto [first, first_exponent] = base_and_exponent(a);
  const auto [second, second_exponent] = base_and_exponent(b);
  if (first == second) return raised(first, first_exponent + second_exponent);
  if (b < a) std::swap(a, b);
  return shared({Operation::Multiply, a, b, 0.0});
}

Expression::Node Expression::divided(Node a, Node b) {
  if (is_constant(b)) {
    if (value(b) == 0.0 && fault_.empty()) fault_ = "a division by 0 is not a finite number";
    return scaled(a, 1.0 / value(b));
  }
  if (is_constant(a)) return scaled(unary(Operation::Reciprocal, b), value(a));
  if (const auto quotient = sinc(a, b)) return *quotient;
  return shared({Operation::Divide, a, b, 0.0});
}

/// A node without its constant factor, and that factor.
std::pair<Expression::Node, double> Expression::factored(Node a) const {
  const Step& step = steps_[a];
  if (step.operation == Operation::Scale) return {step.a, step.constant};
  if (step.operation == Operation::Negate) return {step.a, -1.0};
  return {a, 1.0};
}

/// The quotient of a sine and of its angle, each with any factor; nothing for other quotients.
std::optional<Expression::Node> Expression::sinc(Node a, Node b) {
  const auto [sine, over] = factored(a);
  if (steps_[sine].operation != Operation::Sin) return std::nullopt;
  const Node angle = steps_[sine].a;
  const auto [whole, turns] = factored(angle);
  const auto [length, under] = factored(b);
  if (whole != length) return std::nullopt;
  return scaled(unary(Operation::Sinc, angle), over * turns / under);
}

std::optional<Expression::Quotient> Expression::quotient(Node a) {
  double factor = 1.0;
  for (Node at = a;;) {
    const Step step = steps_[at];
    switch (step.operation) {
      case Operation::Scale:
      case Operation::Negate:
        factor *= factored(at).second;
        at = step.a;
        break;
      case Operation::Divide:
        return Quotient{step.a, step.b, factor};
      case Operation::Reciprocal:
        return Quotient{constant(1.0), step.a, factor};
      default:
        return std::nullopt;
    }
  }
}

bool Expression::takes_back(const Step& step) {
  if (is_leaf(step.operation)) return false;
  const Operation inner = steps_[step.a].operation;
  switch (step.operation) {
    case Operation::Asin:
    case Operation::Acos:
      return inner == Operation::Sin || inner == Operation::Cos;
    case Operation::Atan:
      return inner == Operation::Tan || quotient(step.a).has_value();
    default:
      return false;
  }
}

Expression::Node Expression::raised(Node a, Node b) {
  if (is_constant(b)) return raised(a, value(b));
  if (is_constant(a) && value(a) > 0.0) {
    return unary(Operation::Exp, scaled(b, std::log(value(a))));
  }
  return shared({Operation::Power, a, b, 0.0});
}

Expression::Node Expression::raised(Node a, double exponent) {
  if (is_constant(a)) {
    const double result = std::pow(value(a), exponent);
    if (!std::isfinite(result) && fault_.empty()) {
      fault_ = fmt::format("{} ^ {} is not a finite number", value(a), exponent);
    }
    return constant(result);
  }
  if (exponent == 0.0) return constant(1.0);
  if (exponent == 1.0) return a;
  if (exponent < 0.0) return unary(Operation::Reciprocal, raised(a, -exponent));
  const bool whole = exponent == std::floor(exponent);
  const Step base = steps_[a];
  if (base.operation == Operation::Abs && exponent > 1.0) return size_power(base.a, exponent);
  if (base.operation == Operation::SizePower) return size_power(base.a, base.constant * exponent);
  if (base.operation == Operation::IntegerPower && is_even(base.constant) && !whole)
    return size_power(base.a, base.constant * exponent);
  if (exponent == 0.5 && base.operation == Operation::Add) {
    const Step one = steps_[base.a], other = steps_[base.b];
    const auto is_square = [](const Step& it) {
      return it.operation == Operation::IntegerPower && it.constant == 2.0;
    };
    if (is_square(one) && is_square(other)) return binary(Operation::Hypot, one.a, other.a);
  }
  if (exponent == 0.5) return shared({Operation::Sqrt, a, 0, 0.0});
  return shared({whole ? Operation::IntegerPower : Operation::ConstantPower, a, 0, exponent});
}

Expression::Node Expression::size_power(Node a, double exponent) {
  if (is_constant(a)) return raised(constant(std::fabs(value(a))), exponent);
  if (is_even(exponent)) return raised(a, exponent);
  if (exponent > 1.0) return shared({Operation::SizePower, a, 0, exponent});
  return raised(unary(Operation::Abs, a), exponent);
}

Expression::Node Expression::odd_power(Node a, double exponent) {
  if (is_constant(a)) {
    const Node size = raised(constant(std::fabs(value(a))), exponent);
    return value(a) < 0.0 ? negated(size) : size;
  }
  if (is_even(exponent + 1.0)) return raised(a, exponent);
  return shared({Operation::OddPower, a, 0, exponent});
}

}  // namespace icome::geometry
