#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "interaction/operations/operation.h"

namespace icome::interaction {

/// Thinks of commands for all operations, whatever they are: names, kinds and ranges are what their
/// parameters say. Many make sense in the world as it is; the others must be refused.
class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed) : random_(seed) {}

  Value next(const Operation& operation, const world::World& world) {
    names_.clear();
    for (const auto& [id, object] : world.objects()) names_.push_back(fmt::format("#{}", id.value));
    std::ranges::sort(names_);  // as tables keep no order that could be repeated
    if (operation.name == "ffd" && !one_in(4)) return deformation();
    if (operation.name == "reshape" && !one_in(4)) return other_size();
    Value::Fields command{{"op", operation.name}};
    add_fields(operation.parameters, command);
    return command;
  }

 private:
  bool one_in(std::uint64_t count) { return random_.index(count) == 0; }
  template <typename Item>
  const Item& any(const std::vector<Item>& items) {
    return items[random_.index(items.size())];
  }

  /// One that makes sense, which chance alone hardly ever thinks of.
  Value deformation() {
    const auto move = [&]() -> Value {
      const auto place = [&] { return Value(double(random_.index(3))); };
      const auto way = [&] { return Value(random_.uniform(-0.1, 0.1)); };
      return Value::Fields{{"point", several(place, 3, 3)}, {"by", several(way, 3, 3)}};
    };
    const Value as_mesh = one_in(2);
    return Value::Fields{
        {"op", "ffd"}, {"object", object()}, {"moves", several(move, 1, 3)}, {"as_mesh", as_mesh}};
  }

  /// The same of a size that some shape has: chance alone names those of several.
  Value other_size() {
    static const std::vector<std::string> kSizes = {"radius", "height", "side", "tube", "segments"};
    const std::string name = any(kSizes);
    const Value size =
        name == "segments" ? Value(double(3 + random_.index(20))) : Value(random_.uniform(0.01, 1));
    return Value::Fields{{"op", "reshape"}, {"object", object()}, {name, size}};
  }

  void add_fields(const std::vector<Parameter>& parameters, Value::Fields& fields) {
    std::string choice;
    for (const Parameter& parameter : parameters) {
      const bool first = &parameter == &parameters.front();
      const bool is_choice = parameter.kind == ParameterKind::Choice;
      if (first && is_choice) choice = any(parameter.choices);
      const auto& only = parameter.only_for;
      if (!only.empty() && std::ranges::find(only, choice) == only.end()) continue;
      if (!(first && is_choice) && !parameter.required && !one_in(3)) continue;
      fields.emplace_back(parameter.name, first && is_choice ? Value(choice) : value(parameter));
    }
  }

  Value value(const Parameter& parameter) {
    switch (parameter.kind) {
      case ParameterKind::Flag:
        return one_in(2);
      case ParameterKind::Number:
        return number(parameter);
      case ParameterKind::Count:
        return count(parameter);
      case ParameterKind::Text:
        return text();
      case ParameterKind::Texts:
        return several([&] { return text(); }, 1, 3);
      case ParameterKind::Picture:
        return one_in(3) ? Value("missing.png") : Value("wood.png");
      case ParameterKind::Choice:
        return any(parameter.choices);
      case ParameterKind::Colour:
        return one_in(2) ? Value("#80ff00") : Value(Value::List{random_.uniform(), random_.uniform(), 0.5});
      case ParameterKind::Vector:
        return numbers(parameter, 3);
      case ParameterKind::Numbers:
        return falling(numbers(parameter, 2));
      case ParameterKind::Counts:
        return several([&] { return count(parameter); }, 1, 4);
      case ParameterKind::Points:
        return several([&] { return numbers(parameter, parameter.components); }, 2, 6);
      case ParameterKind::Object:
        return object();
      case ParameterKind::Objects:
        return one_in(4) ? object() : several([&] { return object(); }, 1, 4);
      case ParameterKind::Records:
        return several([&] { return record(parameter); }, 1, 3);
    }
    return {};
  }

  /// Of the size that modelling has, m, where that is in range; now and then at the ends of it.
  Value number(const Parameter& parameter) {
    const double low = std::max(parameter.least, -2.0);
    const double high = std::min(parameter.most, 2.0);
    if (low > high) return parameter.least > 2.0 ? parameter.least : parameter.most;
    if (one_in(30)) return low;
    return random_.uniform(low, high);
  }
  Value count(const Parameter& parameter) {
    const double low = std::isfinite(parameter.least) ? parameter.least : 0.0;
    return std::min(low + double(random_.index(6)), parameter.most);
  }
  Value numbers(const Parameter& parameter, std::size_t count) {
    return several([&] { return number(parameter); }, count, count);
  }
  /// From the largest, as coefficients that bound each other ask for.
  static Value falling(const Value& numbers) {
    Value::List list = *numbers.list();
    std::ranges::sort(list, [](const Value& a, const Value& b) { return *a.number() > *b.number(); });
    return list;
  }
  Value text() {
    static const std::vector<std::string> kTexts = {"name",  "wood", "rubber", "l", "r", "0",        "1",
                                                    "table", "#3",   "a/b\"c", "x", "",  "viscous:2"};
    return any(kTexts);
  }
  Value object() { return names_.empty() || one_in(50) ? Value("nobody") : Value(any(names_)); }
  Value record(const Parameter& parameter) {
    Value::Fields fields;
    add_fields(parameter.fields, fields);
    return fields;
  }
  template <typename Make>
  Value several(const Make& make, std::size_t least, std::size_t most) {
    Value::List list;
    const std::size_t count = least + random_.index(most - least + 1);
    for (std::size_t i = 0; i < count; ++i) list.push_back(make());
    return list;
  }

  base::Random random_;
  std::vector<std::string> names_;
};

}  // namespace icome::interaction
