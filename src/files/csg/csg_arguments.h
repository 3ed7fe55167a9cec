#pragma once
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/csg/csg_document.h"

namespace icome::files {

/// The arguments of one statement, by name. The first failure is kept: from then on nothing is found,
/// and error() says what and where. So a shape may read all its arguments and check once.
class CsgArguments {
 public:
  /// `names` are those that the statement takes, in the order of arguments without a name. Special variables
  /// may always be given, but only $fn is kept. Other names, and one given twice, are failures.
  CsgArguments(const CsgDocument& document, CsgDocument::Index statement,
               std::initializer_list<std::string_view> names);

  /// The value's index; nothing when it is not given or undef.
  std::optional<CsgDocument::Index> find(std::string_view name) const;
  std::optional<double> number(std::string_view name);
  double number_or(std::string_view name, double fallback) { return number(name).value_or(fallback); }
  /// False when not given.
  bool flag(std::string_view name);
  /// The numbers of a vector of `Count` of them; `what` names it in errors: "a point".
  template <std::size_t Count>
  std::array<double, Count> numbers(CsgDocument::Index vector, const char* what) {
    std::array<double, Count> found{};
    read_numbers(vector, found.data(), Count, what);
    return found;
  }
  /// Number of elements of the vector.
  std::size_t length(CsgDocument::Index vector) const;

  void fail(CsgDocument::Index value, const std::string& message);
  /// Fails with "`expected`, but there is a string".
  void fail_kind(CsgDocument::Index value, const std::string& expected);
  bool failed() const { return !error_.message.empty(); }
  const base::Error& error() const { return error_; }

 private:
  void bind(const CsgDocument::Argument& argument, std::string_view name);
  std::string taken(std::initializer_list<std::string_view> names) const;
  void read_numbers(CsgDocument::Index vector, double* numbers, std::size_t count, const char* what);

  const CsgDocument& document_;
  std::string_view statement_name_;
  // Few: a handful of arguments and special variables.
  std::vector<std::pair<std::string_view, CsgDocument::Index>> values_;
  base::Error error_;
};

}  // namespace icome::files
