#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/record/posing.h"
#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

/// Adds what puts keys over those that are at their frames, after those of [from, to] were taken away.
void put_instead(const Cell& cell, Channel channel, int from, int to, const Track& keys, ProjectEdit& edit) {
  Track track;
  for (const Key& key : cell.tracks[std::size_t(channel)])
    if (key.frame < from || key.frame > to) track.push_back(key);
  for (const Key& key : keys) {
    const auto at = std::ranges::lower_bound(track, key.frame, {}, [](const Key& it) { return it.frame; });
    if (at != track.end() && at->frame == key.frame)
      *at = key;
    else
      track.insert(at, key);
  }
  edit.push_back(ChangeKeys{cell.id, channel, 0, kLongestAnimation - 1, std::move(track)});
}

/// The edit that moves keys to the frames that `moved` says, and leaves the old ones where `keeps`.
template <typename MovedFrame>
base::Result<ProjectEdit> with_moved_keys(const Staging& staging, const Arguments& arguments, bool keeps,
                                          const MovedFrame& moved) {
  const auto ranges = ranges_of(staging, arguments);
  if (!ranges) return tl::unexpected(ranges.error());
  ProjectEdit edit;
  for (const KeyRange& range : *ranges) {
    Track keys = range.keys;
    for (Key& key : keys) {
      const double frame = std::round(moved(key.frame));
      if (!(frame >= 0 && frame < kLongestAnimation))
        return base::fail(fmt::format("the key of '{}' at frame {} would come to frame {}", range.cell->name,
                                      key.frame, frame));
      key.frame = int(frame);
    }
    const auto last = std::unique(keys.rbegin(), keys.rend(),
                                  [](const Key& one, const Key& other) { return one.frame == other.frame; });
    keys.erase(keys.begin(), last.base());  // of keys that come to the same frame the last stays
    const int last_taken = keeps ? range.from - 1 : range.to;  // copies take nothing away
    put_instead(*range.cell, range.channel, range.from, last_taken, keys, edit);
  }
  return edit;
}

base::Result<ProjectEdit> plan_move_keys(Staging& staging, const Arguments& arguments) {
  const double by = double(arguments.count("by"));
  return with_moved_keys(staging, arguments, false, [by](int frame) { return frame + by; });
}

base::Result<ProjectEdit> plan_copy_keys(Staging& staging, const Arguments& arguments) {
  const double by = double(arguments.count("at") - arguments.count("from"));
  return with_moved_keys(staging, arguments, true, [by](int frame) { return frame + by; });
}

base::Result<ProjectEdit> plan_stretch_keys(Staging& staging, const Arguments& arguments) {
  const double factor = arguments.number("factor");
  const int from = frame_of(arguments, "from");
  return with_moved_keys(staging, arguments, false,
                         [=](int frame) { return from + factor * (frame - from); });
}

base::Result<ProjectEdit> plan_thin_keys(Staging& staging, const Arguments& arguments) {
  const double tolerance = arguments.number("tolerance");
  const auto ranges = ranges_of(staging, arguments);
  if (!ranges) return tl::unexpected(ranges.error());
  ProjectEdit edit;
  std::size_t before = 0, after = 0;
  for (const KeyRange& range : *ranges) {
    if (range.channel == Channel::Picture) continue;
    const Track kept = thinned(range.keys, value_tolerance(range.channel, tolerance));
    before += range.keys.size();
    after += kept.size();
    edit.push_back(ChangeKeys{range.cell->id, range.channel, range.from, range.to, kept});
  }
  staging.note = fmt::format("{} of {} keys are left", after, before);
  return edit;
}

/// Adds what moves all keys and marks from a frame on, after those of [from, from - by) were taken away where
/// `by` is below 0.
base::Result<ProjectEdit> shifted(const Project& project, int from, int by) {
  ProjectEdit edit;
  const auto shift_cell = [&](const Cell& cell) {
    for (const Channel channel : kAllChannels) {
      const Track& old = cell.tracks[std::size_t(channel)];
      Track track;
      for (Key key : old) {
        if (key.frame >= from && key.frame < from - by) continue;
        if (key.frame >= from) key.frame += by;
        if (key.frame < kLongestAnimation) track.push_back(key);
      }
      if (track != old) edit.push_back(ChangeKeys{cell.id, channel, 0, kLongestAnimation - 1, track});
    }
  };
  shift_cell(project.camera);
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells) shift_cell(cell);
  for (const Mark& mark : project.marks)
    if (mark.frame >= from) edit.push_back(ChangeMark{mark.frame, std::nullopt});
  for (const Mark& mark : project.marks)
    if (mark.frame >= std::max(from, from - by) && mark.frame + by < kLongestAnimation)
      edit.push_back(ChangeMark{mark.frame + by, mark.text});
  Stage stage = project.stage;
  stage.length = std::clamp(stage.length + by, 1, kLongestAnimation);
  edit.push_back(ChangeStage{stage});
  return edit;
}

base::Result<ProjectEdit> plan_insert_frames(Staging& staging, const Arguments& arguments) {
  return shifted(staging.project, frame_of(arguments, "frame"), int(arguments.count("count")));
}

base::Result<ProjectEdit> plan_delete_frames(Staging& staging, const Arguments& arguments) {
  const int frame = frame_of(arguments, "frame");
  const int count =
      std::min(int(arguments.count("count")), std::max(0, staging.project.stage.length - frame));
  if (count == 0) return base::fail(fmt::format("the last frame is {}", staging.project.stage.length - 1));
  if (count == staging.project.stage.length) return base::fail("an animation has one frame at least");
  return shifted(staging.project, frame, -count);
}

}  // namespace

std::vector<AnimationTool> time_tools() {
  const Parameter count = {.name = "count",
                           .kind = ParameterKind::Count,
                           .meaning = "how many",
                           .fallback = 1,
                           .least = 1,
                           .most = kLongestAnimation};
  const Parameter by = {.name = "by",
                        .kind = ParameterKind::Count,
                        .meaning = "frames; below 0: earlier",
                        .required = true,
                        .least = -kLongestAnimation,
                        .most = kLongestAnimation};
  Parameter factor = number_parameter("factor", "2: twice as slow", 0.001, 1000);
  factor.required = true;
  Parameter tolerance = number_parameter("tolerance", "px by which the rim of a cell may move", 0, 1000);
  tolerance.fallback = 0.5;
  return {
      {{.name = "move-keys",
        .title = "Move Keys",
        .group = "Time",
        .summary = "Moves keys to other frames, over those that are there.",
        .parameters = range_parameters({by})},
       plan_move_keys},
      {{.name = "copy-keys",
        .title = "Copy Keys",
        .group = "Time",
        .summary = "Puts copies of keys at other frames, over those that are there.",
        .parameters = range_parameters({frame_parameter("at", "where 'from' comes to")})},
       plan_copy_keys},
      {{.name = "stretch-keys",
        .title = "Stretch Keys",
        .group = "Time",
        .summary = "Makes a motion slower or faster, from its first frame on.",
        .parameters = range_parameters({factor})},
       plan_stretch_keys},
      {{.name = "thin-keys",
        .title = "Thin Keys Out",
        .group = "Time",
        .summary = "Takes away keys that the ways between others come near, as after a recording.",
        .parameters = range_parameters({tolerance})},
       plan_thin_keys},
      {{.name = "insert-frames",
        .title = "Insert Frames",
        .group = "Time",
        .summary = "Puts frames in; all keys and marks from there on come later. The sound stays.",
        .parameters = {frame_parameter("frame", "before which"), count}},
       plan_insert_frames},
      {{.name = "delete-frames",
        .title = "Delete Frames",
        .group = "Time",
        .summary =
            "Takes frames out, with their keys and marks; what follows comes earlier. The sound stays.",
        .parameters = {frame_parameter("frame", "the first of them"), count}},
       plan_delete_frames},
  };
}

}  // namespace icome::animation
