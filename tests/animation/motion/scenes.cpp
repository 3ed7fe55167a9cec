#include "animation/motion/scenes.h"

#include <algorithm>
#include <limits>

namespace icome::animation::scenes {
namespace {

class Judge {
 public:
  Judge(const Project& project, const CellStates& states) : project_(project), states_(states) {}

  double operator()(const Joint& joint) const {
    const double apart = (seen(joint.parent, joint.on_parent) - seen(joint.child, joint.on_child)).norm();
    if (!joint.limits) return apart;
    const double turn = states_.at(joint.child).angle - states_.at(joint.parent).angle;
    const double beyond = std::max({0.0, joint.limits->least - turn, turn - joint.limits->greatest});
    return std::max(apart, 1000 * beyond);
  }
  double operator()(const DistanceLimit& limit) const {
    const double apart = (seen(limit.one, limit.on_one) - seen(limit.other, limit.on_other)).norm();
    return std::max({0.0, limit.least - apart, apart - limit.greatest});
  }
  double operator()(const Chain&) const { return 0; }
  double operator()(const PathGuide& guide) const {
    return distance_from(guide.way, guide.closed, seen(guide.cell, guide.on_cell));
  }
  double operator()(const AxisGuide& axis) const {
    const Vector2 away = seen(axis.cell, axis.on_cell) - axis.through;
    return std::abs(away.x() * std::sin(axis.direction) + away.y() * std::cos(axis.direction));
  }

 private:
  Vector2 seen(CellId id, const PointOnCell& point) const {
    return seen_at(*project_.find(id), states_.at(id), point);
  }

  const Project& project_;
  const CellStates& states_;
};

}  // namespace

double worst_violation(const Project& project, const CellStates& states) {
  double worst = 0;
  for (const Constraint& constraint : project.constraints)
    worst = std::max(worst, std::visit(Judge(project, states), constraint.what));
  return worst;
}

double distance_from(const std::vector<Vector2>& way, bool closed, const Vector2& place) {
  double least = (place - way.front()).norm();
  const std::size_t pieces = way.size() - (closed ? 0 : 1);
  for (std::size_t k = 0; k < pieces; ++k) {
    const Vector2 from = way[k], by = way[(k + 1) % way.size()] - from;
    const double part =
        by.squaredNorm() > 0 ? std::clamp(by.dot(place - from) / by.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (from + part * by - place).norm());
  }
  return least;
}

double largest_step(const CellStates& from, const CellStates& to) {
  double largest = 0;
  for (const auto& [id, state] : from) largest = std::max(largest, (to.at(id).place - state.place).norm());
  return largest;
}

bool is_finite(const CellStates& states) {
  return std::all_of(states.begin(), states.end(), [](const auto& entry) {
    const CellState& state = entry.second;
    return state.place.allFinite() && std::isfinite(state.angle);
  });
}

}  // namespace icome::animation::scenes
