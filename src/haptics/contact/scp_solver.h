#pragma once
#include <limits>
#include <span>
#include <vector>

#include "haptics/contact/contact_region.h"
#include "haptics/contact/contact_set.h"
#include "haptics/contact/contact_solver.h"
#include "haptics/contact/haptic_scene.h"

namespace icome::haptics {

struct ScpSettings {
  double tip_radius = 0.0;  // m, 0 is a point tip; usually 0 to 0.005
  // The budget of a tick is counted, not timed, so that replays agree bit for bit.
  int max_iterations = 256;     // pieces of way, usually 1 to 5
  int max_elements = 8'000;     // as ContactRegion::work() counts, up to some 150 ns each; usually below 100
  int max_evaluations = 6'000;  // of formulas, some 100 ns each, and twice as many for a point tip; usually
                                // some 100
};

/// Finds the surface contact point (SCP): the constraint-based method of Zilles and Salisbury (1995)
/// and Ruspini et al. (1997), thesis 5.3.2, for point and sphere tips. From its last place the SCP
/// moves towards the tip through free space only: every straight piece of the way is swept against
/// all elements around, each hit becomes a constraint, and the next piece is the shortest way to
/// the tip that the constraints allow. This repeats until the SCP rests, within the tick. Coulomb
/// friction shortens the pieces. Objects that move carry the SCP along. One thread owns a solver; it
/// keeps a pointer to the scene, which the caller keeps alive.
class ScpSolver final : public ContactSolver {
 public:
  /// Takes all memory that stepping needs.
  explicit ScpSolver(const ScpSettings& settings = {});

  void reset() override;
  void adopt(const HapticScene& scene, std::span<const SceneChange> changes) override;
  const ScpState& step(const Vector3& tip, double elapsed) override;
  void look_ahead() override;
  const ScpState& state() const override { return state_; }

  /// The cost of all ticks so far, in the elements of ScpSettings::max_elements.
  std::uint64_t work() const { return region_.work(); }

 private:
  const Tolerance& tolerance() const { return region_.tolerance(); }
  ContactRegion::Frame frame() const { return {origin_, settings_.tip_radius, elapsed_}; }
  Pose pose(std::uint32_t object, double elapsed) const { return scene_->pose_in(origin_, object, elapsed); }
  /// Evaluations of formulas in a tick. A point tip's sweeps begin on surfaces, where they cost most.
  std::uint64_t most_evaluations() const {
    return std::uint64_t(settings_.max_evaluations) * (settings_.tip_radius > 0.0 ? 1 : 2);
  }
  void move_origin();
  bool start(const Vector3& tip);
  bool find_room();
  void restart();
  double gap_on(std::uint32_t object, const Vector3& place) const;
  void leave_solids();
  void carry(double from, double to);
  void sweep_relative(std::uint32_t object, const Pose& before, const Pose& now);
  void follow_reported_object(const HapticScene& old);
  void carry_contacts(const HapticScene& old, double old_elapsed);
  void surface_through(std::uint32_t object);
  void push_scp(const Vector3& to, std::uint32_t pusher);
  void converge(const Vector3& tip);
  bool swallowed(const Vector3& position) const;
  void stay_out(const Vector3& before);
  bool nearer(const Vector3& from, const Vector3& tip) const;
  bool advance(const Vector3& wanted);
  void limit_swing(const Vector3& move, double least_stride);
  Vector3 within_stride(const Vector3& step) const;
  Vector3 within_region(const Vector3& step);
  bool on_mesh() const;
  bool on_chords() const;
  Vector3 chord_within_region(Vector3 chord);
  Vector3 next_step(const Vector3& tip, bool& exact);
  Vector3 next_round_step(const Vector3& tip, bool& exact);
  Vector3 next_smooth_step(const Vector3& tip, bool& exact);
  SweepHit sweep_on(const Vector3& step, std::span<const Element> ignored);
  SweepHit sweep_past(const Vector3& step, const Vector3& one, const Vector3& other);
  bool holds(const Element& element) const;
  SweepHit arch(Vector3& step);
  SweepHit hop(Vector3& step);
  Vector3 rest_within(double length, const Vector3& step);
  bool rounded() const;
  bool escape(const Vector3& tip);
  bool escape_without_one(const Vector3& tip);
  bool escape_in_the_open(const Vector3& tip);
  bool at_edge() const;
  bool escape_over_edge(const Vector3& tip);
  bool lets_go(const Element& contact, const Vector3& tip) const;
  void let_go(const Vector3& step);
  double slip(double along, double press);
  double held_gain() const;
  void surround(const Vector3& step);
  void gather(const Vector3& ahead, double reach, std::size_t most_pieces);
  bool gather_whole(const Vector3& step, const Vector3& ahead, double reach);
  void grant_budget();
  bool spent() const;
  double least_room() const;
  bool falling() const;
  Vector3 way_ahead(const Vector3& step);
  double largest_reach() const;
  void report(const Vector3& tip);
  void report_contact(const Vector3& pull);
  Vector3 deformation_velocity() const;
  const Surface& surface() const;

  ScpSettings settings_;
  const HapticScene* scene_ = nullptr;
  double elapsed_ = 0.0;  // s, of the last step
  bool started_ = false;
  bool no_room_ = false;   // when it was looked for last
  bool in_doubt_ = false;  // did a walk along what holds the SCP have to stop short?
  bool cut_ = false;       // did the last step go only a part of the way wanted?
  bool met_ = false;       // did it end at something new?
  bool sliding_ = false;
  bool left_solid_ = false;  // put on the surface since the last report
  // m, the place where no way in the open was found, and the tip then
  Vector3 shut_in_at_ = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vector3 shut_in_tip_ = Vector3::Zero();
  // m, origin in the world of the frame of all that follows: moved when the SCP is so far from it that
  // coordinates near by would have too few digits.
  Vector3 origin_ = Vector3::Zero();
  Vector3 position_ = Vector3::Zero();    // m, of the SCP (centre of the tip that rests)
  Vector3 tick_start_ = Vector3::Zero();  // m, place of the SCP when the tick began
  Vector3 last_tip_ = Vector3::Zero();
  Vector3 goal_ =
      Vector3::Zero();       // m, where smooth contacts are pulled: the tip, or as far as friction lets
  double tip_motion_ = 0.0;  // m, of this tick
  double stride_ = 0.0;      // m, longest step
  Vector3 last_move_ = Vector3::Zero();  // m, the last step of this tick
  bool led_farther_ = false;             // did it lead away from the tip?
  double lifted_ = 0.0;                  // m, how high above its contacts the last step may have ended
  double last_slide_ = 0.0;              // m, the last step along a surface in this tick
  double fallen_ = 0.0;                  // m, through free space since, in this tick
  Vector3 drift_ = Vector3::Zero();      // m, way of the SCP in the last tick
  double reach_ = 0.0;                   // m, distance around the SCP that the region covers
  // m, the way ahead of the last region that held too much to look as far as it should.
  double ahead_ = std::numeric_limits<double>::infinity();
  bool in_tick_ = false;      // else between two ticks
  bool crowded_ = false;      // is it near so many pieces in this tick that meshes are kept whole?
  std::uint64_t budget_ = 0;  // work of the region at which this tick ends
  ContactSet contacts_;
  ContactSet last_contacts_;     // at the beginning of the tick, if any is smooth
  std::vector<Element> around_;  // elements that a way out is found among: memory only
  ContactRegion region_;
  ContactRegion ride_region_;
  ScpState state_;
};

}  // namespace icome::haptics
