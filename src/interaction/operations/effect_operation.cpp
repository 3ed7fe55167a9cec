#include <fmt/format.h>

#include <memory>
#include <utility>

#include "haptics/effects/effect_text.h"
#include "interaction/operations/effect_making.h"
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

}  // namespace

base::Result<world::FixturePointer> make_effect_fixture(const std::string& text, bool on) {
  if (const auto made = haptics::make_effect(text); !made)
    return base::fail(fmt::format("\"{}\": {}", text, made.error().message));
  return std::make_shared<const world::Fixture>(world::ForceEffect{text, on});
}

std::vector<Operation> effect_operations() {
  std::vector<Parameter> placed = force_parameters();
  for (Parameter& placement : placement_parameters()) placed.push_back(std::move(placement));
  return {{"effect", "Effect", "Effect", "Makes an effect: a force on the hand that comes from no surface.",
           std::move(placed), plan_effect}};
}

}  // namespace icome::interaction
