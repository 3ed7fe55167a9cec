#include "apps/stats/stats_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace icome::apps {

/// Converts a value for the library that writes it.
struct StatsJson::Writer {
  using Written = nlohmann::ordered_json;

  template <typename Plain>
  Written operator()(const Plain& value) const {
    return value;
  }
  Written operator()(const Array& elements) const {
    Written written = Written::array();
    for (const StatsJson& element : elements) written.push_back(std::visit(*this, element.value_));
    return written;
  }
  Written operator()(const Object& members) const {
    Written written = Written::object();
    for (const Member& member : members) written[member.key] = std::visit(*this, member.value.value_);
    return written;
  }
};

StatsJson::StatsJson() : value_(nullptr) {}
StatsJson::StatsJson(const StatsJson& other) = default;
StatsJson::StatsJson(StatsJson&& other) noexcept = default;
StatsJson& StatsJson::operator=(const StatsJson& other) = default;
StatsJson& StatsJson::operator=(StatsJson&& other) noexcept = default;
StatsJson::~StatsJson() = default;

StatsJson::StatsJson(std::nullptr_t) : value_(nullptr) {}
StatsJson::StatsJson(bool value) : value_(value) {}
StatsJson::StatsJson(double value) : value_(value) {}
StatsJson::StatsJson(const char* text) : value_(std::string(text)) {}
StatsJson::StatsJson(std::string text) : value_(std::move(text)) {}
StatsJson::StatsJson(std::initializer_list<double> numbers) : value_(Array(numbers.begin(), numbers.end())) {}
StatsJson::StatsJson(std::initializer_list<Member> members) : value_(Object(members)) {}

StatsJson StatsJson::array() {
  StatsJson json;
  json.value_ = Array{};
  return json;
}

StatsJson StatsJson::object() {
  StatsJson json;
  json.value_ = Object{};
  return json;
}

StatsJson& StatsJson::operator[](const std::string& key) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object{};
  Object& members = std::get<Object>(value_);
  const auto found = std::ranges::find(members, key, &Member::key);
  if (found != members.end()) return found->value;
  members.push_back({key, StatsJson()});
  return members.back().value;
}

// Not inlined: where GCC 12 sees which alternative of a variant is moved, it warns that the others were never
// set.
[[gnu::noinline]] void StatsJson::push_back(StatsJson element) {
  std::get<Array>(value_).push_back(std::move(element));
}

void StatsJson::append(const StatsJson& object) {
  for (const Member& member : std::get<Object>(object.value_)) (*this)[member.key] = member.value;
}

std::string StatsJson::text() const {
  const Writer::Written written = std::visit(Writer(), value_);
  return written.dump(2, ' ', false, Writer::Written::error_handler_t::replace) + "\n";
}

}  // namespace icome::apps
