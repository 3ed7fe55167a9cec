#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/time_budget.h"

namespace icome::files {

/// A .csg text parsed into statements `name(arguments) { children }`, in the order of the text, whatever
/// the names mean. All parts lie in flat arrays, so that nothing recurses however deep the text nests.
/// Refers to the text, which must outlive it.
class CsgDocument {
 public:
  using Index = std::uint32_t;
  /// A byte of the text; the text is shorter than 4 GiB.
  using Offset = std::uint32_t;

  enum class Kind : std::uint8_t { Undefined, Boolean, Number, String, Vector };
  struct Value {
    double number = 0.0;  // of a Number; of a Boolean 0 or 1; of a Vector the index past its last element
    Offset offset = 0;
    Kind kind = Kind::Undefined;
  };
  struct Argument {
    Offset name = 0;
    std::uint16_t name_length = 0;  // 0: given by position
    Index value = 0;
  };
  enum Modifier : std::uint8_t { Disabled = 1, Background = 2, Highlight = 4, Root = 8 };
  struct Statement {
    Offset offset = 0;
    std::uint16_t name_length = 0;
    std::uint8_t modifiers = 0;  // Modifiers put together
    Index first_argument = 0;    // they end where those of the next statement begin
    Index end = 0;               // past the last statement inside this one
  };

  /// Parses the text. The error names `name`, line and column, and what was expected there. Fails also when
  /// the time budget ends.
  static base::Result<CsgDocument> parse(std::string_view text, const std::string& name,
                                         io::TimeBudget& time_budget);

  const std::vector<Statement>& statements() const { return statements_; }
  const std::vector<Argument>& arguments() const { return arguments_; }
  const Value& value(Index index) const { return values_[index]; }
  /// The index past the value and, for a vector, all its elements.
  Index value_end(Index index) const;
  Index arguments_end(Index statement) const;

  std::string_view name(const Statement& statement) const;
  std::string_view name(const Argument& argument) const;
  /// The characters of a String, with its escapes replaced.
  std::string string(const Value& value) const;

  /// The line of an offset, counted from 1.
  std::size_t line(Offset offset) const { return 1 + line_breaks(0, offset); }
  std::size_t line_breaks(Offset from, Offset to) const;
  /// The error "cup.csg:3:14: " and the message; columns count characters from 1.
  base::Error error_at(Offset offset, const std::string& message) const;

 private:
  friend class CsgParser;
  CsgDocument(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  std::string_view text_;
  std::string name_;
  std::vector<Statement> statements_;
  std::vector<Argument> arguments_;
  std::vector<Value> values_;
};

/// "a number", "a vector" and so on, for messages.
const char* kind_name(CsgDocument::Kind kind);

}  // namespace icome::files
