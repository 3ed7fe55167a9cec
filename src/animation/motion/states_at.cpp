#include <algorithm>
#include <optional>

#include "animation/motion/cell_point.h"
#include "animation/motion/constraints.h"
#include "animation/motion/way.h"

namespace icome::animation {
namespace {

constexpr double kOneBranch = 0.01;  // px, within which keys lie on branches of a path alike

/// The last key at or before a frame and the first after it, of any channel that moves points of a cell.
struct KeysAround {
  std::optional<int> from, to;
};

KeysAround keys_around(const Cell& cell, double frame) {
  KeysAround around;
  for (const Channel channel : {Channel::X, Channel::Y, Channel::Angle, Channel::Scale}) {
    const Track& track = cell.tracks[std::size_t(channel)];
    const auto next = std::upper_bound(track.begin(), track.end(), frame,
                                       [](double at, const Key& key) { return at < key.frame; });
    if (next != track.begin())
      around.from = std::max(around.from.value_or((next - 1)->frame), (next - 1)->frame);
    if (next != track.end()) around.to = std::min(around.to.value_or(next->frame), next->frame);
  }
  return around;
}

/// The place of a guided cell on its way, by its keys.
class GuidedKeys {
 public:
  GuidedKeys(const Cell& cell, const PathGuide& guide)
      : cell_(cell), guide_(guide), way_(guide.way, guide.closed) {}

  bool is_empty() const { return way_.is_empty(); }

  Vector2 place(double frame) const {
    const auto [from, to] = keys_around(cell_, frame);
    if (!from || !to) return way_.at(s_of_key(from ? *from : frame));
    const Vector2 start = keyed(*from), way = keyed(*to) - start;
    const double s = s_of_key(*from);
    if (way.squaredNorm() < 1e-18) return way_.at(s);
    const double part = std::clamp((keyed(frame) - start).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return way_.at(s + part * way_.between(s, s_of_key(*to)));
  }

  Vector2 keyed(double frame) const { return on_stage(cell_, state_at(cell_, frame), guide_.on_cell); }

 private:
  double s_of_key(double frame) const {
    return way_.nearest(keyed(frame), keyed(frame + 1) - keyed(frame - 1), kOneBranch);
  }

  const Cell& cell_;
  const PathGuide& guide_;
  Way way_;
};

}  // namespace

CellStates states_at(const Project& project, double frame) {
  CellStates states;
  states.emplace(project.camera.id, state_at(project.camera, frame));
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells) states.emplace(cell.id, state_at(cell, frame));
  if (project.constraints.empty()) return states;
  for (const Constraint& constraint : project.constraints) {
    const auto* guide = std::get_if<PathGuide>(&constraint.what);
    const Cell* cell = guide ? project.find(guide->cell) : nullptr;
    if (!cell) continue;
    const GuidedKeys keys(*cell, *guide);
    if (!keys.is_empty()) states[cell->id].place += keys.place(frame) - keys.keyed(frame);
  }
  return solved(project, states, std::span<const Hold>(), nullptr).states;
}

}  // namespace icome::animation
