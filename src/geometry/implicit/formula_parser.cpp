#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParserBase.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numbers>
#include <vector>

#include "base/parse_number.h"
#include "geometry/implicit/formula.h"

// muParser reads the text: it knows precedence and tells where something is wrong. But it computes numbers,
// and the operations behind them are needed. So its own operators and functions are left out, and ours are
// put in their place, whose "values" are the numbers of nodes of an expression. Evaluated once, it has
// built the expression. Its optimiser would fold those values and is off.

namespace icome::geometry {
namespace {

using ReadNode = Expression::Node;

/// The condition of an if. Other conditions in it are given by their numbers, and come before it.
struct IfCondition {
  enum class Kind { NotAbove, Not, And, Or };
  Kind kind;
  std::uint32_t a, b = 0;  // NotAbove: is the node `a` zero or less? Else numbers of conditions
};

/// The place in which the operators of the parser on this thread build their expression. muParser's
/// operators and literals carry no user data.
struct FormulaSite {
  Expression* expression;
  const char* literal_too_large = nullptr;  // its place in the text
  std::vector<IfCondition> conditions = {};
  const char* misuse = nullptr;  // of a condition, or of a value in place of one
};
thread_local FormulaSite* current_site = nullptr;

/// Makes `site` the current one while it lives.
class AtSite {
 public:
  explicit AtSite(FormulaSite& site) { current_site = &site; }
  ~AtSite() { current_site = nullptr; }
  AtSite(const AtSite&) = delete;
  AtSite& operator=(const AtSite&) = delete;
};

void note_misuse(const char* what) {
  if (current_site->misuse == nullptr) current_site->misuse = what;
}

// Nodes are 0 and more, conditions are -1 and less.
double as_value(ReadNode node) { return node; }
ReadNode as_node(double value) {
  if (value >= 0.0) return static_cast<ReadNode>(value);
  note_misuse("a comparison makes sense as the condition of if(...) only");
  return current_site->expression->constant(0.0);
}

double as_value(const IfCondition& condition) {
  current_site->conditions.push_back(condition);
  return -static_cast<double>(current_site->conditions.size());
}

std::uint32_t as_condition(double value) {
  if (value < 0.0) return static_cast<std::uint32_t>(-value) - 1;
  note_misuse("if(...), &&, || and ! take comparisons, such as x < y");
  return as_condition(as_value(IfCondition{IfCondition::Kind::NotAbove, as_node(value)}));
}

/// Is `a` no greater than `b`?
double not_greater(double a, double b) {
  const ReadNode difference = current_site->expression->binary(Operation::Subtract, as_node(a), as_node(b));
  return as_value(IfCondition{IfCondition::Kind::NotAbove, difference});
}

double not_step(double a) { return as_value(IfCondition{IfCondition::Kind::Not, as_condition(a)}); }
double less_equal_step(double a, double b) { return not_greater(a, b); }
double greater_equal_step(double a, double b) { return not_greater(b, a); }
double less_step(double a, double b) { return not_step(not_greater(b, a)); }
double greater_step(double a, double b) { return not_step(not_greater(a, b)); }

template <IfCondition::Kind kKind>
double joined_step(double a, double b) {
  return as_value(IfCondition{kKind, as_condition(a), as_condition(b)});
}

/// `a` where the condition holds, else `b`: one Select for each comparison that decides it.
ReadNode selected_node(std::uint32_t number, ReadNode a, ReadNode b) {
  const IfCondition condition = current_site->conditions[number];
  switch (condition.kind) {
    case IfCondition::Kind::Not:
      return selected_node(condition.a, b, a);
    case IfCondition::Kind::And:
      return selected_node(condition.a, selected_node(condition.b, a, b), b);
    case IfCondition::Kind::Or:
      return selected_node(condition.a, a, selected_node(condition.b, a, b));
    default:
      return current_site->expression->select(condition.a, a, b);
  }
}

double if_step(double condition, double a, double b) {
  const ReadNode first = as_node(a), second = as_node(b);
  return as_value(selected_node(as_condition(condition), first, second));
}

template <Operation kOperation>
double unary_step(double a) {
  return as_value(current_site->expression->unary(kOperation, as_node(a)));
}

template <Operation kOperation>
double binary_step(double a, double b) {
  return as_value(current_site->expression->binary(kOperation, as_node(a), as_node(b)));
}

template <Operation kOperation>
double many_step(const double* values, int count) {
  ReadNode result = as_node(values[0]);
  for (int i = 1; i < count; ++i) {
    result = current_site->expression->binary(kOperation, result, as_node(values[i]));
  }
  return as_value(result);
}

double plus_sign(double a) { return a; }

double log10_step(double a) {
  Expression& expression = *current_site->expression;
  const ReadNode natural = expression.unary(Operation::Log, as_node(a));
  return as_value(expression.binary(Operation::Multiply, natural, expression.constant(std::numbers::log10e)));
}

/// Reads a number at `text`: its node and the position behind it. Returns 1, or 0 where there is none.
int read_literal(const char* text, int* position, double* value) {
  const bool digit = text[0] >= '0' && text[0] <= '9';
  const bool point = text[0] == '.' && text[1] >= '0' && text[1] <= '9';
  if (!digit && !point) return 0;
  const auto read = base::number_at_front<double>(text);
  if (!read.good() && current_site->literal_too_large == nullptr) current_site->literal_too_large = text;
  *position += static_cast<int>(read.rest.data() - text);
  *value = as_value(current_site->expression->constant(read.value));
  return 1;
}

constexpr std::array<const char*, 21> kFunctions{"abs", "acos",  "asin", "atan", "atan2", "cos",   "cosh",
                                                 "exp", "hypot", "if",   "ln",   "log",   "log10", "max",
                                                 "min", "pow",   "sin",  "sinh", "sqrt",  "tan",   "tanh"};

class FormulaParser : public mu::ParserBase {
 public:
  explicit FormulaParser(Expression& expression) {
    EnableBuiltInOprt(false);
    EnableOptimizer(false);
    InitCharSets();
    InitOprt();
    InitFun();
    AddValIdent(read_literal);
    const std::array<const char*, 4> variables{"x", "y", "z", "t"};
    for (std::uint32_t i = 0; i < 4; ++i) DefineConst(variables[i], as_value(expression.variable(i)));
    DefineConst("pi", as_value(expression.constant(std::numbers::pi)));
    DefineConst("e", as_value(expression.constant(std::numbers::e)));
  }

 protected:
  void InitCharSets() override {  // NOLINT(readability-identifier-naming): muParser's name
    DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*/^<>=&|");
    DefineInfixOprtChars("+-!");
  }
  void InitOprt() override {  // NOLINT(readability-identifier-naming)
    DefineOprt("+", binary_step<Operation::Add>, mu::prADD_SUB);
    DefineOprt("-", binary_step<Operation::Subtract>, mu::prADD_SUB);
    DefineOprt("*", binary_step<Operation::Multiply>, mu::prMUL_DIV);
    DefineOprt("/", binary_step<Operation::Divide>, mu::prMUL_DIV);
    DefineOprt("^", binary_step<Operation::Power>, mu::prPOW, mu::oaRIGHT);
    DefineOprt("<", less_step, mu::prCMP);
    DefineOprt("<=", less_equal_step, mu::prCMP);
    DefineOprt(">", greater_step, mu::prCMP);
    DefineOprt(">=", greater_equal_step, mu::prCMP);
    DefineOprt("&&", joined_step<IfCondition::Kind::And>, mu::prLAND);
    DefineOprt("||", joined_step<IfCondition::Kind::Or>, mu::prLOR);
    DefineInfixOprt("!", not_step, mu::prINFIX, false);
    DefineInfixOprt("-", unary_step<Operation::Negate>, mu::prINFIX, false);
    DefineInfixOprt("+", plus_sign, mu::prINFIX, false);
  }
  void InitFun() override {  // NOLINT(readability-identifier-naming)
    DefineFun("abs", unary_step<Operation::Abs>, false);
    DefineFun("acos", unary_step<Operation::Acos>, false);
    DefineFun("asin", unary_step<Operation::Asin>, false);
    DefineFun("atan", unary_step<Operation::Atan>, false);
    DefineFun("cos", unary_step<Operation::Cos>, false);
    DefineFun("cosh", unary_step<Operation::Cosh>, false);
    DefineFun("exp", unary_step<Operation::Exp>, false);
    DefineFun("if", if_step, false);
    DefineFun("ln", unary_step<Operation::Log>, false);
    DefineFun("log", unary_step<Operation::Log>, false);
    DefineFun("sin", unary_step<Operation::Sin>, false);
    DefineFun("sinh", unary_step<Operation::Sinh>, false);
    DefineFun("sqrt", unary_step<Operation::Sqrt>, false);
    DefineFun("tan", unary_step<Operation::Tan>, false);
    DefineFun("tanh", unary_step<Operation::Tanh>, false);
    DefineFun("log10", log10_step, false);
    DefineFun("atan2", binary_step<Operation::Atan2>, false);
    DefineFun("hypot", binary_step<Operation::Hypot>, false);
    DefineFun("pow", binary_step<Operation::Power>, false);
    DefineFun("min", many_step<Operation::Min>, false);
    DefineFun("max", many_step<Operation::Max>, false);
  }
  void InitConst() override {}  // NOLINT(readability-identifier-naming)
};

std::string at_column(std::ptrdiff_t position, const std::string& complaint) {
  return fmt::format("formula, column {}: {}", position + 1, complaint);
}

/// The complaint about a character that has no meaning in formulas here, or cannot be shown; else empty.
std::string wrong_character(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter || (c != '\0' && std::strchr("_.,+-*/^<>=&|!() \t\r\n", c) != nullptr)) continue;
    const bool printable = c > 0x20 && c < 0x7f;
    return at_column(static_cast<std::ptrdiff_t>(i),
                     printable ? fmt::format("'{}' has no meaning in a formula", c)
                               : std::string("there is a character that is not plain text"));
  }
  return {};
}

/// A part of the text that was not understood, shortened for a message.
std::string shown(std::string token) {
  while (!token.empty() && token.back() == ' ') token.pop_back();
  constexpr std::size_t kMost = 40;
  return token.size() > kMost ? token.substr(0, kMost) + "..." : token;
}

std::string unknown(const std::string& token) {
  if (token.empty() || std::strchr("+-*/^<>=&|", token[0]) != nullptr) {
    return fmt::format("a value is missing before \"{}\"", token);
  }
  for (const char* function : kFunctions) {
    if (token == function) return fmt::format("\"{0}\" takes its values in parentheses: {0}(...)", token);
  }
  return fmt::format("\"{}\" is unknown; known are x, y, z, t, pi, e, {}", token,
                     fmt::join(kFunctions, ", "));
}

std::string explain(const mu::ParserError& error, const std::string& text) {
  const std::string token = shown(error.GetToken());
  const auto end = static_cast<std::ptrdiff_t>(text.size());
  const auto here = [&](const std::string& complaint) {
    return at_column(std::min<std::ptrdiff_t>(error.GetPos(), end), complaint);
  };
  switch (error.GetCode()) {
    case mu::ecEMPTY_EXPRESSION:
      return "the formula is empty: write one such as x^2 + y^2 + z^2 - 0.05^2";
    case mu::ecUNEXPECTED_EOF:
      return at_column(end, "the formula ends too early");
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecINVALID_NAME:
      return here(unknown(token));
    case mu::ecMISSING_PARENS:
      return here("a parenthesis is not closed");
    case mu::ecUNEXPECTED_PARENS:
      return here("this parenthesis has no counterpart or no content");
    case mu::ecTOO_FEW_PARAMS:
      return here(fmt::format("\"{}\" takes more values", token));
    case mu::ecTOO_MANY_PARAMS:
      return here(fmt::format("\"{}\" takes fewer values", token));
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG:
      return here("a comma makes sense between a function's values only");
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return here(fmt::format("an operator such as * is missing before \"{}\"", token));
    case mu::ecUNEXPECTED_OPERATOR:
      return here(fmt::format("a value is missing before \"{}\"", token));
    default:
      return here(fmt::format("\"{}\" is not expected here", token));
  }
}

/// Position of the first comma outside all parentheses.
std::size_t bare_comma(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] == ',' && depth == 0) return i;
  }
  return text.size();
}

}  // namespace

base::Result<ReadNode> read_formula(const std::string& text, Expression& expression) {
  if (text.size() > Formula::kMostCharacters) {
    return base::fail(fmt::format("the formula is {} characters long: at most {} can be read", text.size(),
                                  Formula::kMostCharacters));
  }
  if (std::string complaint = wrong_character(text); !complaint.empty()) {
    return base::fail(std::move(complaint));
  }
  FormulaSite site{&expression};
  const AtSite here(site);
  ReadNode root = 0;
  try {
    FormulaParser parser(expression);
    parser.SetExpr(text);
    int results = 0;
    const double* values = parser.Eval(results);
    root = as_node(values[0]);
    if (site.misuse != nullptr) return base::fail(fmt::format("formula: {}", site.misuse));
    if (results != 1) {
      return base::fail(at_column(static_cast<std::ptrdiff_t>(bare_comma(text)),
                                  "a comma makes sense between a function's values only"));
    }
    if (site.literal_too_large != nullptr) {
      const std::string_view rest(site.literal_too_large);
      // muParser reads a copy of the text with a blank after it.
      const auto column = static_cast<std::ptrdiff_t>(text.size() + 1 - rest.size());
      return base::fail(at_column(column, "this number is too large or too small"));
    }
  } catch (const mu::ParserError& error) {
    return base::fail(explain(error, text));
  }
  if (!expression.fault().empty()) return base::fail("formula: " + expression.fault());
  return root;
}

}  // namespace icome::geometry
