#include <fmt/format.h>

#include "animation/files/part_text.h"
#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

base::Result<ProjectEdit> plan_map(Staging& staging, const Arguments& arguments) {
  Mapping mapping;
  mapping.triangle = arguments.text("triangle");
  for (const auto& [word, mode] : mapping_words())
    if (arguments.text("mode") == word) mapping.mode = mode;
  if (mapping.mode != MappingMode::Nearest) {
    if (!arguments.has("cell")) return base::fail("'cell' is missing: the cell that the triangle moves");
    const auto cell = cell_of(staging, arguments, false);
    if (!cell) return tl::unexpected(cell.error());
    mapping.cell = (*cell)->id;
  } else if (arguments.has("cell")) {
    return base::fail("a triangle that takes the nearest cell names none");
  }
  return edit_of(ChangeMapping{mapping.triangle, mapping});
}

base::Result<ProjectEdit> plan_unmap(Staging& staging, const Arguments& arguments) {
  const std::string& triangle = arguments.text("triangle");
  for (const Mapping& mapping : staging.project.mappings)
    if (mapping.triangle == triangle) return edit_of(ChangeMapping{triangle, std::nullopt});
  return base::fail(fmt::format("triangle '{}' moves nothing", triangle));
}

base::Result<ProjectEdit> plan_steady(Staging& /*staging*/, const Arguments& arguments) {
  return edit_of(SmoothHands{arguments.flag("on")});
}

}  // namespace

std::vector<AnimationTool> hand_tools() {
  return {
      {{.name = "map",
        .title = "Triangle Moves Cell",
        .group = "Hands",
        .summary = "Lets a triangle on the table move a cell: to where it lies (an apex that points up is an "
                   "upright cell), by as much as it is moved, or whichever cell lies below it.",
        .parameters = {text_parameter("triangle", "its id in the known list"),
                       {.name = "mode",
                        .kind = ParameterKind::Choice,
                        .meaning = "in which way",
                        .fallback = "absolute",
                        .choices = {"absolute", "relative", "nearest"}},
                       cell_parameter("cell", "the cell; none with nearest", false)}},
       plan_map},
      {{.name = "unmap",
        .title = "Triangle Moves Nothing",
        .group = "Hands",
        .summary = "Lets a triangle move nothing.",
        .parameters = {text_parameter("triangle", "its id")}},
       plan_unmap},
      {{.name = "steady",
        .title = "Steady Hands",
        .group = "Hands",
        .summary = "Takes the trembling out of what triangles do, without a lag at speed.",
        .parameters = {{.name = "on", .kind = ParameterKind::Flag, .meaning = "is it on", .required = true}}},
       plan_steady},
  };
}

}  // namespace icome::animation
