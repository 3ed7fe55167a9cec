#include "animation/script/tool_arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "animation/files/part_text.h"
#include "base/near_names.h"

namespace icome::animation {

Parameter cell_parameter(const char* name, const char* meaning, bool required) {
  return {.name = name, .kind = ParameterKind::Text, .meaning = meaning, .required = required};
}

Parameter cells_parameter(bool required) {
  return {.name = "cells",
          .kind = ParameterKind::Texts,
          .meaning = required ? "names of cells" : "names of cells; all on layers that are not locked, else",
          .required = required};
}

Parameter layer_parameter(bool required) {
  return {
      .name = "layer", .kind = ParameterKind::Text, .meaning = "the name of a layer", .required = required};
}

Parameter frame_parameter(const char* name, const char* meaning, bool required) {
  return {.name = name,
          .kind = ParameterKind::Count,
          .meaning = meaning,
          .required = required,
          .least = 0,
          .most = kLongestAnimation - 1};
}

Parameter place_parameter(const char* name, const char* meaning, bool required) {
  return {.name = name,
          .kind = ParameterKind::Numbers,
          .meaning = std::string(meaning) + ": x and y, px",
          .required = required,
          .least = -kFarthest,
          .most = kFarthest};
}

Parameter number_parameter(const char* name, const char* meaning, double least, double most) {
  return {.name = name, .meaning = meaning, .least = least, .most = most};
}

Parameter text_parameter(const char* name, const char* meaning, bool required) {
  return {.name = name, .kind = ParameterKind::Text, .meaning = meaning, .required = required};
}

Parameter channels_parameter() {
  return {.name = "channels",
          .kind = ParameterKind::Texts,
          .meaning = "x, y, angle, scale, opacity, picture; all of them, else"};
}

Parameter ease_parameter() {
  return {.name = "ease",
          .kind = ParameterKind::Choice,
          .meaning = "the way on from there: evenly, slowly out and in, or staying until the next key",
          .fallback = "straight",
          .choices = {"straight", "eased", "hold"}};
}

base::Result<const Cell*> cell_named(const Project& project, const std::string& name, bool to_change) {
  const Cell* cell = project.find(name);
  if (cell == nullptr) {
    std::vector<std::string> names = {kCameraName};
    for (const Layer& layer : project.layers)
      for (const Cell& one : layer.cells) names.push_back(one.name);
    return base::fail(fmt::format("there is no cell '{}'{}", name, base::suggestion(name, names)));
  }
  const Layer* layer = project.layer_of(cell->id);
  if (to_change && layer != nullptr && layer->locked)
    return base::fail(fmt::format("'{}' lies on layer '{}', which is locked", name, layer->name));
  return cell;
}

base::Result<const Cell*> cell_of(const Staging& staging, const Arguments& arguments, bool to_change) {
  return cell_named(staging.project, arguments.text("cell"), to_change);
}

base::Result<std::vector<const Cell*>> meant_cells(const Staging& staging, const Arguments& arguments) {
  std::vector<const Cell*> cells;
  if (!arguments.has("cells")) {
    for (const Layer& layer : staging.project.layers)
      for (const Cell& cell : layer.cells)
        if (!layer.locked) cells.push_back(&cell);
    return cells;
  }
  for (const std::string& name : arguments.texts("cells")) {
    const auto cell = cell_named(staging.project, name);
    if (!cell) return tl::unexpected(cell.error());
    if (std::ranges::find(cells, *cell) == cells.end()) cells.push_back(*cell);
  }
  return cells;
}

base::Result<const Layer*> layer_named(const Project& project, const std::string& name) {
  std::vector<std::string> names;
  for (const Layer& layer : project.layers) {
    if (layer.name == name) return &layer;
    names.push_back(layer.name);
  }
  return base::fail(fmt::format("there is no layer '{}'{}", name, base::suggestion(name, names)));
}

base::Result<Vector2> place_of(const Arguments& arguments, std::string_view name) {
  const std::vector<double> numbers = arguments.numbers(name);
  if (numbers.size() != 2)
    return base::fail(fmt::format("'{}' must be a place of two numbers, not of {}", name, numbers.size()));
  return Vector2(numbers[0], numbers[1]);
}

base::Result<std::vector<Channel>> channels_of(const Arguments& arguments) {
  if (!arguments.has("channels")) return std::vector<Channel>(kAllChannels.begin(), kAllChannels.end());
  std::vector<Channel> channels;
  for (const std::string& word : arguments.texts("channels")) {
    const auto found =
        std::ranges::find(channel_words(), word, [](const auto& it) { return std::string(it.first); });
    if (found == channel_words().end())
      return base::fail(
          fmt::format("'channels' are x, y, angle, scale, opacity and picture, and not '{}'", word));
    channels.push_back(found->second);
  }
  return channels;
}

Ease ease_of(const Arguments& arguments) {
  for (const auto& [word, ease] : ease_words())
    if (arguments.text("ease") == word) return ease;
  return Ease::Straight;
}

int frame_of(const Arguments& arguments, std::string_view name) { return int(arguments.count(name)); }

std::vector<Parameter> range_parameters(const std::vector<Parameter>& more) {
  Parameter from = frame_parameter("from", "the first frame", false);
  from.fallback = 0;
  std::vector<Parameter> parameters = {cells_parameter(false), from,
                                       frame_parameter("to", "the last frame; the end, else", false),
                                       channels_parameter()};
  parameters.insert(parameters.end(), more.begin(), more.end());
  return parameters;
}

base::Result<std::vector<KeyRange>> ranges_of(const Staging& staging, const Arguments& arguments) {
  const auto cells = meant_cells(staging, arguments);
  if (!cells) return tl::unexpected(cells.error());
  const auto channels = channels_of(arguments);
  if (!channels) return tl::unexpected(channels.error());
  const int from = frame_of(arguments, "from");
  const int to = arguments.has("to") ? frame_of(arguments, "to") : kLongestAnimation - 1;
  if (to < from) return base::fail(fmt::format("frame {} comes after frame {}", from, to));
  std::vector<KeyRange> ranges;
  for (const Cell* cell : *cells) {
    for (const Channel channel : *channels) {
      KeyRange range = {cell, channel, from, to, {}};
      for (const Key& key : cell->tracks[std::size_t(channel)])
        if (key.frame >= from && key.frame <= to) range.keys.push_back(key);
      if (!range.keys.empty()) ranges.push_back(std::move(range));
    }
  }
  if (ranges.empty()) return base::fail("there is no key in these frames");
  return ranges;
}

base::Result<ProjectEdit> for_each_track(const Staging& staging, const Arguments& arguments,
                                         const std::function<Track(Track keys)>& change) {
  const auto ranges = ranges_of(staging, arguments);
  if (!ranges) return tl::unexpected(ranges.error());
  ProjectEdit edit;
  for (const KeyRange& range : *ranges)
    edit.push_back(ChangeKeys{range.cell->id, range.channel, range.from, range.to, change(range.keys)});
  return edit;
}

void take_constraints(const Project& project, const std::function<bool(const Constraint&)>& is_meant,
                      ProjectEdit& edit) {
  const auto is_taken = [&](ConstraintId id) {
    return std::ranges::any_of(edit, [&](const ProjectChange& change) {
      const auto* take = std::get_if<TakeConstraint>(&change);
      return take != nullptr && take->id == id;
    });
  };
  const auto needs = [](const Chain& chain, const Joint& joint) {
    const auto child = std::ranges::find(chain.cells, joint.child);
    return child != chain.cells.end() && child != chain.cells.begin() && *(child - 1) == joint.parent;
  };
  const auto loses_a_joint = [&](const Chain& chain) {
    return std::ranges::any_of(project.constraints, [&](const Constraint& other) {
      const auto* joint = std::get_if<Joint>(&other.what);
      return joint != nullptr && is_meant(other) && needs(chain, *joint);
    });
  };
  for (const bool chains : {true, false}) {
    for (const Constraint& constraint : project.constraints) {
      const auto* chain = std::get_if<Chain>(&constraint.what);
      if ((chain != nullptr) != chains || is_taken(constraint.id)) continue;
      if (is_meant(constraint) || (chain != nullptr && loses_a_joint(*chain)))
        edit.push_back(TakeConstraint{constraint.id});
    }
  }
}

void take_cell(const Project& project, CellId id, ProjectEdit& edit) {
  const auto names_it = [id](const Constraint& constraint) {
    const std::vector<CellId> cells = cells_of(constraint);
    return std::ranges::find(cells, id) != cells.end();
  };
  take_constraints(project, names_it, edit);
  for (const Mapping& mapping : project.mappings)
    if (mapping.cell == id) edit.push_back(ChangeMapping{mapping.triangle, std::nullopt});
  edit.push_back(TakeCell{id});
}

ProjectEdit edit_of(ProjectChange change) {
  ProjectEdit edit;
  edit.push_back(std::move(change));
  return edit;
}

}  // namespace icome::animation
