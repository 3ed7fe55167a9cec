#include "animation/motion/rig.h"

#include <algorithm>
#include <numeric>

namespace icome::animation {
namespace {

/// Ids of all cells that are held or under a constraint, each once.
std::vector<CellId> concerned(const Project& project, std::span<const Hold> holds) {
  std::vector<CellId> ids;
  for (const Constraint& constraint : project.constraints)
    for (const CellId id : cells_of(constraint)) ids.push_back(id);
  for (const Hold& hold : holds) ids.push_back(hold.cell);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// The first of the set that a number is in; `first` are its members' ways to it.
int first_of(std::vector<int>& first, int number) {
  while (first[std::size_t(number)] != number) {
    int& next = first[std::size_t(number)];
    next = first[std::size_t(next)];
    number = next;
  }
  return number;
}

}  // namespace

Rig::Rig(const Project& project, const CellStates& states, std::span<const Hold> holds) {
  const std::vector<CellId> ids = concerned(project, holds);
  const auto take = [&](const Cell& cell) {
    if (!std::binary_search(ids.begin(), ids.end(), cell.id)) return;
    const auto state = states.find(cell.id);
    if (state == states.end()) return;
    RigCell taken;
    taken.id = cell.id;
    taken.pivot = cell.pivot;
    taken.scale = state->second.scale;
    taken.place = state->second.place;
    taken.set_angle(state->second.angle);
    numbers_.push_back({cell.id, int(cells.size())});
    cells.push_back(taken);
  };
  take(project.camera);
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells) take(cell);
  std::sort(numbers_.begin(), numbers_.end());
  hang(project);
  sort();
}

void Rig::hang(const Project& project) {
  std::vector<int> first(cells.size());
  std::iota(first.begin(), first.end(), 0);
  for (const Constraint& constraint : project.constraints) {
    const auto* joint = std::get_if<Joint>(&constraint.what);
    if (!joint) continue;
    const int parent = find(joint->parent), child = find(joint->child);
    if (parent < 0 || child < 0) continue;
    if (cells[std::size_t(child)].parent >= 0 || first_of(first, parent) == child) {
      left_out_.push_back({joint->parent, joint->child, joint->on_parent, joint->on_child});
      continue;
    }
    first[std::size_t(child)] = parent;
    RigCell& hung = cells[std::size_t(child)];
    const RigCell& from = cells[std::size_t(parent)];
    hung.parent = parent;
    hung.pin_on_parent = from.offset_of(joint->on_parent);
    hung.pin = hung.offset_of(joint->on_child);
    hung.relative = hung.angle - from.angle;
    if (joint->limits) {
      hung.least = joint->limits->least;
      hung.greatest = std::max(joint->limits->least, joint->limits->greatest);
    }
  }
}

void Rig::sort() {
  const std::size_t count = cells.size();
  std::vector<std::vector<int>> children(count);
  std::vector<int> order, place(count);
  for (std::size_t k = 0; k < count; ++k)
    if (cells[k].parent >= 0) children[std::size_t(cells[k].parent)].push_back(int(k));
  for (std::size_t k = 0; k < count; ++k) {
    if (cells[k].parent >= 0) continue;
    std::size_t next = order.size();
    order.push_back(int(k));
    for (; next < order.size(); ++next)
      for (const int child : children[std::size_t(order[next])]) order.push_back(child);
  }
  std::vector<RigCell> sorted;
  sorted.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    place[std::size_t(order[k])] = int(k);
    RigCell cell = cells[std::size_t(order[k])];
    if (cell.parent >= 0) cell.parent = place[std::size_t(cell.parent)];
    cell.root = cell.parent < 0 ? int(k) : sorted[std::size_t(cell.parent)].root;
    sorted.push_back(cell);
  }
  cells = std::move(sorted);
  for (std::size_t k = count; k-- > 0;)
    if (cells[k].parent >= 0) cells[std::size_t(cells[k].parent)].below += cells[k].below;
  for (auto& [id, number] : numbers_) number = place[std::size_t(number)];
}

int Rig::find(CellId id) const {
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), std::pair(id, -1));
  return found != numbers_.end() && found->first == id ? found->second : -1;
}

int Rig::end_of(int root) const { return root + cells[std::size_t(root)].below; }

void Rig::settle(int root) {
  RigCell& first = cells[std::size_t(root)];
  first.set_angle(first.angle);
  for (int k = root + 1; k < end_of(root); ++k) {
    RigCell& cell = cells[std::size_t(k)];
    const RigCell& parent = cells[std::size_t(cell.parent)];
    if (cell.keeps_angle) cell.relative = cell.kept - parent.angle;
    cell.relative = cell.limited(cell.relative);
    cell.set_angle(parent.angle + cell.relative);
    cell.place = parent.point(cell.pin_on_parent) - cell.turned(cell.pin);
  }
}

void Rig::settle_all() {
  for (int root = 0; root < int(cells.size()); root = end_of(root)) settle(root);
}

void Rig::write(CellStates& states) const {
  for (const RigCell& cell : cells) {
    CellState& state = states[cell.id];
    state.place = cell.place;
    state.angle = cell.angle;
  }
}

double Rig::left_out() const {
  double most = 0;
  for (const LeftOut& joint : left_out_) {
    const RigCell& parent = cells[std::size_t(find(joint.parent))];
    const RigCell& child = cells[std::size_t(find(joint.child))];
    most = std::max(
        most, (parent.point(parent.offset_of(joint.on_parent)) - child.point(child.offset_of(joint.on_child)))
                  .norm());
  }
  return most;
}

}  // namespace icome::animation
