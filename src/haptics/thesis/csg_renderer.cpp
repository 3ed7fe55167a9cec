#include "haptics/thesis/csg_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "haptics/shapes/element.h"

namespace icome::haptics {
namespace {

using base::fail;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::SurfacePoint;

constexpr std::uint32_t kInner = 0xffffffff;
constexpr double kThreshold = 50.0;  // algorithm 5.1

// Flags of a node for one point.
constexpr std::uint8_t kInside = 1;
constexpr std::uint8_t kNeeded = 2;  // its SCP is needed

// Nodes that a tick may visit: two evaluations of the largest tree, and tests between operands.
constexpr std::int64_t kMostLooks = 4 * std::int64_t(CsgWorkspace::kMostNodes);

}  // namespace

CsgWorkspace::CsgWorkspace() {
  for (Evaluation* at : {&at_pointer_, &at_candidate_}) {
    at->visited.reserve(kMostNodes);
    at->flags.resize(kMostNodes);
    at->scp.resize(kMostNodes, {Vector3::Zero(), Vector3::UnitZ()});
  }
}

base::Result<CsgRenderer> CsgRenderer::create(const CsgTree& tree) {
  const auto normalised = geometry::normalise(tree, geometry::CsgForm::Subnormal);
  if (!normalised) return tl::unexpected(normalised.error());
  const std::size_t nodes = geometry::count(normalised->tree).nodes;
  if (nodes > CsgWorkspace::kMostNodes)
    return fail(
        fmt::format("the sub-normal form of the CSG tree has {} nodes and the thesis renderer takes "
                    "{}: use the exact renderer or fewer operands",
                    nodes, CsgWorkspace::kMostNodes));
  CsgRenderer renderer;
  if (!normalised->tree.empty()) renderer.add_nodes(normalised->tree);
  renderer.find_boxes();
  return renderer;
}

void CsgRenderer::add_nodes(const CsgTree& tree) {
  struct Waiting {
    CsgTree::Index node;
    std::uint32_t parent;
    bool right;
  };
  const std::vector<base::Affine3> tree_from_node = tree.tree_from_node();
  std::vector<Waiting> stack{{tree.root(), 0, false}};
  while (!stack.empty()) {
    const Waiting next = stack.back();
    stack.pop_back();
    const auto index = std::uint32_t(nodes_.size());
    if (next.right) nodes_[next.parent].right = index;
    const CsgTree::Node& from = tree.node(next.node);
    Node node;
    node.parent = next.parent;
    node.leaf = kInner;
    if (from.is_leaf) {
      node.leaf = std::uint32_t(leaves_.size());
      leaves_.emplace_back(*from.shape, tree_from_node[next.node]);
    } else {
      node.op = from.op;
      stack.push_back({from.right, index, true});
      stack.push_back({from.left, index, false});
    }
    nodes_.push_back(node);
  }
}

void CsgRenderer::find_boxes() {
  double extent = 0.0;
  for (auto index = std::uint32_t(nodes_.size()); index-- > 0;) {
    Node& node = nodes_[index];
    if (node.leaf != kInner) {
      node.bounds = leaves_[node.leaf].bounds();
      node.end = index + 1;
      for (const Vector3& corner : {node.bounds.min(), node.bounds.max()})
        if (corner.allFinite()) extent = std::max(extent, corner.cwiseAbs().maxCoeff());
      continue;
    }
    const Node& left = nodes_[index + 1];
    const Node& right = nodes_[node.right];
    node.end = right.end;
    node.bounds = left.bounds;
    if (node.op == CsgOperator::Union) node.bounds.extend(right.bounds);
    if (node.op == CsgOperator::Intersection) node.bounds = left.bounds.intersection(right.bounds);
  }
  if (!nodes_.empty()) bounds_ = nodes_.front().bounds;
  gap_ = Tolerance::for_size(extent > 0.0 ? extent : 1.0).touching();
}

std::size_t CsgRenderer::bytes() const {
  return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(geometry::CsgLeaf);
}

bool CsgRenderer::leaf_holds(const Node& node, const Vector3& point) const {
  return leaves_[node.leaf].inside(point);
}

bool CsgRenderer::inside(const Vector3& point) const {
  std::int64_t looks = kMostLooks;
  return !nodes_.empty() && inside(0, point, looks);
}

// Goes down to the left, and up again with each answer to where the right operand must be asked too.
bool CsgRenderer::inside(std::uint32_t top, const Vector3& point, std::int64_t& looks) const {
  for (std::uint32_t at = top;;) {
    --looks;
    const bool near = nodes_[at].bounds.contains(point);
    if (near && nodes_[at].leaf == kInner) {
      ++at;
      continue;
    }
    bool value = near && leaf_holds(nodes_[at], point);
    while (at != top) {
      const std::uint32_t parent = nodes_[at].parent;
      const CsgOperator op = nodes_[parent].op;
      const bool from_left = at == parent + 1;
      if (from_left && value != (op == CsgOperator::Union)) {
        at = nodes_[parent].right;
        break;
      }
      if (!from_left && op == CsgOperator::Difference) value = !value;
      at = parent;
    }
    if (at == top) return value;
  }
}

/// Fills the flags of all nodes of a subtree that can hold the point.
void CsgRenderer::find_inside(std::uint32_t top, const Vector3& point, Evaluation& at,
                              std::int64_t& looks) const {
  at.visited.clear();
  for (std::uint32_t index = top; index < nodes_[top].end;) {
    at.visited.push_back(index);
    const Node& node = nodes_[index];
    const bool near = node.bounds.contains(point);
    at.flags[index] = near ? kInside : 0;
    index = near ? index + 1 : node.end;
  }
  looks -= std::int64_t(at.visited.size());
  for (auto place = at.visited.rbegin(); place != at.visited.rend(); ++place) {
    const Node& node = nodes_[*place];
    if (at.flags[*place] == 0) continue;
    bool value = false;
    if (node.leaf != kInner) {
      value = leaf_holds(node, point);
    } else {
      const bool left = at.flags[*place + 1] != 0;
      const bool right = at.flags[node.right] != 0;
      value = node.op == CsgOperator::Union          ? left || right
              : node.op == CsgOperator::Intersection ? left && right
                                                     : left && !right;
    }
    at.flags[*place] = value ? kInside : 0;
  }
}

/// Marks the nodes whose SCP is asked for; the top one holds the point.
void CsgRenderer::mark_needed(std::uint32_t top, Evaluation& at) const {
  at.flags[top] |= kNeeded;
  for (const std::uint32_t index : at.visited) {
    const Node& node = nodes_[index];
    if ((at.flags[index] & kNeeded) == 0 || node.leaf != kInner) continue;
    for (const std::uint32_t child : {index + 1, node.right})
      if ((at.flags[child] & kInside) != 0) at.flags[child] |= kNeeded;
  }
}

void CsgRenderer::find_scps(std::uint32_t top, const Vector3& point, Evaluation& at, Tick& tick) const {
  mark_needed(top, at);
  for (auto place = at.visited.rbegin(); place != at.visited.rend(); ++place) {
    if (tick.space.looks_left_ < 0) return;
    if ((at.flags[*place] & kNeeded) != 0) at.scp[*place] = node_scp(*place, point, at, tick);
  }
}

SurfacePoint CsgRenderer::node_scp(std::uint32_t index, const Vector3& point, Evaluation& at,
                                   Tick& tick) const {
  const Node& node = nodes_[index];
  if (node.leaf != kInner) return leaves_[node.leaf].scp_from_inside(point);
  const Vector3& previous = tick.memory.scp.point;
  if (node.op == CsgOperator::Intersection)
    return intersection_scp(at.scp[index + 1], at.scp[node.right], point, previous);
  if (node.op == CsgOperator::Difference)
    return difference_scp(at.scp[index + 1], leaves_[nodes_[node.right].leaf], point, previous);
  if (const auto found = union_scp(index, at, tick)) return *found;
  const bool again = &at == &tick.space.at_candidate_;
  return again ? tick.memory.scp : retry_union(index, tick);
}

/// Algorithm 5.1: the nearer SCP, unless it is much farther from the previous one than the other is.
SurfacePoint CsgRenderer::intersection_scp(const SurfacePoint& one, const SurfacePoint& two,
                                           const Vector3& point, const Vector3& previous) const {
  const bool one_nearer = (one.point - point).squaredNorm() < (two.point - point).squaredNorm();
  const SurfacePoint& nearer = one_nearer ? one : two;
  const SurfacePoint& other = one_nearer ? two : one;
  const double nearer_way = (nearer.point - previous).norm();
  const double other_way = (other.point - previous).norm();
  const bool jumps = nearer_way > 0.0 && nearer_way >= kThreshold * other_way;
  return jumps ? other : nearer;
}

/// Algorithm 5.2: the SCP nearer to the previous one; the right operand is felt from its inside.
SurfacePoint CsgRenderer::difference_scp(const SurfacePoint& left, const geometry::CsgLeaf& right,
                                         const Vector3& point, const Vector3& previous) const {
  const SurfacePoint hollow = right.scp_from_outside(point);
  if ((left.point - previous).squaredNorm() < (hollow.point - previous).squaredNorm()) return left;
  return {hollow.point, -hollow.normal};
}

/// The first half of algorithm 5.4, for the pointer or for the candidate: nothing when both SCPs may lie in
/// the other operand.
std::optional<SurfacePoint> CsgRenderer::union_scp(std::uint32_t index, const Evaluation& at,
                                                   Tick& tick) const {
  const std::uint32_t left = index + 1, right = nodes_[index].right;
  const bool in_left = (at.flags[left] & kInside) != 0, in_right = (at.flags[right] & kInside) != 0;
  bool take_left = in_left;
  if (in_left && in_right) {
    const Vector3& previous = tick.memory.scp.point;
    take_left =
        (at.scp[left].point - previous).squaredNorm() < (at.scp[right].point - previous).squaredNorm();
  }
  const SurfacePoint& chosen = at.scp[take_left ? left : right];
  if (buried(chosen, take_left ? right : left, tick)) return std::nullopt;
  return chosen;
}

/// The second half of algorithm 5.4: the SCP for a candidate, the previous SCP moved like the pointer.
SurfacePoint CsgRenderer::retry_union(std::uint32_t index, Tick& tick) const {
  Evaluation& at = tick.space.at_candidate_;
  find_inside(index, tick.candidate, at, tick.space.looks_left_);
  if ((at.flags[index] & kInside) == 0) return tick.memory.scp;
  find_scps(index, tick.candidate, at, tick);
  return at.scp[index];
}

/// Does an SCP lie in the other operand? Where both share a face it does not.
bool CsgRenderer::buried(const SurfacePoint& place, std::uint32_t other, Tick& tick) const {
  return inside(other, place.point + gap_ * place.normal, tick.space.looks_left_);
}

std::optional<CsgRenderer::Answer> CsgRenderer::scp(const Vector3& pointer, DirectMemory& memory,
                                                    CsgWorkspace& space) const {
  space.looks_left_ = kMostLooks;
  Evaluation& at = space.at_pointer_;
  if (!nodes_.empty()) find_inside(0, pointer, at, space.looks_left_);
  if (nodes_.empty() || (at.flags[0] & kInside) == 0) {
    memory = DirectMemory::free_at(pointer);
    return std::nullopt;
  }
  Tick tick{memory, space, memory.scp.point + (pointer - memory.pointer)};
  find_scps(0, pointer, at, tick);
  Answer answer{at.scp[0], space.looks_left_ < 0};
  if (answer.exhausted) answer.place = memory.scp;
  if (!memory.touching && answer.place.point == memory.scp.point) {
    // The previous SCP lay on no surface: the only normal known is the direction in which it pushes.
    const Vector3 out = answer.place.point - pointer;
    if (out.squaredNorm() > 0.0) answer.place.normal = out.normalized();
  }
  memory = {answer.place, pointer, true};
  return answer;
}

}  // namespace icome::haptics
