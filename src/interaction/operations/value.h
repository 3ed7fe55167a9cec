#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"

namespace icome::interaction {

/// The value of a parameter of an operation: anything that JSON can say. A plain value.
class Value {
 public:
  using List = std::vector<Value>;
  /// Named values, in the order in which they were written; no name twice.
  using Fields = std::vector<std::pair<std::string, Value>>;

  Value() = default;  // nothing: null
  // Not explicit: commands are written as they are read.
  Value(bool flag) : what_(flag) {}                      // NOLINT(google-explicit-constructor)
  Value(double number) : what_(number) {}                // NOLINT(google-explicit-constructor)
  Value(int number) : what_(double(number)) {}           // NOLINT(google-explicit-constructor)
  Value(std::string text) : what_(std::move(text)) {}    // NOLINT(google-explicit-constructor)
  Value(const char* text) : what_(std::string(text)) {}  // NOLINT(google-explicit-constructor)
  Value(List list) : what_(std::move(list)) {}           // NOLINT(google-explicit-constructor)
  Value(Fields fields) : what_(std::move(fields)) {}     // NOLINT(google-explicit-constructor)

  bool is_null() const { return what_.index() == 0; }
  const bool* flag() const { return std::get_if<bool>(&what_); }
  const double* number() const { return std::get_if<double>(&what_); }
  const std::string* text() const { return std::get_if<std::string>(&what_); }
  const List* list() const { return std::get_if<List>(&what_); }
  const Fields* fields() const { return std::get_if<Fields>(&what_); }

  bool operator==(const Value&) const = default;

 private:
  std::variant<std::monostate, bool, double, std::string, List, Fields> what_;
};

/// The longest text that is read as one value, bytes: a lattice or a selection of a million vertices.
inline constexpr std::size_t kLongestValue = 64U << 20U;

/// Reads one JSON document. Fails with the place for text that is no JSON or too long, that nests more than a
/// hundred deep, names a field twice or more than 256 in one object, or has numbers that do not fit a double.
base::Result<Value> value_from_json(std::string_view text);

/// One line of JSON. Numbers come back to the last bit, bytes that are no UTF-8 as a replacement
/// character; numbers that are not finite, which JSON does not know, as null.
std::string json_from_value(const Value& value);

/// The field of that name; null where there is none.
const Value* field(const Value::Fields& fields, std::string_view name);

}  // namespace icome::interaction
