#include "geometry/plain_formula.h"

#include <muParser.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace icome::geometry {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The least or the greatest, by `before`; one that is undefined makes the whole undefined.
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
    // Where muParser means something else or has no such function.
    parser.DefineFun(
        "log", +[](double a) { return std::log(a); });
    parser.DefineFun(
        "hypot", +[](double a, double b) { return std::hypot(a, b); });
    parser.DefineFun(
        "pow", +[](double a, double b) { return std::pow(a, b); });
    parser.DefineFun("min", least_value);
    parser.DefineFun("max", greatest_value);
    parser.SetExpr(text);
    parser.Eval();
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
