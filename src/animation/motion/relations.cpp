#include "animation/motion/relations.h"

#include <algorithm>
#include <numeric>

#include "animation/motion/cell_point.h"
#include "animation/motion/pushes.h"

namespace icome::animation {
namespace {

constexpr int kSteps = 40;
constexpr int kSlowSteps = 4;           // that gain little, after which a compromise is taken
constexpr double kKept = 1e-7;          // px
constexpr double kNoWay = 1e-9;         // px, below which a direction is not told
constexpr double kNear = 4;             // violations, within which others may come to be violated
constexpr double kLeastDamping = 1e-6;  // of squares of freedoms' shares
constexpr double kMostDamping = 1e3;
constexpr double kLargestTurn = 0.5;  // rad, in one step
constexpr int kLimitRounds = 5;
constexpr double kAtLimit = 1e-9;        // rad
constexpr double kImmovable = 1e-14;     // square of what freedoms move a relation by
constexpr std::size_t kRowsAtOnce = 64;  // that are solved together
constexpr double kTie = 1e-6;            // px, within which branches of a way are one

}  // namespace

Relations::Relations(const Project& project, Rig& rig) : rig_(rig) {
  const auto add = [&](Relation relation, CellId one, const PointOnCell& on_one) {
    relation.one = rig_.find(one);
    if (relation.one < 0) return;
    relation.on_one = rig_.cells[std::size_t(relation.one)].offset_of(on_one);
    relations_.push_back(relation);
  };
  for (const Constraint& constraint : project.constraints) {
    Relation relation;
    if (const auto* limit = std::get_if<DistanceLimit>(&constraint.what)) {
      relation.kind = Relation::Kind::Distance;
      relation.other = rig_.find(limit->other);
      if (relation.other < 0) continue;
      relation.on_other = rig_.cells[std::size_t(relation.other)].offset_of(limit->on_other);
      const double least = std::max(limit->least, 0.0), greatest = std::max(limit->greatest, least);
      relation.is_even = least == greatest;
      relation.distance = greatest;
      add(relation, limit->one, limit->on_one);
      if (relation.is_even || least == 0) continue;
      relation.distance = least;
      relation.is_least = true;
      add(relation, limit->one, limit->on_one);
    } else if (const auto* guide = std::get_if<PathGuide>(&constraint.what)) {
      relation.kind = Relation::Kind::Path;
      relation.way = int(ways_.size());
      relation.turns = guide->turns;
      ways_.emplace_back(guide->way, guide->closed);
      if (!ways_.back().is_empty()) add(relation, guide->cell, guide->on_cell);
    } else if (const auto* axis = std::get_if<AxisGuide>(&constraint.what)) {
      relation.kind = Relation::Kind::Axis;
      relation.through = axis->through;
      relation.normal = turned({0, 1}, axis->direction);
      add(relation, axis->cell, axis->on_cell);
    }
  }
  if (relations_.empty()) return;
  find_levers();
  gather_islands();
}

void Relations::find_levers() {
  levers_.assign(rig_.cells.size(), 1);
  const auto reaches = [&](int cell, const Vector2& offset) {
    double& lever = levers_[std::size_t(cell)];
    lever = std::max(lever, (offset - rig_.cells[std::size_t(cell)].pin).norm());
  };
  for (const RigCell& cell : rig_.cells)
    if (cell.parent >= 0) reaches(cell.parent, cell.pin_on_parent);
  for (const Relation& relation : relations_) {
    reaches(relation.one, relation.on_one);
    if (relation.other >= 0) reaches(relation.other, relation.on_other);
  }
}

void Relations::gather_islands() {
  const std::size_t count = rig_.cells.size();
  std::vector<int> group(count);
  std::iota(group.begin(), group.end(), 0);
  const auto group_of = [&](int cell) {
    int root = rig_.cells[std::size_t(cell)].root;
    while (group[std::size_t(root)] != root) {
      int& next = group[std::size_t(root)];
      next = group[std::size_t(next)];
      root = next;
    }
    return root;
  };
  for (const Relation& relation : relations_)
    if (relation.other >= 0) {
      const int one = group_of(relation.one), other = group_of(relation.other);
      group[std::size_t(std::max(one, other))] = std::min(one, other);
    }
  std::vector<int> island_of(count, -1);
  for (std::size_t k = 0; k < relations_.size(); ++k) {
    int& island = island_of[std::size_t(group_of(relations_[k].one))];
    if (island < 0) {
      island = int(islands_.size());
      islands_.emplace_back();
    }
    islands_[std::size_t(island)].relations.push_back(int(k));
  }
  freedom_of_root_.assign(count, 0);
  for (int root = 0; root < int(count); root = rig_.end_of(root)) {
    const int number = island_of[std::size_t(group_of(root))];
    if (number < 0) continue;
    Island& island = islands_[std::size_t(number)];
    island.roots.push_back(root);
    freedom_of_root_[std::size_t(root)] = int(island.freedoms);
    island.freedoms += std::size_t(rig_.end_of(root) - root) + 1;
  }
}

void Relations::start(const CellStates* before) {
  for (Relation& relation : relations_) {
    if (relation.kind != Relation::Kind::Path) continue;
    RigCell& cell = rig_.cells[std::size_t(relation.one)];
    const Way& way = ways_[std::size_t(relation.way)];
    const Vector2 place = cell.point(relation.on_one);
    const CellState* was = nullptr;
    if (before) {
      const auto found = before->find(cell.id);
      if (found != before->end()) was = &found->second;
    }
    if (was) {
      const double grown = cell.scale == 0 ? 0 : was->scale / cell.scale;
      const Vector2 bead = was->place + turned(grown * relation.on_one, was->angle);
      relation.s = way.slid_in_a_frame(way.nearest(bead, place - bead, kTie), place);
      relation.has_before = true;
      relation.angle_before = was->angle;
    } else {
      relation.s = way.nearest(place);
    }
    relation.waits = true;
    if (cell.parent >= 0) continue;
    cell.place += way.at(relation.s) - place;
    relation.waits = false;
    rig_.settle(relation.one);
  }
}

void Relations::follow_way(Relation& relation) {
  RigCell& cell = rig_.cells[std::size_t(relation.one)];
  const Way& way = ways_[std::size_t(relation.way)];
  const Vector2 place = cell.point(relation.on_one);
  if (!relation.waits) relation.s = way.slid(relation.s, place);
  if (!relation.turns || cell.parent >= 0 || way.length() <= 0) return;
  const double angle = way.angle(relation.s);
  cell.set_angle(relation.has_before ? unwrapped(angle, relation.angle_before) : angle);
  cell.place = place - cell.turned(relation.on_one);
}

void Relations::measure(Relation& relation) const {
  const Vector2 one = rig_.cells[std::size_t(relation.one)].point(relation.on_one);
  if (relation.kind == Relation::Kind::Axis) {
    relation.excess = relation.normal.dot(one - relation.through);
    return;
  }
  if (relation.kind == Relation::Kind::Path) {
    const Way& way = ways_[std::size_t(relation.way)];
    const Vector2 away = one - way.at(relation.s);
    relation.excess = away.norm();
    if (relation.excess > kNoWay) {
      relation.normal = away / relation.excess;
    } else {
      relation.normal = turned(way.direction(relation.s), M_PI / 2);
    }
    return;
  }
  const Vector2 apart = one - rig_.cells[std::size_t(relation.other)].point(relation.on_other);
  const double distance = apart.norm();
  const Vector2 along = distance > kNoWay ? Vector2(apart / distance) : Vector2(1, 0);
  relation.excess = relation.is_least ? relation.distance - distance : distance - relation.distance;
  relation.normal = relation.is_least ? Vector2(-along) : along;
}

double Relations::measure(const Island& island) {
  bool turned_any = false;
  for (const int k : island.relations) {
    Relation& relation = relations_[std::size_t(k)];
    if (relation.kind != Relation::Kind::Path) continue;
    follow_way(relation);
    turned_any = turned_any || relation.turns;
  }
  if (turned_any)
    for (const int root : island.roots) rig_.settle(root);
  double squares = 0;
  for (const int k : island.relations) {
    Relation& relation = relations_[std::size_t(k)];
    measure(relation);
    squares += relation.violation() * relation.violation();
  }
  return squares;
}

double Relations::worst(const Island& island) const {
  double most = 0;
  for (const int k : island.relations) most = std::max(most, relations_[std::size_t(k)].violation());
  return most;
}

double Relations::worst() const {
  double most = 0;
  for (const Island& island : islands_) most = std::max(most, worst(island));
  return most;
}

void Relations::keep() {
  for (const Island& island : islands_) {
    keep(island, false);
    if (worst(island) > kKept) keep(island, true);
  }
}

Relations::Pose Relations::pose_of(const Island& island) const {
  Pose pose;
  pose.values.reserve(2 * island.freedoms + island.relations.size());
  for (const int root : island.roots) {
    const RigCell& first = rig_.cells[std::size_t(root)];
    pose.values.insert(pose.values.end(), {first.place.x(), first.place.y(), first.angle});
    for (int k = root + 1; k < rig_.end_of(root); ++k) {
      const RigCell& cell = rig_.cells[std::size_t(k)];
      pose.values.push_back(cell.keeps_angle ? cell.kept : cell.relative);
    }
  }
  for (const int k : island.relations) pose.values.push_back(relations_[std::size_t(k)].s);
  return pose;
}

void Relations::restore(const Island& island, const Pose& pose) {
  auto value = pose.values.begin();
  for (const int root : island.roots) {
    RigCell& first = rig_.cells[std::size_t(root)];
    first.place.x() = *value++;
    first.place.y() = *value++;
    first.angle = *value++;
    for (int k = root + 1; k < rig_.end_of(root); ++k) {
      RigCell& cell = rig_.cells[std::size_t(k)];
      (cell.keeps_angle ? cell.kept : cell.relative) = *value++;
    }
    rig_.settle(root);
  }
  for (const int k : island.relations) relations_[std::size_t(k)].s = *value++;
}

void Relations::keep(const Island& island, bool with_hands) {
  weigh(island, with_hands);
  double squares = measure(island);
  double damping = kLeastDamping;
  int slow = 0;
  const std::size_t count = island.relations.size();
  for (int round = 0; round < kSteps && worst(island) > kKept; ++round) {
    const double squares_before = squares;
    bool has_moved = false;
    for (std::size_t from = 0; from < count; from += kRowsAtOnce) {
      const Pose pose = pose_of(island);
      if (!step(island, from, std::min(count, from + kRowsAtOnce), damping)) continue;
      const double now = measure(island);
      if (now < squares) {
        squares = now;
        has_moved = true;
      } else {
        restore(island, pose);
        measure(island);
      }
    }
    damping = has_moved ? std::max(kLeastDamping, damping / 10) : damping * 30;
    if (damping > kMostDamping) return;
    slow = squares > 0.99 * squares_before ? slow + 1 : 0;
    if (has_moved && slow >= kSlowSteps) return;
  }
}

/// Shares in which freedoms give way: as if every cell weighed the same.
void Relations::weigh(const Island& island, bool with_hands) {
  weights_.assign(island.freedoms, 0);
  for (const int root : island.roots) {
    const auto first = std::size_t(freedom_of_root_[std::size_t(root)]);
    const RigCell& cell = rig_.cells[std::size_t(root)];
    if (with_hands || !cell.held) weights_[first] = weights_[first + 1] = 1.0 / cell.below;
    for (int k = root + 1; k < rig_.end_of(root); ++k) {
      const RigCell& hung = rig_.cells[std::size_t(k)];
      const double lever = levers_[std::size_t(k)];
      if (with_hands || !hung.held)
        weights_[first + 1 + std::size_t(k - root)] = 1.0 / (hung.below * lever * lever);
    }
  }
}

/// The motion of a point of a cell along a direction with each freedom.
void Relations::add_row(int cell, const Vector2& offset, const Vector2& along, double* row) const {
  const int root = rig_.cells[std::size_t(cell)].root;
  const int first = freedom_of_root_[std::size_t(root)];
  Vector2 point = rig_.cells[std::size_t(cell)].point(offset);
  for (int k = cell; k != root; k = rig_.cells[std::size_t(k)].parent) {
    const RigCell& turning = rig_.cells[std::size_t(k)];
    const Vector2 pin = turning.pin_place();
    const Vector2 lever = point - pin;
    row[first + 1 + k - root] += along.x() * lever.y() - along.y() * lever.x();
    if (turning.keeps_angle) point = pin;
  }
  row[first] += along.x();
  row[first + 1] += along.y();
}

bool Relations::step(const Island& island, std::size_t from, std::size_t to, double damping) {
  double violation = 0;
  for (const int k : island.relations) violation += relations_[std::size_t(k)].violation();
  std::vector<int> rows;
  for (std::size_t k = from; k < to; ++k) {
    const Relation& relation = relations_[std::size_t(island.relations[k])];
    if (relation.is_even || relation.excess > -kNear * violation) rows.push_back(island.relations[k]);
  }
  const std::size_t freedoms = island.freedoms;
  rows_.assign(rows.size() * freedoms, 0);
  touched_.resize(std::max(touched_.size(), rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Relation& relation = relations_[std::size_t(rows[r])];
    double* row = &rows_[r * freedoms];
    add_row(relation.one, relation.on_one, relation.normal, row);
    if (relation.other >= 0) add_row(relation.other, relation.on_other, -relation.normal, row);
    touched_[r].clear();
    for (std::size_t f = 0; f < freedoms; ++f)
      if (row[f] != 0) touched_[r].push_back(f);
  }
  // Cells that would turn past a limit are kept out.
  free_ = weights_;
  bool is_pushed = solve_rows(rows, freedoms, damping);
  for (int round = 0; round < kLimitRounds && block_limits(island); ++round)
    is_pushed = solve_rows(rows, freedoms, damping);
  if (!is_pushed) return false;
  move(island);
  return true;
}

/// Takes freedoms out that are at a limit and would turn past it; false: there are none.
bool Relations::block_limits(const Island& island) {
  bool has_blocked = false;
  for (const int root : island.roots) {
    const auto first = std::size_t(freedom_of_root_[std::size_t(root)]);
    for (int k = root + 1; k < rig_.end_of(root); ++k) {
      const RigCell& cell = rig_.cells[std::size_t(k)];
      const std::size_t f = first + 1 + std::size_t(k - root);
      const bool is_out = (by_[f] > 0 && cell.relative >= cell.greatest - kAtLimit) ||
                          (by_[f] < 0 && cell.relative <= cell.least + kAtLimit);
      if (!is_out) continue;
      free_[f] = 0;
      has_blocked = true;
    }
  }
  return has_blocked;
}

/// Changes of freedoms (by_) that keep relations to first order, by as little as can be; false: none can.
bool Relations::solve_rows(const std::vector<int>& rows, std::size_t freedoms, double damping) {
  const std::size_t count = rows.size();
  weighted_.assign(count * freedoms, 0);
  products_.resize(count * count);
  for (std::size_t a = 0; a < count; ++a) {
    const double* row = &rows_[a * freedoms];
    double* weighted = &weighted_[a * freedoms];
    for (const std::size_t f : touched_[a]) weighted[f] = free_[f] * row[f];
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0;
      for (const std::size_t f : touched_[b]) sum += weighted[f] * rows_[b * freedoms + f];
      products_[a * count + b] = products_[b * count + a] = sum;
    }
  }
  std::vector<PushRow> push_rows(count);
  for (std::size_t a = 0; a < count; ++a) {
    const Relation& relation = relations_[std::size_t(rows[a])];
    push_rows[a] = {relation.excess, relation.is_even, products_[a * count + a] > kImmovable};
    products_[a * count + a] += damping;
  }
  const std::vector<double> pushes = pushes_of(products_, push_rows);
  by_.assign(freedoms, 0);
  bool is_pushed = false;
  for (std::size_t a = 0; a < count; ++a) {
    if (!push_rows[a].moves || pushes[a] == 0) continue;
    is_pushed = true;
    relations_[std::size_t(rows[a])].waits = false;
    const double* weighted = &weighted_[a * freedoms];
    for (const std::size_t f : touched_[a]) by_[f] += weighted[f] * pushes[a];
  }
  return is_pushed;
}

void Relations::move(const Island& island) {
  double largest = 0;
  for (const int root : island.roots) {
    const auto first = std::size_t(freedom_of_root_[std::size_t(root)]);
    for (int k = root + 1; k < rig_.end_of(root); ++k)
      largest = std::max(largest, std::abs(by_[first + 1 + std::size_t(k - root)]));
  }
  const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
  for (const int root : island.roots) {
    const auto first = std::size_t(freedom_of_root_[std::size_t(root)]);
    rig_.cells[std::size_t(root)].place += share * Vector2(by_[first], by_[first + 1]);
    for (int k = root + 1; k < rig_.end_of(root); ++k) {
      RigCell& cell = rig_.cells[std::size_t(k)];
      const double turn = share * by_[first + 1 + std::size_t(k - root)];
      if (cell.keeps_angle) {
        cell.kept = cell.angle + turn;
      } else {
        cell.relative += turn;
      }
    }
    rig_.settle(root);
  }
}

}  // namespace icome::animation
