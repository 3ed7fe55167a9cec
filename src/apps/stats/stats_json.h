#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace icome::apps {

/// A JSON value that is being put together: members keep the order in which they were added.
class StatsJson {
 public:
  struct Member;

  // Defined in the source file, as they need the complete Member.
  StatsJson();
  StatsJson(const StatsJson& other);
  StatsJson(StatsJson&& other) noexcept;
  StatsJson& operator=(const StatsJson& other);
  StatsJson& operator=(StatsJson&& other) noexcept;
  ~StatsJson();

  StatsJson(std::nullptr_t);
  StatsJson(bool value);
  StatsJson(double value);  // null where it is not finite
  template <std::integral Number>
  StatsJson(Number value);
  StatsJson(const char* text);
  StatsJson(std::string text);
  template <typename Element>
  StatsJson(const std::vector<Element>& elements);
  /// An array of numbers.
  StatsJson(std::initializer_list<double> numbers);
  /// An object.
  StatsJson(std::initializer_list<Member> members);

  static StatsJson array();
  static StatsJson object();

  /// The member of an object, created if it is missing. A null becomes an object.
  StatsJson& operator[](const std::string& key);
  /// Adds an element to an array.
  void push_back(StatsJson element);
  /// Adds the members of another object.
  void append(const StatsJson& object);
  /// The text on several lines; bytes that are not UTF-8 become a mark.
  std::string text() const;

 private:
  struct Writer;
  using Array = std::vector<StatsJson>;
  using Object = std::vector<Member>;
  std::variant<std::nullptr_t, bool, double, std::int64_t, std::string, Array, Object> value_;
};

struct StatsJson::Member {
  std::string key;
  StatsJson value;
};

template <std::integral Number>
StatsJson::StatsJson(Number value) : value_(static_cast<std::int64_t>(value)) {}

template <typename Element>
StatsJson::StatsJson(const std::vector<Element>& elements)
    : value_(Array(elements.begin(), elements.end())) {}

}  // namespace icome::apps
