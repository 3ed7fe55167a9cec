#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "geometry/primitive/primitive.h"

namespace icome::haptics {

/// A solid whose points are known by an evaluation that is not the judged one.
struct MembershipSolid {
  /// Is the point (own frame, m) inside at that time (s)? Deterministic.
  std::function<bool(const base::Vector3& point, double time)> inside;
  base::Bounds bounds;  // around it at all times
  /// A place of the solid nearer to `point` than `limit` (m), and at most some `fineness` (m) farther than
  /// the nearest, at that time (s); nothing where there is none. Parts thinner than that may be overlooked.
  /// Empty where that is unknown: then a sphere tip is judged by samples in some directions.
  std::function<std::optional<base::Vector3>(const base::Vector3& point, double time, double limit,
                                             double fineness)>
      nearest = {};
  /// Number of questions about nearest places that ended so far before all places that might hold one were
  /// tested. Empty where none ever does.
  std::function<std::uint64_t()> unfinished = {};
};

/// Something that the judged tip could touch, in its own frame. The mesh is shared, never null.
struct JudgedObject {
  std::variant<std::shared_ptr<const geometry::TriangleMesh>, geometry::Primitive, MembershipSolid> surface;
  base::Pose world_from_object = base::Pose::Identity();
  bool closed = true;      // a mesh that encloses a solid, fronts out; primitives always do
  bool two_sided = false;  // both sides stop the tip; else only the front does
  double error = 0.0;      // m, largest distance of a mesh from the surface that it stands for
  /// Its pose at a time (s), in place of `world_from_object`; empty for one that does not move.
  std::function<base::Pose(double time)> motion = {};
};

struct JudgeSettings {
  double tip_radius = 0.0;       // m, 0 is a point tip
  double static_friction = 0.0;  // Coulomb coefficient of the surfaces, the largest of them
  double pop_depth = 0.3e-3;     // m, an SCP this far behind a surface has popped through
  double stick_move = 0.3e-3;    // m, an SCP that could move this far, nearer to the tip, sticks
};

/// A solver's answer to one tip in one tick; world frame.
struct JudgedTick {
  base::Vector3 tip;  // m
  base::Vector3 scp;  // m, the centre of a sphere tip
  bool touching = false;
  double time = 0.0;                        // s, the moment for objects that move or change
  std::optional<base::Vector3> force = {};  // N, as the person felt it; none: not judged
};

/// The faults of a tick; all false when there were none.
struct Judgement {
  bool pop = false;
  bool stick = false;
  bool silent = false;
  bool pull = false;
  bool unjudged = false;  // no fault, but undecided
  bool late = false;      // no fault, but not there yet

  bool fine() const { return !pop && !stick && !silent && !pull; }
};

/// Judges surface contact points (SCP), tick by tick, and shares nothing with the code that finds them:
/// triangles in its own tree, winding numbers, distances of primitives, plain evaluations of trees and
/// formulas, all in double precision. For checks outside the servo: it allocates.
///
/// A pop: the SCP (its deepest point, for a sphere tip) is more than the pop depth inside a solid; or its
/// way since it was last seen on the right side crosses a surface that should have held it, it is by
/// now more than the pop depth away from that, and no free way leads there: neither a short detour (over
/// an edge, round a rim) nor a walk that comes ever nearer to the tip. Every tick inside counts, a
/// passage counts once.
///
/// Unjudged, a tick and no pop: the SCP passed a mesh, and whether a free way leads there takes too long to
/// find out. For a point tip a way along a single mesh is found however long it is, and a passage between
/// places that a mesh parts within the ball that holds all such ways is known as a pop without a search. For
/// other shapes a passage that takes too long to decide counts as a pop.
///
/// A stick: the tip is "touching" though the straight way from SCP to tip is free; or a straight move
/// of `stick_move` from the SCP is free, leads clearly nearer to the tip (by at least a tenth of the move),
/// and lies outside the friction cone; or the SCP is away from the tip though nothing is touched. No free
/// move starts at a local minimum of the distance, so deep presses, thin walls, ridges and corners
/// raise no false alarm. Directions are tried 15 degrees and more off the perpendicular of the pull.
///
/// Late, a tick and no stick: such a move is free, and the SCP is on its way; it came nearer to the tip by
/// the length of the move or more, in at most five ticks in a row. A solver that counts what a tick may cost
/// goes on in the next.
///
/// Silent: the tip is more than the pop depth inside a solid and nothing is felt: nothing touched, or no
/// force though the tip is not on its way out (there damping may use up all of the spring's).
///
/// A pull: the force draws the tip away from the SCP, while it is not on its way out, for at least three
/// ticks and in none less than before.
///
/// Lengths follow each object, not the scene: for one smaller than 3 cm they shrink to 1 % of its diagonal.
/// Positions may be off by 1e-6 of the diagonal, at most a hundredth of the pop depth (rounding in a file),
/// by 1e-9 of the diagonal and 1e-12 of coordinates where things are as large as that, and by twice the error
/// of a mesh that stands for something else: depths of less than 30 times as much are not seen. Solids known
/// by membership are sampled at every eighth of the pop depth: walls thinner than that may be passed unseen,
/// and solids thinner than that along the way do not count as one. Objects that move are followed as far as
/// they pass a place by less than half of their thickness in a tick.
class ContactJudge {
 public:
  ContactJudge(const std::vector<JudgedObject>& objects, const JudgeSettings& settings);
  ~ContactJudge();
  ContactJudge(ContactJudge&&) noexcept;
  ContactJudge& operator=(ContactJudge&&) noexcept;

  /// Judges the next tick.
  Judgement judge(const JudgedTick& tick);

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t pops() const { return pops_; }
  std::uint64_t sticks() const { return sticks_; }
  std::uint64_t silent() const { return silent_; }
  std::uint64_t pulls() const { return pulls_; }
  /// Number of questions that took too long to be answered; pops and sticks that they would have shown are
  /// missed.
  std::uint64_t unfinished() const;
  std::uint64_t unjudged() const { return unjudged_; }
  std::uint64_t late() const { return late_; }

 private:
  class Court;

  std::unique_ptr<Court> court_;
  std::uint64_t ticks_ = 0;
  std::uint64_t pops_ = 0;
  std::uint64_t sticks_ = 0;
  std::uint64_t silent_ = 0;
  std::uint64_t pulls_ = 0;
  std::uint64_t unjudged_ = 0;
  std::uint64_t late_ = 0;
};

}  // namespace icome::haptics
