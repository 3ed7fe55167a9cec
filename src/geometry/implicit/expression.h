#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace icome::geometry {

/// The operation of a step of a formula, on `a`, on `a` and `b`, or on `a` and a constant.
enum class Operation : std::uint8_t {
  Variable,  // x, y, z, t: number `a`
  Constant,
  Negate,
  AddConstant,
  Scale,
  IntegerPower,   // of `a`, the constant whole, 2 or more
  ConstantPower,  // of `a`, the constant not whole; undefined for a < 0
  SizePower,      // of |a|, the constant more than 1 and no even number: smooth where |a| has its crease
  OddPower,       // the same with the sign of `a`, the constant no odd number
  Reciprocal,
  Abs,
  Sqrt,
  Exp,
  Log,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Sinh,
  Cosh,
  Tanh,
  Wrap,  // `a` minus whole turns, so that it is between -pi and pi
  Sinc,  // sin(a) / a, and 1 where a = 0
  Add,   // from here on: of two or more operands
  Subtract,
  Multiply,
  Divide,
  Power,  // undefined for a < 0
  Atan2,
  Hypot,
  Min,
  Max,
  Select,  // of three: `a` where `c` is zero or less, `b` where it is more
};

inline bool is_binary(Operation operation) { return operation >= Operation::Add; }
inline bool is_ternary(Operation operation) { return operation == Operation::Select; }
/// Is it smooth only between places where it takes another operand, or another branch?
inline bool chooses(Operation operation) {
  return operation == Operation::Abs || operation == Operation::Min || operation == Operation::Max ||
         operation == Operation::Atan2 || operation == Operation::Select;
}
inline bool is_leaf(Operation operation) { return operation <= Operation::Constant; }

/// A formula while it is read: a graph of operations in which equal parts are one, constants are folded,
/// and products of equal factors are powers (whose range is known better). Forms that only seem to have an
/// end, a crease or a gap are rewritten: sqrt(a^2) is |a|, |a|^1.5 has no crease, sin(a)/a no gap; and
/// sqrt(a^2 + b^2) is hypot(a, b). Operands stand before the steps that use them.
class Expression {
 public:
  using Node = std::uint32_t;
  struct Step {
    Operation operation;
    Node a, b;        // operands; 0 where there is none
    double constant;  // 0 where there is none
    Node c = 0;       // of Select
    bool operator==(const Step&) const = default;
  };

  Node variable(std::uint32_t number);
  Node constant(double value);
  Node unary(Operation operation, Node a);
  /// An operation on two operands; also Power with a constant exponent.
  Node binary(Operation operation, Node a, Node b);
  /// `a` where `condition` is zero or less, `b` where it is more; undefined where `condition` is.
  Node select(Node condition, Node a, Node b);
  /// The operation of `step`, which is no Select, on other operands (`b` counts where it has two).
  Node rebuilt(const Step& step, Node a, Node b);
  /// |a|^exponent, the exponent more than 0.
  Node size_power(Node a, double exponent);
  /// The sign of `a`, times |a|^exponent, the exponent more than 1.
  Node odd_power(Node a, double exponent);

  /// A quotient, by its parts: factor * over / under. quotient() gives nothing where a node is none.
  struct Quotient {
    Node over, under;
    double factor;
  };
  std::optional<Quotient> quotient(Node a);

  /// Is the step asin, acos or atan of a sine, cosine or tangent, which it takes back, or the angle of a
  /// quotient? Such a `step` is smooth except at places where it turns, or jumps.
  bool takes_back(const Step& step);

  const std::vector<Step>& steps() const { return steps_; }
  /// The reason why a part of constants has no value ("sqrt(-1) is not a finite number"); else empty.
  const std::string& fault() const { return fault_; }
  void forget_fault() { fault_.clear(); }

 private:
  struct Hash {
    std::size_t operator()(const Step& step) const;
  };
  bool is_constant(Node a) const { return steps_[a].operation == Operation::Constant; }
  double value(Node a) const { return steps_[a].constant; }
  Node shared(const Step& step);
  Node folded(Operation operation, Node a, Node b);
  Node negated(Node a);
  Node sum(Node a, double constant);
  Node scaled(Node a, double factor);
  Node added(Node a, Node b);
  Node subtracted(Node a, Node b);
  Node multiplied(Node a, Node b);
  Node divided(Node a, Node b);
  std::optional<Node> sinc(Node a, Node b);
  std::pair<Node, double> factored(Node a) const;
  Node raised(Node a, Node b);
  Node raised(Node a, double exponent);

  std::vector<Step> steps_;
  std::unordered_map<Step, Node, Hash> known_;
  std::string fault_;
};

}  // namespace icome::geometry
