// Queries of a CollisionIndex.
#include "world/collision/collisions.h"

#include <algorithm>
#include <utility>

namespace icome::world {
namespace {

// Gap, as a share of their coordinates, at which boxes may still touch: twice that of shapes.
constexpr double kBoxRounding = 2e-10;

Bounds with_slack(const Bounds& box) {
  if (box.isEmpty()) return box;
  const double slack = kBoxRounding * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return {box.min() - Vector3::Constant(slack), box.max() + Vector3::Constant(slack)};
}

}  // namespace

/// A walk through pairs of subtrees whose bounds meet. The subtree on the first side may be moved.
class CollisionIndex::Query {
 public:
  /// Returns whether to go on.
  using Visitor = std::function<bool(const Collision&)>;

  Query(CollisionIndex& index, Visitor visitor) : index_(index), visitor_(std::move(visitor)) {}

  /// Compares the subtree, moved by `moved` in the world's frame, with all outside of it.
  void against_world(Slot root, const std::optional<Affine3>& moved) {
    root_ = root;
    moved_ = moved;
    if (moved_) back_ = moved_->inverse();
    push({root, false}, {kWorld, false});
    for (const Slot slot : index_.unlimited_) {
      if (index_.is_below(slot, root)) {
        push_always({slot, true}, {kWorld, false});
        for (const Slot other : index_.unlimited_) {
          if (!index_.is_below(other, root)) push_always({slot, true}, {other, true});
        }
      } else {
        push_always({root, false}, {slot, true});
      }
    }
    walk();
  }

  /// Compares the objects of the subtree with each other.
  void within(Slot root) {
    std::vector<Slot> below{root};
    while (!below.empty() && going_) {
      const Slot slot = below.back();
      below.pop_back();
      among_children(slot, below);
      walk();
    }
    std::vector<Slot> unlimited;
    for (const Slot slot : index_.unlimited_) {
      if (!index_.is_below(slot, root)) continue;
      push_always({slot, true}, {root, false});
      for (const Slot other : unlimited) push_always({slot, true}, {other, true});
      unlimited.push_back(slot);
    }
    walk();
  }

 private:
  /// A subtree, or the shape of its uppermost object alone.
  struct Side {
    Slot slot;
    bool alone;
  };

  const Node& node(const Side& side) const { return index_.nodes_[side.slot]; }
  const Bounds& box(const Side& side) const { return side.alone ? node(side).own : node(side).all; }
  Bounds moved_box(const Side& side) const {
    return moved_ && !box(side).isEmpty() ? box(side).transformed(*moved_) : box(side);
  }

  void push_always(const Side& one, const Side& other) { stack_.emplace_back(one, other); }
  void push(const Side& one, const Side& other) {
    if (with_slack(moved_box(one)).intersects(box(other))) push_always(one, other);
  }

  void walk() {
    while (!stack_.empty() && going_) {
      const auto [one, other] = stack_.back();
      stack_.pop_back();
      if (one.alone && other.alone)
        meet(one.slot, other.slot);
      else if (other.alone || (!one.alone && !holds_root(other) && larger(one, other)))
        enter_one(one, other);
      else
        enter_other(one, other);
    }
    stack_.clear();
  }

  /// Does the subtree contain the first side's root? Then it must be split before it is compared.
  bool holds_root(const Side& side) const { return root_ != kNone && index_.is_below(root_, side.slot); }
  bool larger(const Side& one, const Side& other) const {
    return box(one).diagonal().squaredNorm() > box(other).diagonal().squaredNorm();
  }
  bool without_end(const Side& side) const {
    return side.alone && node(side).geometry && index_.shapes_.at(node(side).geometry).shape.unlimited();
  }

  void enter_one(const Side& one, const Side& other) {
    ++index_.work_.entered;
    if (node(one).geometry && !node(one).own.isEmpty()) push_alone(one, other, true);
    Bounds near = without_end(other) ? node(one).all : with_slack(box(other));
    if (moved_ && !without_end(other)) near = with_slack(near.transformed(back_));
    node(one).children.meeting(near, [&](Slot child) { push_always({child, false}, other); });
  }

  void enter_other(const Side& one, const Side& other) {
    ++index_.work_.entered;
    if (node(other).geometry && !node(other).own.isEmpty()) push_alone(one, other, false);
    const Bounds near = without_end(one) ? node(other).all : with_slack(moved_box(one));
    node(other).children.meeting(near, [&](Slot child) {
      if (child != root_) push_always(one, {child, false});
    });
  }

  void push_alone(const Side& one, const Side& other, bool first) {
    const Side left = first ? Side{one.slot, true} : one;
    const Side right = first ? other : Side{other.slot, true};
    if (without_end(left) || without_end(right))
      push_always(left, right);
    else
      push(left, right);
  }

  void among_children(Slot slot, std::vector<Slot>& below) {
    ++index_.work_.entered;
    const Node& at = index_.nodes_[slot];
    at.children.meeting(at.all, [&](Slot child) {
      below.push_back(child);
      if (!at.own.isEmpty()) push({slot, true}, {child, false});
      at.children.meeting(with_slack(index_.nodes_[child].all), [&](Slot sibling) {
        if (child < sibling) push_always({child, false}, {sibling, false});
      });
    });
  }

  void meet(Slot one, Slot other) {
    if (one == other) return;
    ++index_.work_.shapes;
    const Node& a = index_.nodes_[one];
    const Node& b = index_.nodes_[other];
    const Affine3 world_from_a = moved_ ? *moved_ * a.world_from_object : a.world_from_object;
    const Meeting found = meeting({index_.shapes_.at(a.geometry).shape, world_from_a},
                                  {index_.shapes_.at(b.geometry).shape, b.world_from_object});
    if (found != Meeting::Apart) going_ = visitor_({a.id, b.id, found});
  }

  CollisionIndex& index_;
  Visitor visitor_;
  std::vector<std::pair<Side, Side>> stack_;
  Slot root_ = kNone;  // of the first side, where the second may hold it
  std::optional<Affine3> moved_ = std::nullopt;
  Affine3 back_ = Affine3::Identity();
  bool going_ = true;
};

std::vector<Collision> CollisionIndex::collisions(ObjectId root, const std::optional<Affine3>& place) {
  std::vector<Collision> result;
  const auto found = slots_.find(root);
  if (found == slots_.end()) return result;
  std::optional<Affine3> moved;
  if (place) moved = *place * nodes_[found->second].world_from_object.inverse();
  Query(*this, [&](const Collision& it) {
    result.push_back(it);
    return true;
  }).against_world(found->second, moved);
  std::sort(result.begin(), result.end());
  return result;
}

bool CollisionIndex::overlaps(ObjectId root, const std::optional<Affine3>& place) {
  const auto found = slots_.find(root);
  if (found == slots_.end()) return false;
  std::optional<Affine3> moved;
  if (place) moved = *place * nodes_[found->second].world_from_object.inverse();
  bool overlapping = false;
  Query(*this, [&](const Collision& it) {
    overlapping = it.meeting == Meeting::Overlapping;
    return !overlapping;
  }).against_world(found->second, moved);
  return overlapping;
}

std::vector<Collision> CollisionIndex::collisions_within(ObjectId root) {
  std::vector<Collision> result;
  const auto found = slots_.find(root);
  if (root && found == slots_.end()) return result;
  Query(*this, [&](const Collision& it) {
    result.push_back(it);
    if (result.back().other < result.back().one) std::swap(result.back().one, result.back().other);
    return true;
  }).within(root ? found->second : kWorld);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<CollisionIndex::Standing> CollisionIndex::standing_below(Slot root, const Bounds& box) {
  std::vector<Standing> result;
  std::vector<Slot> below{root};
  while (!below.empty()) {
    const Slot slot = below.back();
    below.pop_back();
    Node& node = nodes_[slot];
    if (node.geometry && node.own.intersects(box))
      result.push_back({node.id, &shapes_.at(node.geometry).shape, node.world_from_object});
    node.children.meeting(box, [&](Slot child) { below.push_back(child); });
  }
  for (const Slot slot : unlimited_) {
    if (is_below(slot, root))
      result.push_back(
          {nodes_[slot].id, &shapes_.at(nodes_[slot].geometry).shape, nodes_[slot].world_from_object});
  }
  std::sort(result.begin(), result.end(), [](const Standing& a, const Standing& b) { return a.id < b.id; });
  return result;
}

std::vector<CollisionIndex::Standing> CollisionIndex::standing(ObjectId root) {
  const auto found = slots_.find(root);
  if (root && found == slots_.end()) return {};
  const Slot slot = root ? found->second : kWorld;
  return standing_below(slot, nodes_[slot].all);
}

std::vector<CollisionIndex::Standing> CollisionIndex::standing_in(const Bounds& box) {
  return standing_below(kWorld, box);
}

}  // namespace icome::world
