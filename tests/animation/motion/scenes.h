#pragma once
// Small projects under constraints, and judges that know nothing of the solver.
#include <cmath>
#include <string>

#include "animation/motion/constraints.h"
#include "base/random.h"

namespace icome::animation::scenes {

inline Cell cell(std::uint64_t id, const Vector2& place = Vector2::Zero(), double angle = 0) {
  Cell made;
  made.id = CellId{id};
  made.name = "cell " + std::to_string(id);
  made.rest.place = place;
  made.rest.angle = angle;
  return made;
}

/// A project of cells with the ids 2, 3, ... on one layer.
inline Project project_of(int count) {
  Project project;
  Layer layer;
  layer.id = LayerId{1000000};
  layer.name = "layer";
  for (int k = 0; k < count; ++k) layer.cells.push_back(cell(std::uint64_t(k) + 2));
  project.layers.push_back(layer);
  project.next_id = 1000001;
  return project;
}

inline CellId id_of(int number) { return CellId{std::uint64_t(number) + 2}; }
inline Cell& cell_of(Project& project, int number) { return project.layers[0].cells[std::size_t(number)]; }

template <typename What>
void constrain(Project& project, const What& what) {
  project.constraints.push_back({ConstraintId{project.next_id++}, what});
}

/// The place of a point of a cell by complex numbers: x + iy with y up.
inline Vector2 seen_at(const Cell& cell, const CellState& state, const Vector2& point) {
  const double x = state.scale * (point.x() - cell.pivot.x());
  const double up = -state.scale * (point.y() - cell.pivot.y());
  const double length = std::hypot(x, up), angle = std::atan2(up, x) + state.angle;
  return {state.place.x() + length * std::cos(angle), state.place.y() - length * std::sin(angle)};
}

/// A straight limb of links of those lengths, each pinned at (0, 0) to the end (length, 0) of the one before;
/// the first cell stands at the origin. With the last one's own end at (length, 0) too.
inline Project limb(std::initializer_list<double> lengths, bool is_chain) {
  Project project = project_of(int(lengths.size()));
  Chain chain;
  int number = 0;
  double before = 0, along = 0;
  for (const double length : lengths) {
    cell_of(project, number).rest.place = {along, 0};
    if (number > 0 || lengths.size() == 2) chain.cells.push_back(id_of(number));
    if (number > 0) constrain(project, Joint{id_of(number - 1), id_of(number), {before, 0}, {0, 0}, {}});
    along += length;
    before = length;
    ++number;
  }
  if (is_chain) constrain(project, chain);
  return project;
}

/// The worst violation of a project's constraints, px; of limits, rad times 1000.
double worst_violation(const Project& project, const CellStates& states);

/// The distance of a place from a line of straight pieces, by trying them all.
double distance_from(const std::vector<Vector2>& way, bool closed, const Vector2& place);

/// The largest step of any cell's pivot between two moments, px.
double largest_step(const CellStates& from, const CellStates& to);

bool is_finite(const CellStates& states);

}  // namespace icome::animation::scenes
