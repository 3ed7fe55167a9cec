#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/shown_text.h"
#include "haptics/effects/effect_text.h"
#include "interaction/operations/looks/effect_making.h"
#include "interaction/operations/operation.h"
#include "interaction/operations/placement.h"

namespace icome::interaction {
namespace {

base::Result<Plan> plan_effect(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto fixture = make_effect_fixture(arguments.text("force"), arguments.flag("on"));
  if (!fixture) return tl::unexpected(fixture.error());
  world::EditGroup group;
  auto object = placed_object(world, arguments, "effect", ids, group);
  if (!object) return tl::unexpected(object.error());
  object->fixture = std::move(*fixture);
  const auto id = ids.next<world::ObjectId>();
  group.edits.push_back(create_last(world, id, std::move(*object)));
  return Plan{std::move(group), {id}};
}

std::vector<Parameter> force_parameters() {
  std::string kinds;
  for (const haptics::EffectKind& kind : haptics::effect_kinds())
    kinds += fmt::format("{}{}:{}", kinds.empty() ? "" : ", ", kind.name, kind.usage);
  return {{.name = "force",
           .kind = ParameterKind::Text,
           .meaning = "what it does, its numbers in m and N in its own frame: one of " + kinds,
           .required = true},
          {.name = "on", .kind = ParameterKind::Flag, .meaning = "is it felt?", .fallback = true}};
}

std::string_view kind_of_effect(std::string_view text) { return text.substr(0, text.find(':')); }

/// The range of such a number that suits hands and desktop devices.
std::pair<double, double> usual_range(const haptics::EffectNumber& number) {
  struct Usual {
    std::string_view unit;
    double most;
  };
  constexpr std::array<Usual, 7> kUsual = {Usual{"m", 0.1}, {"N", 5.0},    {"N/m", 2000.0}, {"N s/m", 20.0},
                                           {"kg", 1.0},     {"Hz", 200.0}, {"", 1.0}};
  const auto* const usual = std::ranges::find(kUsual, number.unit, &Usual::unit);
  const double most = usual == kUsual.end() ? number.most : usual->most;
  return {std::max(number.least, -most), std::min(number.most, most)};
}

}  // namespace

std::string trouble_with_effect(const std::string& text) {
  const auto made = haptics::make_effect(text);
  return made ? std::string() : made.error().message;
}

base::Result<world::FixturePointer> make_effect_fixture(const std::string& text, bool on) {
  if (const std::string trouble = trouble_with_effect(text); !trouble.empty())
    return base::fail(fmt::format("\"{}\": {}", base::shown_text(text), trouble));
  return std::make_shared<const world::Fixture>(world::ForceEffect{text, on});
}

const std::vector<EffectDial>& effect_dials() {
  static const std::vector<EffectDial> kDials = [] {
    std::vector<EffectDial> dials;
    for (const haptics::EffectKind& kind : haptics::effect_kinds()) {
      std::size_t index = 0;
      for (const haptics::EffectNumber& it : haptics::effect_numbers(kind.example)) {
        const auto [least, most] = usual_range(it);
        dials.push_back({std::string(kind.name), std::string(it.name), std::string(it.unit), index++,
                         it.least, it.most, least, most});
      }
    }
    return dials;
  }();
  return kDials;
}

std::optional<double> dial_value(const EffectDial& dial, const std::string& text) {
  if (kind_of_effect(text) != dial.kind) return std::nullopt;
  const auto numbers = haptics::effect_numbers(text);
  return dial.index < numbers.size() ? std::optional(numbers[dial.index].value) : std::nullopt;
}

std::string with_dial(const EffectDial& dial, const std::string& text, double value) {
  std::vector<double> numbers;
  for (const haptics::EffectNumber& it : haptics::effect_numbers(text)) numbers.push_back(it.value);
  numbers[dial.index] = value;
  return haptics::effect_of_numbers(dial.kind, numbers);
}

std::vector<Operation> effect_operations() {
  std::vector<Parameter> placed = force_parameters();
  for (Parameter& parameter : rigid_placement_parameters()) placed.push_back(std::move(parameter));
  return {{"effect", "Effect", "Effect", "Makes an effect: a force on the hand that comes from no surface.",
           std::move(placed), plan_effect}};
}

}  // namespace icome::interaction
