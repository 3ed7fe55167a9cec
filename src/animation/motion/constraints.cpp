#include "animation/motion/constraints.h"

#include <algorithm>

#include "animation/motion/cell_point.h"
#include "animation/motion/reach.h"
#include "animation/motion/relations.h"
#include "animation/motion/rig.h"

namespace icome::animation {
namespace {

/// Cells of a rig that are a chain, the first one first; empty where one is not there or not joined.
std::vector<int> chain_in(const Rig& rig, const Chain& chain) {
  std::vector<int> numbers;
  for (const CellId id : chain.cells) {
    const int number = rig.find(id);
    if (number < 0) return {};
    if (!numbers.empty() && rig.cells[std::size_t(number)].parent != numbers.back()) return {};
    numbers.push_back(number);
  }
  return numbers;
}

/// The cells in hands, which it gives to them.
class Holding {
 public:
  Holding(const Project& project, Rig& rig, std::span<const Hold> holds, const CellStates* before)
      : rig_(rig), before_(before), hold_of_(rig.cells.size(), nullptr) {
    for (const Constraint& constraint : project.constraints)
      if (const auto* chain = std::get_if<Chain>(&constraint.what)) {
        std::vector<int> numbers = chain_in(rig, *chain);
        if (numbers.size() >= 2) chains_.push_back(std::move(numbers));
      }
    for (const Hold& hold : holds) {
      const int number = rig.find(hold.cell);
      if (number >= 0) hold_of_[std::size_t(number)] = &hold;
    }
  }

  void take() {
    for (int k = 0; k < int(rig_.cells.size()); ++k)
      if (hold_of_[std::size_t(k)]) take(k, *hold_of_[std::size_t(k)]);
  }

 private:
  RigCell& cell(int number) { return rig_.cells[std::size_t(number)]; }

  void take(int number, const Hold& hold) {
    RigCell& held = cell(number);
    const std::vector<int> turning = bending(number);
    if (held.parent < 0) {
      held.place = hold.wish.place;
      held.angle = hold.wish.angle;
      held.held = true;
      rig_.settle(number);
    } else if (!turning.empty()) {
      bring(turning, hold);
      for (int k = number; k >= 0; k = cell(k).parent) cell(k).held = true;
    } else if (hold.pulled) {
      bring({number}, hold);
      held.held = held.keeps_angle = true;
      held.kept = held.angle;
    } else {
      held.held = held.keeps_angle = true;
      held.kept = hold.wish.angle;
      rig_.settle(held.root);
    }
  }

  /// Cells of the chain that turn for a held one, itself the last; none where it is in no chain or its first.
  std::vector<int> bending(int number) const {
    for (const std::vector<int>& chain : chains_) {
      const auto found = std::find(chain.begin(), chain.end(), number);
      if (found == chain.end() || found == chain.begin()) continue;
      auto from = found;
      while (from != chain.begin() && !hold_of_[std::size_t(*(from - 1))]) --from;
      return {from, found + 1};
    }
    return {};
  }

  /// Turns cells so that a hold comes to its hand, from how they were the frame before.
  void bring(const std::vector<int>& turning, const Hold& hold) {
    bool continues = before_ != nullptr;
    for (const int k : turning) continues = continues && bend_as_before(k);
    rig_.settle(cell(turning.front()).root);
    const RigCell& last = cell(turning.back());
    ArmWish wish;
    wish.turning = turning;
    if (hold.pulled) wish.offset = last.offset_of(*hold.pulled);
    wish.target = hold.wish.place + turned(wish.offset, hold.wish.angle);
    if (!hold.pulled) wish.angle = hold.wish.angle;
    reach(rig_, wish, continues);
  }

  bool bend_as_before(int number) {
    RigCell& turning = cell(number);
    const auto was = before_->find(turning.id);
    if (was == before_->end()) return false;
    if (turning.parent < 0) return true;
    const auto parent_was = before_->find(cell(turning.parent).id);
    if (parent_was == before_->end()) return false;
    turning.relative = was->second.angle - parent_was->second.angle;
    return true;
  }

  Rig& rig_;
  const CellStates* before_;
  std::vector<const Hold*> hold_of_;  // by number
  std::vector<std::vector<int>> chains_;
};

}  // namespace

Solution solved(const Project& project, const CellStates& states, std::span<const Hold> holds,
                const CellStates* before) {
  Solution solution = {states, 0};
  if (project.constraints.empty() && holds.empty()) return solution;
  Rig rig(project, states, holds);
  rig.settle_all();
  Holding(project, rig, holds, before).take();
  Relations relations(project, rig);
  relations.start(before);
  relations.keep();
  rig.write(solution.states);
  solution.residual = std::max(relations.worst(), rig.left_out());
  return solution;
}

Solution solved(const Project& project, const CellStates& wished, std::span<const CellId> held,
                const CellStates* before) {
  CellStates states = wished;
  std::vector<Hold> holds;
  for (const CellId id : held) {
    const auto wish = wished.find(id);
    if (wish == wished.end()) continue;
    holds.push_back({id, wish->second});
    if (!before) continue;
    const auto was = before->find(id);
    if (was == before->end()) continue;
    states[id].place = was->second.place;
    states[id].angle = was->second.angle;
  }
  return solved(project, states, holds, before);
}

}  // namespace icome::animation
