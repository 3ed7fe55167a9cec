#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"
#include "geometry/csg/csg_normal_form.h"
#include "haptics/thesis/direct_memory.h"

namespace icome::haptics {

/// Memory in which one thread evaluates trees, one at a time, taken once.
class CsgWorkspace {
 public:
  static constexpr std::size_t kMostNodes = 32'768;

  CsgWorkspace();

 private:
  friend class CsgRenderer;

  /// The state of the nodes for one point.
  struct Evaluation {
    std::vector<std::uint32_t> visited;       // nodes, parents first; the others were pruned
    std::vector<std::uint8_t> flags;          // by node, of those visited
    std::vector<geometry::SurfacePoint> scp;  // by node, of those whose SCP matters
  };
  Evaluation at_pointer_, at_candidate_;
  std::int64_t looks_left_ = 0;
};

/// Haptic rendering of CSG trees as in thesis section 5.5, algorithms 5.1 to 5.4 as corrected in the errata:
/// the SCPs of the operands, which answer only the three questions of 5.5, are combined upwards. A node
/// whose bounding box does not hold the point is skipped. Immutable; does not recurse.
///
/// In points on which the thesis is silent: a subtree that does not hold the pointer has no SCP to choose; a
/// union inside a union that retries with the same candidate does not retry once more; "not in the other
/// subtree" is tested a little outside the SCP, as operands may share a face.
class CsgRenderer {
 public:
  /// From a tree in any form; it is brought into sub-normal form (5.5.5). Fails when that is too large.
  static base::Result<CsgRenderer> create(const geometry::CsgTree& tree);

  const base::Bounds& bounds() const { return bounds_; }
  std::size_t nodes() const { return nodes_.size(); }
  std::size_t bytes() const;

  /// Is the point in the solid? Walks without memory of its own. Real-time safe.
  bool inside(const Vector3& point) const;

  struct Answer {
    geometry::SurfacePoint place;
    bool exhausted = false;  // the tree was too large for a tick: the SCP is the previous one
  };

  /// The SCP for a pointer inside the solid, nothing outside. Updates `memory`. Real-time safe.
  std::optional<Answer> scp(const Vector3& pointer, DirectMemory& memory, CsgWorkspace& space) const;

 private:
  using SurfacePoint = geometry::SurfacePoint;
  using Evaluation = CsgWorkspace::Evaluation;

  /// Parents stand before their children and the left operand directly after its parent, so that a subtree is
  /// a stretch of the array: forwards, parents come first; backwards, children do.
  struct Node {
    base::Bounds bounds;
    geometry::CsgOperator op = geometry::CsgOperator::Union;
    std::uint32_t leaf = 0;    // kInner, or the index of the leaf
    std::uint32_t parent = 0;  // the root's is itself
    std::uint32_t right = 0;   // the left operand is the next node
    std::uint32_t end = 0;     // first node behind the subtree
  };
  struct Tick {
    const DirectMemory& memory;
    CsgWorkspace& space;
    Vector3 candidate;
  };

  CsgRenderer() = default;
  void add_nodes(const geometry::CsgTree& tree);
  void find_boxes();

  bool inside(std::uint32_t top, const Vector3& point, std::int64_t& looks) const;
  bool leaf_holds(const Node& node, const Vector3& point) const;
  void find_inside(std::uint32_t top, const Vector3& point, Evaluation& at, std::int64_t& looks) const;
  void mark_needed(std::uint32_t top, Evaluation& at) const;
  void find_scps(std::uint32_t top, const Vector3& point, Evaluation& at, Tick& tick) const;
  SurfacePoint node_scp(std::uint32_t index, const Vector3& point, Evaluation& at, Tick& tick) const;
  SurfacePoint intersection_scp(const SurfacePoint& one, const SurfacePoint& two, const Vector3& point,
                                const Vector3& previous) const;
  SurfacePoint difference_scp(const SurfacePoint& left, const geometry::CsgLeaf& right, const Vector3& point,
                              const Vector3& previous) const;
  std::optional<SurfacePoint> union_scp(std::uint32_t index, const Evaluation& at, Tick& tick) const;
  SurfacePoint retry_union(std::uint32_t index, Tick& tick) const;
  bool buried(const SurfacePoint& place, std::uint32_t other, Tick& tick) const;

  std::vector<Node> nodes_;
  std::vector<geometry::CsgLeaf> leaves_;
  base::Bounds bounds_;
  double gap_ = 0.0;  // m, distance outwards from an SCP of the place that buried() tests
};

}  // namespace icome::haptics
