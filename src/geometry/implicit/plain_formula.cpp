#include "geometry/implicit/plain_formula.h"

#include <muParser.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>

namespace icome::geometry {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The least or the greatest value, by `before`; an undefined one makes the result undefined.
template <typename Before>
double extreme(const double* values, int count, Before&& before) {
  double best = values[0];
  for (int i = 1; i < count; ++i) {
    if (std::isnan(values[i])) return kNoValue;
    if (before(values[i], best)) best = values[i];
  }
  return best;
}

double least_value(const double* values, int count) {
  return extreme(values, count, [](double a, double b) { return a < b; });
}
double greatest_value(const double* values, int count) {
  return extreme(values, count, [](double a, double b) { return a > b; });
}

/// Compares; an undefined operand makes the result undefined.
template <typename Compare>
double compared(double a, double b, Compare&& holds) {
  if (std::isnan(a) || std::isnan(b)) return kNoValue;
  return holds(a, b) ? 1.0 : 0.0;
}

/// The second operand matters only where the first does not decide.
double both(double a, double b) { return std::isnan(a) || a == 0.0 ? a : b; }
double either(double a, double b) { return std::isnan(a) || a != 0.0 ? a : b; }
double chosen_value(double condition, double a, double b) {
  if (std::isnan(condition)) return kNoValue;
  return condition != 0.0 ? a : b;
}

/// A parser and the numbers that its variables are bound to.
struct BoundParser {
  mu::Parser parser;
  double x = 0.0, y = 0.0, z = 0.0, t = 0.0;

  explicit BoundParser(const std::string& text) {
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineVar("z", &z);
    parser.DefineVar("t", &t);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    // The functions that muParser lacks, or by which it means something else.
    parser.DefineFun(
        "log", +[](double a) { return std::log(a); });
    parser.DefineFun(
        "hypot", +[](double a, double b) { return std::hypot(a, b); });
    parser.DefineFun(
        "pow", +[](double a, double b) { return std::pow(a, b); });
    parser.DefineFun("min", least_value);
    parser.DefineFun("max", greatest_value);
    define_operators();
    parser.SetExpr(text);
    parser.Eval();
  }

  /// muParser's own comparisons take undefined operands for false; it has all of its operators or none.
  void define_operators() {
    parser.EnableBuiltInOprt(false);
    parser.DefineOprt(
        "+", +[](double a, double b) { return a + b; }, mu::prADD_SUB);
    parser.DefineOprt(
        "-", +[](double a, double b) { return a - b; }, mu::prADD_SUB);
    parser.DefineOprt(
        "*", +[](double a, double b) { return a * b; }, mu::prMUL_DIV);
    parser.DefineOprt(
        "/", +[](double a, double b) { return a / b; }, mu::prMUL_DIV);
    parser.DefineOprt(
        "^", +[](double a, double b) { return std::pow(a, b); }, mu::prPOW, mu::oaRIGHT);
    parser.DefineOprt(
        "<", +[](double a, double b) { return compared(a, b, std::less<>()); }, mu::prCMP);
    parser.DefineOprt(
        "<=", +[](double a, double b) { return compared(a, b, std::less_equal<>()); }, mu::prCMP);
    parser.DefineOprt(
        ">", +[](double a, double b) { return compared(a, b, std::greater<>()); }, mu::prCMP);
    parser.DefineOprt(
        ">=", +[](double a, double b) { return compared(a, b, std::greater_equal<>()); }, mu::prCMP);
    parser.DefineOprt("&&", both, mu::prLAND);
    parser.DefineOprt("||", either, mu::prLOR);
    parser.DefineInfixOprt(
        "!", +[](double a) { return std::isnan(a) ? a : (a == 0.0 ? 1.0 : 0.0); }, mu::prINFIX);
    parser.DefineFun("if", chosen_value);
  }
};

}  // namespace

base::Result<PlainFormula> plain_formula(const std::string& text) {
  try {
    const auto bound = std::make_shared<BoundParser>(text);
    return [bound](const base::Vector3& point, double time) {
      bound->x = point.x();
      bound->y = point.y();
      bound->z = point.z();
      bound->t = time;
      return bound->parser.Eval();
    };
  } catch (const mu::ParserError& error) {
    return base::fail(error.GetMsg());
  }
}

}  // namespace icome::geometry
