#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "geometry/primitive.h"
#include "geometry/triangle_mesh.h"

namespace icome::haptics {

/// A solid of which is known, by an evaluation that is not the one judged, what lies in it.
struct MembershipSolid {
  /// Is the point (own frame, m) inside at that time (s)? Deterministic.
  std::function<bool(const base::Vector3& point, double time)> inside;
  base::Bounds bounds;  // around it at all times
};

/// Something that the judged tip could touch, in its own frame. The mesh is shared, never null.
struct JudgedObject {
  std::variant<std::shared_ptr<const geometry::TriangleMesh>, geometry::Primitive, MembershipSolid> surface;
  base::Pose world_from_object = base::Pose::Identity();
  bool closed = true;      // a mesh that encloses a solid, fronts out; primitives always do
  bool two_sided = false;  // both sides stop the tip; else only the front does
};

struct JudgeSettings {
  double tip_radius = 0.0;       // m, 0 is a point tip
  double static_friction = 0.0;  // Coulomb coefficient of the surfaces, the largest of them
  double pop_depth = 0.3e-3;     // m, an SCP this far behind a surface has popped through
  double stick_move = 0.3e-3;    // m, an SCP that could move this far, nearer to the tip, sticks
};

/// What was wrong with a surface contact point (SCP); both false when nothing was.
struct Judgement {
  bool pop = false;
  bool stick = false;
};

/// Judges surface contact points, tick by tick, without the code that finds them: from the triangles
/// and closed-form distances alone, or from samples of what is inside. Objects stand still, though a solid
/// known by membership may change with time. For checks outside the servo: it allocates.
///
/// A pop: the SCP (its deepest point, for a sphere tip) is more than the pop depth inside a solid; or its
/// way since it was last seen on the right side crosses a surface that should have held it, it is by
/// now more than the pop depth away from that, and no free way leads there: neither a short detour (over
/// an edge, round a rim) nor a walk that comes ever nearer to the tip. Every tick inside counts, a
/// passage counts once.
///
/// A stick: the tip is "touching" though the straight way from SCP to tip is free; or a straight move
/// of `stick_move` from the SCP is free, leads clearly nearer to the tip (by at least a tenth of the move),
/// and lies outside the friction cone; or the SCP is away from the tip though nothing is touched. No free
/// move starts at a local minimum of the distance, so deep presses, thin walls, ridges and corners
/// raise no false alarm. Directions are tried 15 degrees and more off the perpendicular of the pull.
///
/// Both lengths are meant for things of 3 cm to 30 m; for smaller models they shrink to 1 % of the
/// diagonal of the objects' box, for larger ones they grow to 1e-5 of it. (A plane counts as 1 m.)
/// Solids known by membership are sampled at every eighth of the pop depth: walls thinner than that may be
/// passed unseen, and solids thinner than that along the way do not count as one.
/// Positions may be off by 1e-6 of the diagonal (rounding in a file) without harm.
class ContactJudge {
 public:
  ContactJudge(const std::vector<JudgedObject>& objects, const JudgeSettings& settings);
  ~ContactJudge();
  ContactJudge(ContactJudge&&) noexcept;
  ContactJudge& operator=(ContactJudge&&) noexcept;

  /// Judges the next tick: all in the world frame (m); `scp` is the centre of a sphere tip. `time` (s) is the
  /// moment for solids that change.
  Judgement judge(const base::Vector3& tip, const base::Vector3& scp, bool touching, double time = 0.0);

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t pops() const { return pops_; }
  std::uint64_t sticks() const { return sticks_; }

  double pop_depth() const;   // m, as scaled to the objects
  double stick_move() const;  // m, as scaled to the objects

 private:
  class Court;

  std::unique_ptr<Court> court_;
  std::uint64_t ticks_ = 0;
  std::uint64_t pops_ = 0;
  std::uint64_t sticks_ = 0;
};

}  // namespace icome::haptics
