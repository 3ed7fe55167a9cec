#include "apps/animate/recording_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "animation/motion/hands.h"
#include "animation/picture/stage_picture.h"
#include "animation/record/posing.h"
#include "animation/script/tool_arguments.h"
#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "apps/track/track_work.h"
#include "cutout/tracker/tracker.h"

namespace icome::apps {
namespace {

constexpr double kPartSeconds = 1.0;  // what a crash may take

using animation::CellId;
using animation::CellStates;
using animation::Project;

TrackOptions table_options(const AnimateOptions& options) {
  TrackOptions track;
  track.source = options.record;
  track.known = options.known;
  track.view = options.view;
  track.table = options.table;
  return track;
}

/// The project with mappings for triangles whose cell the known list names, where it has none of its own.
base::Result<Project> with_named_cells(Project project, const cutout::KnownTriangles& known) {
  for (const cutout::KnownTriangle& triangle : known.triangles) {
    const bool is_mapped = std::ranges::any_of(
        project.mappings, [&](const animation::Mapping& mapping) { return mapping.triangle == triangle.id; });
    if (is_mapped || triangle.cell.empty()) continue;
    const auto cell = animation::cell_named(project, triangle.cell, false);
    if (!cell)
      return base::fail(fmt::format("triangle '{}' of the list: {}", triangle.id, cell.error().message));
    project.mappings.push_back({triangle.id, animation::MappingMode::Absolute, (*cell)->id});
  }
  if (project.mappings.empty())
    return base::fail(
        "no triangle moves a cell: map them in the project (the tool map), or name cells in the "
        "known list (cell = \"boat\")");
  return project;
}

std::size_t keys_in(const animation::ProjectEdit& edit) {
  std::size_t keys = 0;
  for (const animation::ProjectChange& change : edit)
    if (const auto* part = std::get_if<animation::ChangeKeys>(&change)) keys += part->keys.size();
  return keys;
}

/// A recording while frames of the table come in.
class HandRecording {
 public:
  HandRecording(const AnimateOptions& options, Project project, cutout::KnownTriangles known,
                animation::CellPictures& pictures, std::optional<animation::LayerId> layer,
                const RecordingKeeper& keeper)
      : options_(options),
        keeper_(keeper),
        project_(std::move(project)),
        known_(std::move(known)),
        pictures_(pictures),
        recording_(project_, layer) {}

  /// Takes all frames until the source ends, the animation does, or Ctrl-C. What was taken counts even where
  /// the source fails, which is told.
  base::Result<RecordedHands> run() {
    const TrackOptions track = table_options(options_);
    auto source = open_for(track);
    if (!source) return tl::unexpected(source.error());
    RecordedHands recorded;
    while (!interrupted()) {
      auto next = (*source)->next([] { return interrupted(); });
      if (!next) {
        status_.clear();
        tell(next.error().message);
        if ((*source)->damaged() > damaged_) {
          damaged_ = (*source)->damaged();
          continue;
        }
        if (recorded.frames == 0) return tl::unexpected(next.error());
        recorded.broke_off = true;
        break;
      }
      if (!*next) break;
      const auto goes_on = take(**next, track);
      if (!goes_on) return tl::unexpected(goes_on.error());
      ++recorded.frames;
      if (!*goes_on) {
        recorded.reached_end = at_end_;
        break;
      }
      keep_what_came((*next)->time);
    }
    status_.clear();
    recorded.dropped = (*source)->dropped();
    return recorded;
  }

  animation::ProjectEdit edit() const { return recording_.finish(options_.thin); }

 private:
  void keep_what_came(double time) {
    if (time < kept_until_ + kPartSeconds) return;
    kept_until_ = time;
    if (const animation::ProjectEdit part = recording_.next_part(); !part.empty()) keeper_.keep(part);
  }

  /// False at the end of the animation, or of the time that was asked for.
  base::Result<bool> take(const cutout::Frame& frame, const TrackOptions& track) {
    if (!tracker_) {
      const auto view = view_for(track, frame);
      if (!view) return tl::unexpected(view.error());
      if (const auto begun = keeper_.begin(); !begun) return tl::unexpected(begun.error());
      map_ = animation::TableMap::fitting(view->table_width(), view->table_height(), project_.stage);
      tracker_ = cutout::make_pose_tracker(known_, *view);
      started_ = kept_until_ = frame.time;
    }
    complaints_.look_at(frame);
    const auto seen = tracker_->see(frame.view(), frame.time);
    if (!seen) return tl::unexpected(seen.error());
    const double since = frame.time - started_;
    const int at = options_.from + int(std::floor(since * project_.stage.rate + 1e-6));
    at_end_ = at >= project_.stage.length;
    if (at_end_ || (options_.seconds > 0 && since > options_.seconds)) return false;
    move(*seen, frame.time, at);
    status_.progress("Recording", at, project_.stage.length, "frames");
    return true;
  }

  void move(const std::vector<cutout::Sighting>& seen, double time, int at) {
    std::vector<animation::TriangleOnTable> triangles;
    for (const cutout::Sighting& sighting : seen)
      triangles.push_back({known_.triangles[sighting.triangle].id, sighting.pose.centroid,
                           sighting.pose.angle, sighting.confidence});
    // Cells that no hand has touched go on as their keys say; what one let go stays.
    CellStates now = animation::states_at(project_, at);
    for (const auto& [cell, state] : touched_) now[cell] = state;
    const auto under = [&](const animation::Vector2& place) {
      return animation::cell_at(project_, now, pictures_, place).value_or(CellId{});
    };
    const animation::Moves moves = hands_.next(project_, now, triangles, time, map_, under);
    if (!moves.held.empty()) {
      const CellStates before = now;
      now = animation::solved(project_, before, moves.holds(), &before).states;
      for (const auto& [cell, state] : now)
        if (const auto old = before.find(cell); old == before.end() || !(old->second == state))
          touched_[cell] = state;
      for (const CellId cell : moves.held) touched_[cell] = now.at(cell);
    }
    recording_.take(at, touched_);
  }

  const AnimateOptions& options_;
  const RecordingKeeper& keeper_;
  Project project_;
  cutout::KnownTriangles known_;
  animation::CellPictures& pictures_;
  animation::Recording recording_;
  animation::Hands hands_;
  animation::TableMap map_;
  CellStates touched_;  // by hands, or by what they moved
  std::unique_ptr<cutout::Tracker> tracker_;
  double started_ = 0;     // s, time of the first frame
  double kept_until_ = 0;  // s, time of the last frame that is in a part
  bool at_end_ = false;    // of the animation
  std::uint64_t damaged_ = 0;
  FrameComplaints complaints_;
  StatusLine status_;
};

}  // namespace

base::Result<RecordedHands> record_hands(const AnimateOptions& options, animation::AnimationRunner& runner,
                                         animation::CellPictures& pictures, const RecordingKeeper& keeper) {
  if (options.known.empty())
    return base::fail("--known is missing: the list of triangles that lie on the table");
  if (const int length = runner.project().stage.length; options.from >= length)
    return base::fail(fmt::format("--from is {}, but the last frame is {}", options.from, length - 1));
  auto known = cutout::read_known_triangles(options.known);
  if (!known) return tl::unexpected(known.error());
  std::optional<animation::LayerId> layer;
  if (!options.layer.empty()) {
    const auto named = animation::layer_named(runner.project(), options.layer);
    if (!named) return tl::unexpected(named.error());
    layer = (*named)->id;
  }
  auto project = with_named_cells(runner.project(), *known);
  if (!project) return tl::unexpected(project.error());
  for (const animation::Mapping& mapping : project->mappings)
    if (const animation::Layer* on = project->layer_of(mapping.cell);
        on != nullptr && (on->locked || !on->visible))
      tell(fmt::format("triangle '{}' moves nothing: layer '{}' is {}", mapping.triangle, on->name,
                       on->locked ? "locked" : "hidden"));
  HandRecording recording(options, std::move(*project), std::move(*known), pictures, layer, keeper);
  auto recorded = recording.run();
  if (!recorded) return recorded;
  const animation::ProjectEdit edit = recording.edit();
  recorded->keys = keys_in(edit);
  if (edit.empty()) return recorded;
  if (const auto done = runner.perform(edit); !done) return tl::unexpected(done.error());
  return recorded;
}

}  // namespace icome::apps
