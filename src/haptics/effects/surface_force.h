#pragma once
#include <memory>
#include <string>

#include "base/vector.h"
#include "haptics/effects/haptic_texture.h"

namespace icome::haptics {

/// Stands for a damping that is chosen for the wall, the device and the rate (stable_damping).
constexpr double kAutomaticDamping = -1.0;

/// The sides of a surface that stop the tip.
enum class TouchableSides {
  Front,  // only from outside, along the outward normals
  Both,
};

/// Haptic properties of a surface.
struct Surface {
  double stiffness = 0.0;              // N/m, usually 300 to 5000; 0: the device's nominal stiffness
  double damping = kAutomaticDamping;  // N s/m, usually 0.5 to 20; kAutomaticDamping
  double damping_depth = 0.0;          // m, over which the damper sets in, usually 0 (at once) to 0.0005
  double static_friction = 0.0;        // Coulomb coefficient, usually 0 to 1, >= dynamic_friction
  double dynamic_friction = 0.0;       // Coulomb coefficient, usually 0 to 0.8
  TouchableSides sides = TouchableSides::Front;
  std::shared_ptr<const HapticTexture> texture = nullptr;  // read only; null: smooth
};

// Limits of the stiffness and damping of a sampled wall. Derivation: a mass m meets F = -K x - B v that is
// computed every dt from the position and its backward difference and held between (zero-order hold).
// With k = K dt^2/m and b = B dt/m the characteristic polynomial is
//   z^3 + (k/2 + b/2 - 2) z^2 + (1 + k/2) z - b/2,
// and the Jury criterion leaves b (1 - b/2) > (k/2)(1 + b/2): b between the roots of
//   b^2 - (2 - k/2) b + k = 0,
// which exist for k < 4 (3 - 2 sqrt 2) = 0.686. The lower end is about K dt/2, what Colgate and Brown
// (1994) and Gil et al. (2004) find that the hold leaks and damping must pay; the upper end is thesis
// 5.3.2's "unstable if the damping constant is too large for a given step size". An exact velocity
// (not a difference) and a hand's mass both widen the range.
// A device that answers one tick late has the polynomial
//   z^4 - 2 z^3 + (1 + k/2 + b/2) z^2 + (k/2) z - b/2,
// which allows k up to 0.14 only (b about 1.5 k to 0.8 for small k). Real devices are late by a part of
// a tick, so what is chosen below is stable in both cases.

/// The open interval of damping constants for which a wall is stable, N s/m.
struct DampingRange {
  double least = 0.0;
  double most = 0.0;  // == least when no damping makes the wall stable
};

/// The interval above for a wall of `stiffness` (N/m) on a device of `effective_mass` (kg) every `dt` (s).
/// Real-time safe.
DampingRange stable_damping_range(double stiffness, double effective_mass, double dt);

/// The hardest wall (N/m, at most `requested`) that is stable also when the device answers a tick late,
/// K dt^2/m <= 0.1, and the damping of which may be as much as leak_seconds() asks for. At 1 kHz this is
/// above every device's nominal stiffness; a slower loop must be softer (thesis 5.3.2: stiff walls need a
/// higher rate). Real-time safe.
double stable_stiffness(double effective_mass, double dt, double requested);

/// "stiffness 5000 N/m is felt as 1000 N/m, damping 60 N s/m as 5 N s/m": the reductions by
/// stable_stiffness() and stable_damping() of a spring with this stiffness (N/m) and damping (N s/m;
/// kAutomaticDamping asks for none). Empty where nothing is reduced.
std::string capped_spring(double effective_mass, double dt, double stiffness, double damping);

/// Least damping per stiffness, in ticks: the zero-order hold leaks half a tick of the stiffness, a device
/// that answers one tick late a whole one (stable_damping).
constexpr double kLeakTicks = 2.0;

/// Longest lag, s, of a force that reaches the device's maximum, as ForceLimiter changes forces in steps:
/// damping must pay for that, too, or a spring that is far harder than the device is strong feeds the hand.
/// (Eight springs of 8 kN/m at 4 kHz shook an omega.x in a hand by 5 mm; with this they hold it.)
constexpr double kLimiterLag = 0.002;

/// Least damping per stiffness, s, that pays for the hold and the lag of forces. Real-time safe.
double leak_seconds(double dt);

/// The damping (N s/m) to use for a wall no stiffer than stable_stiffness(): `requested`, kept between
/// K leak_seconds() (the hold leaks K dt/2, a tick of delay K dt) and a quarter of the upper end of the
/// range. kAutomaticDamping gives sqrt(K m), a damping ratio of one half: as the product of the roots is k,
/// this is exactly the geometric middle of the range. Without a stiffness (pure damping) automatic is 0.
/// Real-time safe.
double stable_damping(double stiffness, double effective_mass, double dt, double requested);

/// The least mass (kg, at most `effective_mass`) for which a spring is stable with all of the stiffness (N/m)
/// and damping (N s/m) that it gets on a device of `effective_mass`. Real-time safe.
double mass_needed(double stiffness, double damping, double effective_mass, double dt);

/// The surface with its stiffness and damping replaced by those that are stable on a device of nominal
/// stiffness `nominal_stiffness` N/m and `effective_mass` kg every `dt` s. Real-time safe.
void make_stable(Surface& surface, double nominal_stiffness, double effective_mass, double dt);

/// One contact as the spring-damper sees it, all in one frame.
struct Contact {
  Vector3 tip = Vector3::Zero();           // m
  Vector3 scp = Vector3::Zero();           // m, surface contact point
  Vector3 tip_velocity = Vector3::Zero();  // m/s
  Vector3 scp_velocity = Vector3::Zero();  // m/s, of the surface under the SCP; not the SCP's sliding
  Vector3 normal = Vector3::UnitZ();       // unit, out of the solid
};

/// The force (N) on the tip: a spring to the SCP (thesis 5.3.2, figure 5.1) and a damper along the contact
/// normal only, so that sliding is felt as friction and texture alone. Never pulls the tip into the
/// surface. With a damping depth the force begins at nothing however fast the tip lands. `surface` has been
/// through make_stable. Real-time safe.
Vector3 spring_damper_force(const Contact& contact, const Surface& surface);

/// A first-order low-pass for noisy velocities, -3 dB at the corner (well below the tick rate). Each step
/// of it takes phase from the wall's damper: keep the corner above sqrt(K/m)/2.
class VelocityFilter {
 public:
  explicit VelocityFilter(double corner_hz = 200.0) : corner_hz_(corner_hz) {}
  /// The filtered velocity (m/s) `dt` seconds after the last; the first one passes as it is.
  /// Real-time safe.
  Vector3 filter(const Vector3& velocity, double dt);
  /// Forgets the past. Real-time safe.
  void reset() { started_ = false; }

 private:
  double corner_hz_;
  bool started_ = false;
  Vector3 filtered_ = Vector3::Zero();
};

}  // namespace icome::haptics
