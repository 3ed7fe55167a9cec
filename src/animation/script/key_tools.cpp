#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "animation/files/part_text.h"
#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

bool has_channel(const Cell& cell, Channel channel) {
  return cell.id != kCamera || std::ranges::find(kCameraChannels, channel) != kCameraChannels.end();
}

/// The value that is given for a channel, in the units of keys; else none.
std::optional<double> given_value(const Arguments& arguments, Channel channel) {
  const char* name = name_of(channel);
  if (!arguments.has(name)) return std::nullopt;
  if (channel == Channel::Picture) return double(arguments.count(name));
  return arguments.number(name) * (channel == Channel::Angle ? kDegree : 1.0);
}

bool gives_a_value(const Arguments& arguments) {
  return std::ranges::any_of(kAllChannels, [&](Channel it) { return arguments.has(name_of(it)); });
}

bool hangs_on_a_joint(const Project& project, CellId cell) {
  return std::ranges::any_of(project.constraints, [cell](const Constraint& constraint) {
    const auto* joint = std::get_if<Joint>(&constraint.what);
    return joint != nullptr && joint->child == cell;
  });
}

base::Result<ProjectEdit> plan_key(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  const int frame = frame_of(arguments, "frame");
  const CellState now = state_at(**cell, frame);
  const bool all = !gives_a_value(arguments);
  if (!all && (arguments.has("x") || arguments.has("y")) && hangs_on_a_joint(staging.project, (*cell)->id))
    staging.note = fmt::format("'{}' hangs on a joint, from which its place follows", (*cell)->name);
  ProjectEdit edit;
  for (const Channel channel : kAllChannels) {
    std::optional<double> value = given_value(arguments, channel);
    if (all && has_channel(**cell, channel)) value = channel_of(now, channel);
    if (!value) continue;
    const Ease ease = channel == Channel::Picture ? Ease::Hold : ease_of(arguments);
    edit.push_back(ChangeKeys{(*cell)->id, channel, frame, frame, {{frame, *value, ease}}});
  }
  return edit;
}

base::Result<ProjectEdit> plan_rest(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  if (!gives_a_value(arguments))
    return base::fail("nothing was named: x, y, angle, scale, opacity or picture");
  CellLook look = look_of(**cell);
  for (const Channel channel : kAllChannels) {
    const auto value = given_value(arguments, channel);
    if (!value) continue;
    if (!has_channel(**cell, channel)) return base::fail("the camera has a place, an angle and a scale only");
    set_channel(look.rest, channel, *value);
    if (!(*cell)->tracks[std::size_t(channel)].empty())
      staging.note = fmt::format("'{}' has keys for {}, which count", (*cell)->name, name_of(channel));
  }
  return edit_of(ChangeCell{(*cell)->id, look});
}

base::Result<ProjectEdit> plan_unkey(Staging& staging, const Arguments& arguments) {
  return for_each_track(staging, arguments, [](const Track&) { return Track(); });
}

base::Result<ProjectEdit> plan_ease(Staging& staging, const Arguments& arguments) {
  const Ease ease = ease_of(arguments);
  return for_each_track(staging, arguments, [ease](Track keys) {
    for (Key& key : keys) key.ease = ease;
    return keys;
  });
}

base::Result<ProjectEdit> plan_expose(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  const std::vector<double> pictures = arguments.numbers("pictures");
  if (pictures.empty()) return base::fail("'pictures' is an empty list");
  const std::int64_t from = arguments.count("frame"), each = arguments.count("each");
  const std::int64_t last = from + std::int64_t(pictures.size()) * each - 1;
  if (last >= kLongestAnimation) return base::fail("the pictures go beyond the longest animation");
  Track track;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    track.push_back({int(from + std::int64_t(i) * each), pictures[i], Ease::Hold});
  return edit_of(ChangeKeys{(*cell)->id, Channel::Picture, int(from), int(last), track});
}

std::vector<Parameter> value_parameters() {
  return {number_parameter("x", "px", -kFarthest, kFarthest),
          number_parameter("y", "px, down", -kFarthest, kFarthest),
          number_parameter("angle", "degrees, counter-clockwise; beyond 360 it turns on", -36e6, 36e6),
          number_parameter("scale", "1: as large as its picture; for the camera: the zoom", 0, 1e4),
          number_parameter("opacity", "0 to 1", 0, 1),
          {.name = "picture",
           .kind = ParameterKind::Count,
           .meaning = "its place among the cell's, from 0; -1: none is shown",
           .least = -1,
           .most = double(kMostPictures)}};
}

std::vector<Parameter> with_values(std::vector<Parameter> first, const std::vector<Parameter>& last) {
  for (Parameter& parameter : value_parameters()) first.push_back(std::move(parameter));
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

}  // namespace

std::vector<AnimationTool> key_tools() {
  return {
      {{.name = "key",
        .title = "Key",
        .group = "Keys",
        .summary =
            "Sets values at a frame; all as they are there, where none is named. The cell 'camera' pans "
            "and zooms.",
        .parameters = with_values({cell_parameter("cell", "its name"), frame_parameter("frame", "where")},
                                  {ease_parameter()})},
       plan_key},
      {{.name = "rest",
        .title = "Values Without Keys",
        .group = "Keys",
        .summary = "Sets the values that a cell has in channels without keys.",
        .parameters = with_values({cell_parameter("cell", "its name")}, {})},
       plan_rest},
      {{.name = "unkey",
        .title = "Delete Keys",
        .group = "Keys",
        .summary = "Takes keys away.",
        .parameters = range_parameters({})},
       plan_unkey},
      {{.name = "ease",
        .title = "Ease",
        .group = "Keys",
        .summary = "Changes the way on from keys.",
        .parameters = range_parameters({ease_parameter()})},
       plan_ease},
      {{.name = "expose",
        .title = "Expose Pictures",
        .group = "Keys",
        .summary = "Shows pictures of a cell one after the other, as an exposure sheet has them.",
        .parameters = {cell_parameter("cell", "its name"),
                       frame_parameter("frame", "of the first one"),
                       {.name = "pictures",
                        .kind = ParameterKind::Counts,
                        .meaning = "their places among the cell's, from 0; -1: none is shown",
                        .required = true,
                        .least = -1,
                        .most = double(kMostPictures)},
                       {.name = "each",
                        .kind = ParameterKind::Count,
                        .meaning = "frames for which a picture stays",
                        .fallback = 1,
                        .least = 1,
                        .most = kLongestAnimation}}},
       plan_expose},
  };
}

}  // namespace icome::animation
