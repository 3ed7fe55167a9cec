#pragma once
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace icome::geometry {

/// What a step of a formula computes, from `a`, from `a` and `b`, or from `a` and a constant.
enum class Operation : std::uint8_t {
  Variable,  // x, y, z, t: number `a`
  Constant,
  Negate,
  AddConstant,
  Scale,
  IntegerPower,   // of `a`, the constant whole, 2 or more
  ConstantPower,  // of `a`, the constant not whole; undefined for a < 0
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
  Add,  // from here on of two or more
  Subtract,
  Multiply,
  Divide,
  Power,  // undefined for a < 0
  Atan2,
  Hypot,
  Min,
  Max,
  Select,  // of three: where `c` is zero or less `a`, where it is more `b`
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
/// and products of equal factors are powers (whose range is known better). Operands stand before what is
/// made of them.
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
  /// Also Power with a constant exponent.
  Node binary(Operation operation, Node a, Node b);
  /// Where `condition` is zero or less `a`, where it is more `b`; undefined where it is.
  Node select(Node condition, Node a, Node b);
  /// What `step`, no Select, computes of other operands (`b` counts where it has two).
  Node rebuilt(const Step& step, Node a, Node b);

  const std::vector<Step>& steps() const { return steps_; }
  /// Why a part that consists of constants has no value ("sqrt(-1) is not a finite number"); else empty.
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
  Node raised(Node a, Node b);
  Node raised(Node a, double exponent);

  std::vector<Step> steps_;
  std::unordered_map<Step, Node, Hash> known_;
  std::string fault_;
};

}  // namespace icome::geometry
