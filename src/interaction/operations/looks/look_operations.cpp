#include <fmt/format.h>

#include <algorithm>

#include "haptics/effects/texture_text.h"
#include "interaction/operations/looks/material_edits.h"
#include "interaction/operations/looks/material_library.h"
#include "interaction/operations/operation.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using world::Material;
using world::ObjectId;
using world::World;

Result<Plan> plan_change(const World& world, const Arguments& arguments, const MaterialChange& change,
                         world::IdSource& ids) {
  auto objects = with_shapes(world, arguments.objects("objects"));
  if (!objects) return tl::unexpected(objects.error());
  world::Edit edit = change_materials(world, *objects, change, ids);
  return Plan{std::move(edit), std::move(*objects)};
}

// ---- Colour and feel ----------------------------------------------------------------------------------

Result<Plan> plan_colour(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const world::Colour colour = arguments.colour("colour");
  const auto change = [colour](Material& material) { material.diffuse = colour; };
  return plan_change(world, arguments, {change, "colour", arguments.flag("shared")}, ids);
}

/// "bumps:0.0003,0.003", "bumps" in its usual size, or empty for smooth.
Result<std::string> texture_text(const Arguments& arguments) {
  const std::string& name = arguments.text("texture");
  const bool sized = arguments.has("depth") || arguments.has("spacing");
  if (sized && !(arguments.has("depth") && arguments.has("spacing")))
    return fail("'depth' and 'spacing' of a texture go together");
  if (name == "smooth") return sized ? Result<std::string>(fail("what is smooth has no 'depth'")) : "";
  if (!sized) return name;
  std::string text = fmt::format("{}:{},{}", name, arguments.number("depth"), arguments.number("spacing"));
  if (const auto made = haptics::make_texture(text); !made) return fail(made.error().message);
  return text;
}

Result<world::TouchProperties> felt_then(const Arguments& arguments, world::TouchProperties touch) {
  if (arguments.has("stiffness")) touch.stiffness = arguments.number("stiffness");
  if (arguments.has("damping")) touch.damping = arguments.number("damping");
  if (arguments.has("texture")) {
    auto texture = texture_text(arguments);
    if (!texture) return tl::unexpected(texture.error());
    touch.texture = std::move(*texture);
  }
  if (!arguments.has("friction")) return touch;
  const std::vector<double> friction = arguments.numbers("friction");
  if (friction.size() != 2 || friction[0] < friction[1])
    return fail(
        "'friction' must be two numbers, that of rest and that of sliding, which is no more: "
        "[0.4, 0.3]");
  touch.static_friction = friction[0];
  touch.dynamic_friction = friction[1];
  return touch;
}

Result<Plan> plan_feel(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto is_given = [&](const char* name) { return arguments.has(name); };
  if (!is_given("texture") && (is_given("depth") || is_given("spacing")))
    return fail("'depth' and 'spacing' belong to a 'texture': say which");
  if (!is_given("stiffness") && !is_given("damping") && !is_given("friction") && !is_given("texture"))
    return fail("say how it feels: 'stiffness', 'damping', 'friction', 'texture' or several");
  if (const auto good = felt_then(arguments, {}); !good) return tl::unexpected(good.error());
  const auto change = [&](Material& material) { material.touch = *felt_then(arguments, material.touch); };
  return plan_change(world, arguments, {change, "feel", arguments.flag("shared")}, ids);
}

// ---- Material -----------------------------------------------------------------------------------------

Result<Plan> plan_material(const World& world, const Arguments& arguments, world::IdSource& ids) {
  auto objects = with_shapes(world, arguments.objects("objects"));
  if (!objects) return tl::unexpected(objects.error());
  auto material = chosen_material(world, arguments.text("name"), ids);
  if (!material) return tl::unexpected(material.error());
  for (const ObjectId id : *objects)
    material->creation.edits.emplace_back(world::ChooseMaterial{id, material->id});
  return Plan{std::move(material->creation), std::move(*objects)};
}

Parameter shaped_objects() {
  return {.name = "objects",
          .kind = ParameterKind::Objects,
          .meaning = "which ones; a group stands for all below it",
          .required = true};
}

Parameter shared_parameter() {
  return {.name = "shared",
          .kind = ParameterKind::Flag,
          .meaning = "also for others that have the same material; else these get one of their own",
          .fallback = false};
}

Operation colour_operation() {
  return {"colour",
          "Colour",
          "Look",
          "Gives objects a colour.",
          {shaped_objects(),
           {.name = "colour",
            .kind = ParameterKind::Colour,
            .meaning = "as displays show it (sRGB)",
            .required = true},
           shared_parameter()},
          plan_colour};
}

Operation material_operation() {
  return {"material",
          "Material",
          "Look",
          "Makes objects of a material, for eye and hand.",
          {shaped_objects(),
           {.name = "name", .kind = ParameterKind::Text, .meaning = material_meaning(), .required = true}},
          plan_material};
}

Operation feel_operation() {
  std::vector<std::string> textures{"smooth"};
  textures.insert(textures.end(), haptic_texture_names().begin(), haptic_texture_names().end());
  return {"feel",
          "Feel",
          "Look",
          "Says how objects feel; what is not said stays.",
          {shaped_objects(),
           {.name = "stiffness",
            .kind = ParameterKind::Number,
            .meaning = "N/m; devices render 500 to 4,000 well",
            .least = 0.0,
            .most = 1e6},
           {.name = "damping",
            .kind = ParameterKind::Number,
            .meaning = "N s/m, usually 0.5 to 20",
            .least = 0.0,
            .most = 1e4},
           {.name = "friction",
            .kind = ParameterKind::Numbers,
            .meaning = "the coefficients of rest and of sliding, which is no more; wood has [0.4, 0.3]",
            .least = 0.0,
            .most = 10.0},
           {.name = "texture",
            .kind = ParameterKind::Choice,
            .meaning = "the relief that is felt",
            .choices = std::move(textures)},
           {.name = "depth",
            .kind = ParameterKind::Number,
            .meaning = "of the texture, m; at most half of its spacing",
            .least = 0.0,
            .most = 0.01},
           {.name = "spacing",
            .kind = ParameterKind::Number,
            .meaning = "of the texture's waves, bumps or grains, m",
            .least = 1e-5,
            .most = 1.0},
           shared_parameter()},
          plan_feel};
}

}  // namespace

std::vector<Operation> look_operations() {
  return {colour_operation(), material_operation(), feel_operation()};
}

}  // namespace icome::interaction
