#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "geometry/algebra/interval.h"
#include "geometry/algebra/jet.h"
#include "geometry/implicit/expression.h"

namespace icome::geometry {

/// A formula f(x, y, z, t), compiled to a short program without branches that runs on numbers, on numbers
/// with their derivatives (automatic differentiation), and on intervals. Immutable; all evaluation is
/// real-time safe.
///
/// It may use the numbers pi and e; + - * / ^ and parentheses (-x^2 is -(x^2), x^y^z is x^(y^z)); sin cos
/// tan asin acos atan atan2(y, x) sinh cosh tanh exp log ln (both to the base e) log10 sqrt abs hypot pow
/// min max (the last two of any number of values), and if(condition, a, b). Conditions are comparisons by <
/// <= > >=, combined by &&, ||, ! and parentheses; && binds before ||, and the second operand of either
/// does not matter where the first decides. Undefined operations give NaN, and NaN stays, except in the
/// operand that an if does not take.
class Formula {
 public:
  static constexpr std::size_t kMostCharacters = 16384;
  static constexpr std::size_t kMostSteps = 4096;
  static constexpr std::size_t kMostRegisters = 128;

  /// Fails with a sentence that names the column.
  static base::Result<Formula> parse(const std::string& text);
  /// Compiles the expression at `root`; fails if that takes more steps or registers than are allowed.
  static base::Result<Formula> compile(const Expression& expression, Expression::Node root);

  double value(const base::Vector3& point, double time) const;

  struct Slope {
    double value;
    base::Vector3 gradient;  // with respect to x, y, z
    double rate;             // df/dt
  };
  Slope slope(const base::Vector3& point, double time) const;

  struct Bend {
    double value;
    base::Vector3 gradient;
    base::Matrix3 hessian;
  };
  Bend bend(const base::Vector3& point, double time) const;

  struct LineSlope {
    double value;
    double slope;  // df/ds
  };
  /// f and its slope at `start` + s * `step`.
  LineSlope on_line(const base::Vector3& start, const base::Vector3& step, double s, double time) const;

  /// The range of f in a part of space, or on a line or a patch.
  struct Range {
    Interval value;
    bool total;  // surely defined, continuous and finite everywhere there
    bool never;  // surely defined nowhere there
  };
  using Box4 = std::array<Interval, 4>;  // of x, y, z, t
  Range range(const Box4& box) const;

  template <int Variables>
  struct SlopeRange {
    Range range;
    std::array<Interval, Variables> slope;  // f's derivatives; where `total`, f obeys the mean value theorem
  };
  /// The ranges of f and of its derivatives with respect to x, y, z.
  SlopeRange<3> slope_range(const Box4& box) const;
  struct BendRange {
    Range range;
    std::array<Interval, 3> slope;
    std::array<Interval, 6> bend;  // second derivatives: xx, xy, xz, yy, yz, zz
  };
  /// The ranges of f and of its first and second derivatives with respect to x, y, z.
  BendRange bend_range(const Box4& box) const;
  /// The ranges of f and of its derivative at `start` + s * `step`, with respect to s.
  SlopeRange<1> line_range(const base::Vector3& start, const base::Vector3& step, const Interval& s,
                           double time) const;
  Range point_range(const base::Vector3& start, const base::Vector3& step, double s, double time) const;
  /// The ranges of f and of its derivatives at `origin` + p * `u` + q * `v`, with respect to p and q.
  SlopeRange<2> patch_range(const base::Vector3& origin, const base::Vector3& u, const base::Vector3& v,
                            const Interval& p, const Interval& q, double time) const;

  /// Does it depend on x, y or z? On t?
  bool uses_place() const { return used_[0] || used_[1] || used_[2]; }
  bool uses_time() const { return used_[3]; }
  /// Has it neither abs, min, max nor if, and so no creases but where its derivatives are unbounded?
  bool is_smooth() const;
  std::size_t steps() const { return program_.size(); }
  std::size_t bytes() const { return sizeof(*this) + program_.capacity() * sizeof(Instruction); }

 private:
  struct Instruction {
    Operation operation;
    std::uint16_t to, a, b, c;  // registers; the first four hold x, y, z, t
    double constant;
  };
  template <typename Number>
  using Registers = std::array<Number, kMostRegisters>;

  Formula() = default;
  template <typename Scalar, int Variables, int Order>
  Jet<Scalar, Variables, Order> run(Registers<Jet<Scalar, Variables, Order>>& registers) const;
  template <int Variables, int Order>
  Jet<Interval, Variables, Order> run_watched(Registers<Jet<Interval, Variables, Order>>& registers,
                                              Range& range) const;

  std::vector<Instruction> program_;
  std::uint16_t result_ = 0;  // register
  std::array<bool, 4> used_{};
};

/// Reads `text`, of at most Formula::kMostCharacters, into an expression and gives its root. Fails with a
/// sentence that names the column.
base::Result<Expression::Node> read_formula(const std::string& text, Expression& expression);

}  // namespace icome::geometry
