#pragma once
#include <map>
#include <optional>
#include <utility>

#include "animation/project/project_edit.h"

namespace icome::animation {

/// The edit that keys, at one frame, all channels in which the states differ from what the project has there:
/// what pose to pose does with cells that a hand has moved. Cells on locked layers are left alone. `ease` is
/// the way on from there.
ProjectEdit keyed_pose(const Project& project, int frame, const CellStates& states,
                       Ease ease = Ease::Straight);

/// Takes down what cells do while an animation runs, to be put into it as one edit. Only cells of `layer` are
/// taken down, or all where it is none; locked layers are left alone.
class Recording {
 public:
  Recording(Project project, std::optional<LayerId> layer)
      : project_(std::move(project)), layer_(layer), with_parts_(project_) {}

  /// Cells as they were moved at a frame; of several at one frame the last counts. Frames that were passed
  /// over get keys between.
  void take(int frame, const CellStates& moved);

  bool is_empty() const { return cells_.empty(); }
  /// Overdub: for each cell that was moved, keys of place, angle and scale at each frame from the first to
  /// the last at which it was moved take the place of what was there. Keys that lie within
  /// value_tolerance() of the way between others are left out; with a tolerance of 0 px none are.
  ProjectEdit finish(double tolerance) const;

  /// The edit of what was taken down since the part before, empty where nothing was. Parts that are applied
  /// one after the other move cells as finish(0) does, so that a journal can have a recording that goes on.
  ProjectEdit next_part();

 private:
  using StatesByFrame = std::map<int, CellState>;
  using StatesByCell = std::map<CellId, StatesByFrame>;

  static ProjectEdit edit_of(const Project& project, const StatesByCell& cells, double tolerance);

  Project project_;  // as it was when the recording began
  std::optional<LayerId> layer_;
  StatesByCell cells_;
  Project with_parts_;       // the project with the parts so far
  StatesByCell since_part_;  // taken down since the last one
  std::map<CellId, std::pair<int, CellState>> last_of_parts_;
};

/// The change of a channel's value by which the rim of a cell moves by so many px, where it is kRimDistance
/// from its pivot.
double value_tolerance(Channel channel, double tolerance);
inline constexpr double kRimDistance = 300;  // px

/// The track without keys that lie within `tolerance` of the straight way between others, at all frames.
Track thinned(const Track& track, double tolerance);

}  // namespace icome::animation
