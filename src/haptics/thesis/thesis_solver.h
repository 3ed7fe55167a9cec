#pragma once
#include <memory>
#include <vector>

#include "haptics/contact/contact_solver.h"
#include "haptics/thesis/direct_shape.h"

namespace icome::haptics {

/// Renders shapes that find their SCP themselves (DirectShape) with a point tip: thesis chapter 5 as
/// corrected in the errata. It looks at the place of the tip, not at its way there, so a tip that is fast
/// or is pressed hard enough comes out on the other side, which the exact renderer exists to prevent.
///
/// Among several objects that hold the tip, the one is felt whose SCP lies nearest the previous SCP and in
/// no other object (as in algorithm 5.4), or nearest at all. Every object's memory is in its own frame, so a
/// moving object takes the SCP along. One thread owns a solver; it keeps a pointer to the scene, which the
/// caller keeps alive.
class ThesisSolver final : public ContactSolver {
 public:
  static constexpr std::size_t kMostObjects = 64;  // whose boxes hold the tip; others are not asked

  /// Takes all memory that stepping needs.
  ThesisSolver();

  void reset() override;
  void adopt(const HapticScene& scene, std::span<const SceneChange> changes) override;
  const ScpState& step(const Vector3& tip, double elapsed) override;
  const ScpState& state() const override { return state_; }

 private:
  /// An object whose box holds the tip.
  struct Known {
    ObjectId id;
    DirectMemory memory;
    bool appeared = false;  // around the tip, which therefore did not come in through the surface
  };
  struct Found {
    std::uint32_t object;
    geometry::SurfacePoint place;  // world
    bool converged;
    bool appeared;
  };

  const DirectShape* direct_shape(std::uint32_t object) const;
  const Known* find_known(ObjectId id) const;
  void meet(const HapticScene& old, double old_elapsed, const SceneChange& change);
  Vector3 carried_scp(double elapsed) const;
  bool ask(std::uint32_t object, const Vector3& tip, double before, double now);
  const Found* choose(const Vector3& previous);
  bool buried(const Found& found, double elapsed);
  void report(const Found* found, const Vector3& tip);

  const HapticScene* scene_ = nullptr;
  double elapsed_ = 0.0;  // s, of the last step
  bool started_ = false;
  bool crowded_ = false;                // there was no room for an object
  Vector3 last_tip_ = Vector3::Zero();  // m, world
  std::vector<Known> known_, asked_;    // of the last step, of this one
  std::vector<Found> found_;
  std::unique_ptr<DirectWorkspace> space_;
  ScpState state_;
};

}  // namespace icome::haptics
