#include "animation/record/posing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace icome::animation {
namespace {

constexpr std::array<Channel, 4> kRecorded = {Channel::X, Channel::Y, Channel::Angle, Channel::Scale};
constexpr double kSame = 1e-9;  // px, rad or a factor

bool may_change(const Project& project, CellId id) {
  if (id == kCamera) return true;
  const Layer* layer = project.layer_of(id);
  return layer != nullptr && !layer->locked;
}

/// Marks the keys between two needed ones that lie farther than the tolerance from the way between needed
/// ones (Douglas and Peucker 1973).
void mark_needed(const Track& track, std::size_t first, std::size_t last, double tolerance,
                 std::vector<bool>& needed) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges = {{first, last}};
  while (!ranges.empty()) {
    const auto [begin, end] = ranges.back();
    ranges.pop_back();
    const Key &from = track[begin], &to = track[end];
    double worst = tolerance;
    std::size_t farthest = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double part = double(track[i].frame - from.frame) / (to.frame - from.frame);
      const double off = std::abs(track[i].value - (from.value + part * (to.value - from.value)));
      if (off > worst) worst = off, farthest = i;
    }
    if (farthest == begin) continue;
    needed[farthest] = true;
    ranges.emplace_back(begin, farthest);
    ranges.emplace_back(farthest, end);
  }
}

/// A track with a key at every frame from the first state to the last, straight between states.
Track track_of(const std::map<int, CellState>& states, Channel channel) {
  Track track;
  for (const auto& [frame, state] : states) {
    const double value = channel_of(state, channel);
    if (!track.empty()) {
      const Key before = track.back();
      for (int passed = before.frame + 1; passed < frame; ++passed) {
        const double part = double(passed - before.frame) / (frame - before.frame);
        track.push_back({passed, before.value + part * (value - before.value)});
      }
    }
    track.push_back({frame, value});
  }
  return track;
}

/// The key at a frame, or one that leaves a track as it is. An eased way is cut there: it goes on eased.
Key old_key(const Track& track, Channel channel, int frame) {
  if (const Key* key = key_at(track, frame)) return *key;
  const auto next = std::lower_bound(track.begin(), track.end(), frame,
                                     [](const Key& key, int at) { return key.frame < at; });
  const Ease ease = next == track.begin() ? Ease::Straight : (next - 1)->ease;
  return {frame, value_at(track, channel, frame, 0), ease};
}

/// Puts keys in the place of those at their frames; what was before and after them stays as it was, as keys
/// of the old values beside them see to.
void put_over(const Cell& cell, Channel channel, Track keys, ProjectEdit& edit) {
  const Track& old = cell.tracks[std::size_t(channel)];
  int from = keys.front().frame, to = keys.back().frame;
  if (!old.empty() && old.front().frame < from) {
    --from;
    keys.insert(keys.begin(), old_key(old, channel, from));
  }
  if (!old.empty() && old.back().frame > to) {
    ++to;
    keys.push_back(old_key(old, channel, to));
  }
  edit.push_back(ChangeKeys{cell.id, channel, from, to, std::move(keys)});
}

}  // namespace

ProjectEdit keyed_pose(const Project& project, int frame, const CellStates& states, Ease ease) {
  ProjectEdit edit;
  for (const auto& [id, state] : states) {
    const Cell* cell = project.find(id);
    if (cell == nullptr || !may_change(project, id)) continue;
    const CellState now = state_at(*cell, frame);
    for (const Channel channel : kAllChannels) {
      const double value = channel_of(state, channel);
      if (std::abs(value - channel_of(now, channel)) <= kSame) continue;
      edit.push_back(ChangeKeys{id, channel, frame, frame, {{frame, value, ease}}});
    }
  }
  return edit;
}

void Recording::take(int frame, const CellStates& moved) {
  if (frame < 0 || frame >= kLongestAnimation) return;
  for (const auto& [id, state] : moved) {
    const Layer* layer = project_.layer_of(id);
    if (layer_ && (layer == nullptr || layer->id != *layer_)) continue;
    if (may_change(project_, id)) cells_[id][frame] = since_part_[id][frame] = state;
  }
}

ProjectEdit Recording::finish(double tolerance) const { return edit_of(project_, cells_, tolerance); }

ProjectEdit Recording::next_part() {
  StatesByCell taken = std::exchange(since_part_, {});
  for (auto& [id, states] : taken) {
    // The way from the last state before belongs to this part.
    const auto last = last_of_parts_.find(id);
    if (last != last_of_parts_.end() && last->second.first < states.begin()->first)
      states.insert(last->second);
    last_of_parts_.insert_or_assign(id, *states.rbegin());
  }
  ProjectEdit part = edit_of(with_parts_, taken, 0);
  return apply_edit(with_parts_, part) ? part : ProjectEdit();
}

ProjectEdit Recording::edit_of(const Project& project, const StatesByCell& cells, double tolerance) {
  ProjectEdit edit;
  for (const auto& [id, states] : cells) {
    const Cell& cell = *project.find(id);
    for (const Channel channel : kRecorded) {
      const Track track = track_of(states, channel);
      const bool stays = std::ranges::all_of(
          track, [&](const Key& key) { return std::abs(key.value - track.front().value) <= kSame; });
      const bool is_new = cell.tracks[std::size_t(channel)].empty();
      if (stays && is_new && std::abs(track.front().value - channel_of(cell.rest, channel)) <= kSame)
        continue;
      put_over(cell, channel, thinned(track, value_tolerance(channel, tolerance)), edit);
    }
  }
  return edit;
}

double value_tolerance(Channel channel, double tolerance) {
  return channel == Channel::X || channel == Channel::Y ? tolerance : tolerance / kRimDistance;
}

Track thinned(const Track& track, double tolerance) {
  if (track.size() < 3 || !(tolerance > 0)) return track;
  std::vector<bool> needed(track.size(), false);
  needed.front() = needed.back() = true;
  for (std::size_t i = 1; i < track.size(); ++i)  // only straight ways can be made longer
    if (track[i - 1].ease != Ease::Straight || track[i].ease != Ease::Straight)
      needed[i - 1] = needed[i] = true;
  std::size_t last = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (!needed[i]) continue;
    mark_needed(track, last, i, tolerance, needed);
    last = i;
  }
  Track kept;
  for (std::size_t i = 0; i < track.size(); ++i)
    if (needed[i]) kept.push_back(track[i]);
  return kept;
}

}  // namespace icome::animation
