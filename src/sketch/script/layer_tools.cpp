#include <fmt/format.h>

#include "sketch/script/tool_arguments.h"

namespace icome::sketch {
namespace {

LayerLook look_of(const Layer& layer) { return {layer.name, layer.visible, layer.locked}; }

base::Result<DrawingEdit> plan_add_layer(Drafting& drafting, const Arguments& arguments) {
  const LayerId id{drafting.next_id++};
  const std::size_t place = drafting.drawing.layers.size();
  drafting.layer = id;
  const std::string name =
      arguments.has("name") ? arguments.text("name") : fmt::format("Layer {}", place + 1);
  return edit_of(PutLayer{id, place, {.name = name}});
}

base::Result<DrawingEdit> plan_choose_layer(Drafting& drafting, const Arguments& arguments) {
  const auto layer = layer_named(drafting.drawing, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  drafting.layer = (*layer)->id;
  return DrawingEdit();
}

base::Result<DrawingEdit> plan_change_layer(Drafting& drafting, const Arguments& arguments) {
  const auto layer = layer_named(drafting.drawing, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  LayerLook look = look_of(**layer);
  if (arguments.has("name")) look.name = arguments.text("name");
  if (arguments.has("visible")) look.visible = arguments.flag("visible");
  if (arguments.has("locked")) look.locked = arguments.flag("locked");
  return edit_of(ChangeLayer{(*layer)->id, look});
}

base::Result<DrawingEdit> plan_move_layer(Drafting& drafting, const Arguments& arguments) {
  const auto layer = layer_named(drafting.drawing, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  const auto place = std::size_t(arguments.count("place"));
  const std::size_t layers = drafting.drawing.layers.size();
  if (place > layers)
    return base::fail(fmt::format("'place' must be 1 to {}, the number of layers, not {}", layers, place));
  return edit_of(MoveLayer{(*layer)->id, place - 1});
}

base::Result<DrawingEdit> plan_delete_layer(Drafting& drafting, const Arguments& arguments) {
  const auto layer = layer_named(drafting.drawing, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  if ((*layer)->locked) return base::fail(fmt::format("layer \"{}\" is locked", (*layer)->name));
  DrawingEdit edit;
  for (const StrokePointer& stroke : (*layer)->strokes) {
    edit.emplace_back(TakeStroke{stroke->id});
    drafting.selection.erase(stroke->id);
  }
  edit.emplace_back(TakeLayer{(*layer)->id});
  return edit;
}

base::Result<DrawingEdit> plan_to_layer(Drafting& drafting, const Arguments& arguments) {
  const auto layer = layer_named(drafting.drawing, arguments.text("layer"));
  if (!layer) return tl::unexpected(layer.error());
  if ((*layer)->locked) return base::fail(fmt::format("layer \"{}\" is locked", (*layer)->name));
  const auto strokes = meant_strokes(drafting, arguments);
  if (!strokes) return tl::unexpected(strokes.error());
  DrawingEdit edit;
  std::size_t place = (*layer)->strokes.size();
  for (const StrokePointer& stroke : *strokes)
    for (const StrokePointer& there : (*layer)->strokes) place -= there == stroke ? 1 : 0;
  for (const StrokePointer& stroke : *strokes) edit.emplace_back(TakeStroke{stroke->id});
  for (const StrokePointer& stroke : *strokes) edit.emplace_back(PutStroke{(*layer)->id, place++, stroke});
  return edit;
}

Parameter layer_parameter() {
  return {.name = "layer",
          .kind = ParameterKind::Text,
          .meaning = "its name, or # and its number",
          .required = true};
}

SketchTool on_layers(const char* name, const char* title, const char* summary,
                     std::vector<Parameter> parameters,
                     base::Result<DrawingEdit> (*plan)(Drafting&, const Arguments&)) {
  return {{.name = name,
           .title = title,
           .group = "Layers",
           .summary = summary,
           .parameters = std::move(parameters)},
          plan};
}

}  // namespace

std::vector<SketchTool> layer_tools() {
  std::vector<Parameter> to_layer = stroke_parameters();
  to_layer.insert(to_layer.begin(), layer_parameter());
  return {
      on_layers("add-layer", "Add layer", "Adds a layer on top; new strokes go to it.",
                {{.name = "name", .kind = ParameterKind::Text, .meaning = "its name (Layer and a number)"}},
                plan_add_layer),
      on_layers("choose-layer", "Choose layer", "New strokes go to this layer.", {layer_parameter()},
                plan_choose_layer),
      on_layers("change-layer", "Change layer", "Names, hides, shows, locks or unlocks a layer.",
                {layer_parameter(),
                 {.name = "name", .kind = ParameterKind::Text, .meaning = "its new name"},
                 {.name = "visible", .kind = ParameterKind::Flag, .meaning = "is it seen?"},
                 {.name = "locked", .kind = ParameterKind::Flag, .meaning = "do tools leave it alone?"}},
                plan_change_layer),
      on_layers("move-layer", "Move layer", "Lays a layer above or below others.",
                {layer_parameter(),
                 {.name = "place",
                  .kind = ParameterKind::Count,
                  .meaning = "1 is the lowest",
                  .required = true,
                  .least = 1}},
                plan_move_layer),
      on_layers("delete-layer", "Delete layer", "Takes a layer away with its strokes.", {layer_parameter()},
                plan_delete_layer),
      on_layers("to-layer", "To layer",
                "Brings strokes to another layer; without a stroke all that are selected.",
                std::move(to_layer), plan_to_layer)};
}

}  // namespace icome::sketch
