#include "interaction/operations/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace icome::interaction {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDeepestValue = 100;
constexpr std::size_t kMostFields = 256;  // of one object: each is compared with those before it

/// Builds a value while the text is parsed, so that nothing nests deeper than this allows.
class ValueBuilder final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return put({}); }
  bool boolean(bool flag) override { return put(flag); }
  bool number_integer(number_integer_t number) override { return put(double(number)); }
  bool number_unsigned(number_unsigned_t number) override { return put(double(number)); }
  bool number_float(number_float_t number, const string_t&) override { return put(number); }
  bool string(string_t& text) override { return put(std::move(text)); }
  bool binary(binary_t& bytes) override { return fail(fmt::format("{} bytes", bytes.size())); }
  bool start_object(std::size_t) override { return open(Value::Fields()); }
  bool key(string_t& name) override {
    const auto& fields = std::get<Value::Fields>(open_.back().content);
    if (fields.size() == kMostFields) return fail(fmt::format("it names more than {} things", kMostFields));
    if (field(fields, name)) return fail(fmt::format("'{}' is named twice", name));
    open_.back().key = std::move(name);
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Value::List()); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow)
      return fail(fmt::format("the number that ends at character {} is too large", position));
    return fail(fmt::format("this is no JSON at character {}", position));
  }

  base::Result<Value> take() {
    if (!error_.empty()) return base::fail(error_);
    return std::move(root_);
  }

 private:
  struct Open {
    std::variant<Value::List, Value::Fields> content;
    std::string key = {};  // of the field that is being read
  };

  bool fail(std::string why) {
    error_ = std::move(why);
    return false;
  }
  bool put(Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (auto* list = std::get_if<Value::List>(&open_.back().content)) {
      list->push_back(std::move(value));
    } else {
      std::get<Value::Fields>(open_.back().content).emplace_back(open_.back().key, std::move(value));
    }
    return true;
  }
  bool open(std::variant<Value::List, Value::Fields> content) {
    if (open_.size() == kDeepestValue) return fail(fmt::format("it nests more than {} deep", kDeepestValue));
    open_.push_back({std::move(content)});
    return true;
  }
  bool close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    return put(std::visit([](auto& content) { return Value(std::move(content)); }, closed.content));
  }

  Value root_ = {};
  std::vector<Open> open_ = {};
  std::string error_ = {};
};

Json json_of(const Value& value) {
  if (const bool* flag = value.flag()) return *flag;
  if (const double* number = value.number()) {
    constexpr double kExactWhole = 9007199254740992.0;  // 2^53
    if (*number == std::floor(*number) && std::abs(*number) < kExactWhole) return std::int64_t(*number);
    return *number;
  }
  if (const std::string* text = value.text()) return *text;
  if (const Value::List* list = value.list()) {
    Json json = Json::array();
    for (const Value& item : *list) json.push_back(json_of(item));
    return json;
  }
  if (const Value::Fields* fields = value.fields()) {
    Json json = Json::object();
    for (const auto& [name, item] : *fields) json[name] = json_of(item);
    return json;
  }
  return nullptr;
}

}  // namespace

base::Result<Value> value_from_json(std::string_view text) {
  if (text.size() > kLongestValue)
    return base::fail(fmt::format("it is longer than {} MiB", kLongestValue >> 20U));
  ValueBuilder builder;
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string json_from_value(const Value& value) {
  return json_of(value).dump(-1, ' ', false, Json::error_handler_t::replace);
}

const Value* field(const Value::Fields& fields, std::string_view name) {
  const auto found = std::ranges::find(fields, name, &std::pair<std::string, Value>::first);
  return found == fields.end() ? nullptr : &found->second;
}

}  // namespace icome::interaction
