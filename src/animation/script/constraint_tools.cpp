#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

ProjectEdit put_constraint(Staging& staging, decltype(Constraint::what) what) {
  const ConstraintId id{staging.next_id++};
  staging.note = fmt::format("constraint {}", id.value);
  return edit_of(PutConstraint{staging.project.constraints.size(), {id, std::move(what)}});
}

base::Result<const Cell*> named_by(const Staging& staging, const Arguments& arguments,
                                   const char* parameter) {
  return cell_named(staging.project, arguments.text(parameter));
}

/// The point of a cell that lies at a place of the stage at that frame, by its keys; its pivot without a
/// place.
base::Result<PointOnCell> point_at(const Cell& cell, const Arguments& arguments, const char* parameter) {
  if (!arguments.has(parameter)) return cell.pivot;
  const auto place = place_of(arguments, parameter);
  if (!place) return tl::unexpected(place.error());
  return on_cell(cell, state_at(cell, frame_of(arguments, "frame")), *place);
}

base::Result<ProjectEdit> plan_join(Staging& staging, const Arguments& arguments) {
  const auto parent = named_by(staging, arguments, "parent");
  const auto child = named_by(staging, arguments, "child");
  if (!parent) return tl::unexpected(parent.error());
  if (!child) return tl::unexpected(child.error());
  const int frame = frame_of(arguments, "frame");
  Joint joint;
  joint.parent = (*parent)->id;
  joint.child = (*child)->id;
  const auto on_child = point_at(**child, arguments, "at");
  if (!on_child) return tl::unexpected(on_child.error());
  joint.on_child = *on_child;
  const Vector2 place = on_stage(**child, state_at(**child, frame), *on_child);
  joint.on_parent = on_cell(**parent, state_at(**parent, frame), place);
  if (arguments.has("least") || arguments.has("greatest")) {
    if (!arguments.has("least") || !arguments.has("greatest"))
      return base::fail("'least' and 'greatest' come together");
    joint.limits = AngleLimits{arguments.number("least") * kDegree, arguments.number("greatest") * kDegree};
  }
  return put_constraint(staging, joint);
}

base::Result<ProjectEdit> plan_distance(Staging& staging, const Arguments& arguments) {
  const auto one = named_by(staging, arguments, "one");
  const auto other = named_by(staging, arguments, "other");
  if (!one) return tl::unexpected(one.error());
  if (!other) return tl::unexpected(other.error());
  const auto on_one = point_at(**one, arguments, "at_one");
  const auto on_other = point_at(**other, arguments, "at_other");
  if (!on_one) return tl::unexpected(on_one.error());
  if (!on_other) return tl::unexpected(on_other.error());
  return put_constraint(staging, DistanceLimit{(*one)->id, (*other)->id, *on_one, *on_other,
                                               arguments.number("least"), arguments.number("greatest")});
}

base::Result<ProjectEdit> plan_chain(Staging& staging, const Arguments& arguments) {
  Chain chain;
  for (const std::string& name : arguments.texts("cells")) {
    const auto cell = cell_named(staging.project, name);
    if (!cell) return tl::unexpected(cell.error());
    chain.cells.push_back((*cell)->id);
  }
  return put_constraint(staging, chain);
}

base::Result<ProjectEdit> plan_path(Staging& staging, const Arguments& arguments) {
  const auto cell = named_by(staging, arguments, "cell");
  if (!cell) return tl::unexpected(cell.error());
  const auto point = point_at(**cell, arguments, "at");
  if (!point) return tl::unexpected(point.error());
  const std::vector<Vector2> way = arguments.points2("way");
  if (std::ranges::adjacent_find(way, std::ranges::not_equal_to()) == way.end())
    return base::fail("'way' needs two places that are not the same");
  return put_constraint(
      staging, PathGuide{(*cell)->id, *point, way, arguments.flag("closed"), arguments.flag("turns")});
}

base::Result<ProjectEdit> plan_axis(Staging& staging, const Arguments& arguments) {
  const auto cell = named_by(staging, arguments, "cell");
  if (!cell) return tl::unexpected(cell.error());
  const auto point = point_at(**cell, arguments, "at");
  if (!point) return tl::unexpected(point.error());
  const CellState state = state_at(**cell, frame_of(arguments, "frame"));
  return put_constraint(staging, AxisGuide{(*cell)->id, *point, on_stage(**cell, state, *point),
                                           arguments.number("direction") * kDegree});
}

base::Result<ProjectEdit> plan_free(Staging& staging, const Arguments& arguments) {
  ProjectEdit edit;
  if (arguments.has("number")) {
    const ConstraintId id{std::uint64_t(arguments.count("number"))};
    take_constraints(
        staging.project, [id](const Constraint& it) { return it.id == id; }, edit);
    if (edit.empty()) return base::fail(fmt::format("there is no constraint {}", id.value));
    return edit;
  }
  if (!arguments.has("cells")) return base::fail("'cells' or 'number' is missing");
  std::vector<CellId> cells;
  for (const std::string& name : arguments.texts("cells")) {
    const auto cell = cell_named(staging.project, name);
    if (!cell) return tl::unexpected(cell.error());
    cells.push_back((*cell)->id);
  }
  const auto names_all = [&](const Constraint& constraint) {
    const std::vector<CellId> named = cells_of(constraint);
    return std::ranges::all_of(cells, [&](CellId it) { return std::ranges::find(named, it) != named.end(); });
  };
  take_constraints(staging.project, names_all, edit);
  if (edit.empty()) return base::fail("no constraint names all of these");
  return edit;
}

}  // namespace

std::vector<AnimationTool> constraint_tools() {
  Parameter frame = frame_parameter("frame", "at which places are meant", false);
  frame.fallback = 0;
  const auto length = [](const char* name, const char* meaning) {
    Parameter parameter = number_parameter(name, meaning, 0, kFarthest);
    parameter.required = true;
    return parameter;
  };
  const auto flag = [](const char* name, const char* meaning) {
    return Parameter{.name = name, .kind = ParameterKind::Flag, .meaning = meaning, .fallback = false};
  };
  Parameter direction =
      number_parameter("direction", "degrees, counter-clockwise; 0: to the right", -36e4, 36e4);
  direction.required = true;
  return {
      {{.name = "join",
        .title = "Join",
        .group = "Constraints",
        .summary = "Pins a cell to another, about which place it turns and with which it moves.",
        .parameters = {cell_parameter("parent", "the cell that carries"),
                       cell_parameter("child", "the cell that hangs on it"),
                       place_parameter("at", "the pin on the stage; the child's pivot, else"), frame,
                       number_parameter("least", "degrees of the child's angle less the parent's", -36e4,
                                        36e4),
                       number_parameter("greatest", "likewise", -36e4, 36e4)}},
       plan_join},
      {{.name = "limit-distance",
        .title = "Limit Distance",
        .group = "Constraints",
        .summary = "Keeps two cells between a least and a greatest distance.",
        .parameters = {cell_parameter("one", "a cell"), cell_parameter("other", "another one"),
                       length("least", "px"), length("greatest", "px"),
                       place_parameter("at_one", "from where on the stage; its pivot, else"),
                       place_parameter("at_other", "likewise"), frame}},
       plan_distance},
      {{.name = "chain",
        .title = "Chain",
        .group = "Constraints",
        .summary = "Lets joined cells bend where one of them is taken by a hand (inverse kinematics): the "
                   "first one at its own joint, or about its pivot.",
        .parameters = {{.name = "cells",
                        .kind = ParameterKind::Texts,
                        .meaning = "each the parent of the next by a joint, the root first",
                        .required = true}}},
       plan_chain},
      {{.name = "path",
        .title = "Path",
        .group = "Constraints",
        .summary = "Keeps a cell on a line of straight pieces.",
        .parameters = {cell_parameter("cell", "the cell"),
                       {.name = "way",
                        .kind = ParameterKind::Points,
                        .meaning = "places on the stage, px",
                        .required = true,
                        .least = -kFarthest,
                        .most = kFarthest,
                        .components = 2},
                       flag("closed", "does the last place lead to the first"),
                       flag("turns", "does the cell turn with the path"),
                       place_parameter("at", "its point on the stage; its pivot, else"),
                       frame}},
       plan_path},
      {{.name = "axis",
        .title = "Axis",
        .group = "Constraints",
        .summary = "Keeps a cell on the straight line through the place where it is.",
        .parameters = {cell_parameter("cell", "the cell"), direction,
                       place_parameter("at", "its point on the stage; its pivot, else"), frame}},
       plan_axis},
      {{.name = "free",
        .title = "Free",
        .group = "Constraints",
        .summary = "Takes away a constraint, or all that name these cells.",
        .parameters = {cells_parameter(false),
                       {.name = "number",
                        .kind = ParameterKind::Count,
                        .meaning = "of the constraint, as icome animate tells it",
                        .least = 1,
                        .most = kGreatestNumber}}},
       plan_free},
  };
}

}  // namespace icome::animation
