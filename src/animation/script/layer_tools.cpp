#include <fmt/format.h>

#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

base::Result<ProjectEdit> plan_new_layer(Staging& staging, const Arguments& arguments) {
  const Project& project = staging.project;
  const std::string wish =
      arguments.has("name") ? arguments.text("name") : fmt::format("layer {}", project.layers.size() + 1);
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::find(project.layers, name, &Layer::name) != project.layers.end();
  };
  const std::string name = arguments.has("name") ? wish : free_name(wish, is_taken);
  return edit_of(PutLayer{LayerId{staging.next_id++}, project.layers.size(), {.name = name}});
}

base::Result<ProjectEdit> plan_layer_look(Staging& staging, const Arguments& arguments) {
  const auto layer = layer_named(staging.project, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  LayerLook look = look_of(**layer);
  if (arguments.has("name")) look.name = arguments.text("name");
  if (arguments.has("visible")) look.visible = arguments.flag("visible");
  if (arguments.has("locked")) look.locked = arguments.flag("locked");
  return edit_of(ChangeLayer{(*layer)->id, look});
}

base::Result<ProjectEdit> plan_layer_depth(Staging& staging, const Arguments& arguments) {
  const auto layer = layer_named(staging.project, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  return edit_of(MoveLayer{(*layer)->id, std::size_t(arguments.count("place"))});
}

base::Result<ProjectEdit> plan_no_layer(Staging& staging, const Arguments& arguments) {
  const auto layer = layer_named(staging.project, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  if ((*layer)->locked) return base::fail(fmt::format("layer '{}' is locked", (*layer)->name));
  ProjectEdit edit;
  for (const Cell& cell : (*layer)->cells) take_cell(staging.project, cell.id, edit);
  edit.push_back(TakeLayer{(*layer)->id});
  return edit;
}

}  // namespace

std::vector<AnimationTool> layer_tools() {
  return {
      {{.name = "add-layer",
        .title = "New Layer",
        .group = "Layers",
        .summary = "Puts a layer in front of the others.",
        .parameters = {text_parameter("name", "its name", false)}},
       plan_new_layer},
      {{.name = "change-layer",
        .title = "Change Layer",
        .group = "Layers",
        .summary = "Renames a layer, shows or hides it, locks it against hands, or frees it.",
        .parameters =
            {layer_parameter(),
             text_parameter("name", "its new name", false),
             {.name = "visible", .kind = ParameterKind::Flag, .meaning = "is it seen"},
             {.name = "locked", .kind = ParameterKind::Flag, .meaning = "are its cells left alone"}}},
       plan_layer_look},
      {{.name = "move-layer",
        .title = "Move Layer",
        .group = "Layers",
        .summary = "Puts a layer at another depth.",
        .parameters = {layer_parameter(),
                       {.name = "place",
                        .kind = ParameterKind::Count,
                        .meaning = "its place, 0 the farthest back",
                        .required = true,
                        .least = 0,
                        .most = double(kMostLayers)}}},
       plan_layer_depth},
      {{.name = "delete-layer",
        .title = "Delete Layer",
        .group = "Layers",
        .summary = "Takes a layer away, with its cells, their constraints and what moves them.",
        .parameters = {layer_parameter()}},
       plan_no_layer},
  };
}

}  // namespace icome::animation
