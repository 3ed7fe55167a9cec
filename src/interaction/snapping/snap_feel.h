#pragma once
#include <memory>

#include "haptics/effects/effect.h"
#include "interaction/snapping/snap_finder.h"
#include "interaction/snapping/stopped_move.h"

namespace icome::interaction {

/// The strength and the reach of a snap's pull.
struct WellSettings {
  double strength = 1.0;  // N, the strongest pull, at 0.447 of the radius; usually 0.3 to 2
  double radius = 0.01;   // m, where it begins; usually that of the snap
};

/// The stiffness (N/m) at the centre of a well whose strongest pull is its strength. Precondition: radius >
/// 0.
double stiffness_of(const WellSettings& settings);

/// The well around the target of a snap: a point, a piece of a line, or a plane; along it the hand
/// moves freely.
struct SnapWell {
  Vector3 from = Vector3::Zero();    // m; a point of the plane
  Vector3 to = Vector3::Zero();      // m; equal to `from` for a point and a plane
  Vector3 normal = Vector3::Zero();  // unit, of a plane; zero else
  WellSettings settings;

  /// The place that the hand is pulled to, m. Real-time safe.
  Vector3 nearest(const Vector3& position) const;
  /// The well moved by the offset: hands hold an object at other places than the one that snaps.
  SnapWell moved_by(const Vector3& offset) const;
};

/// The well of a snap. Fails for a strength below zero or above 100 N, and for a radius not above zero.
base::Result<SnapWell> well_around(const Snap& snap, const WellSettings& settings);

/// The force (N) of the well on a hand there: haptics::GravityWell's, towards the nearest place, which is
/// minus the gradient of well_energy() and begins at the rim without a jump. Real-time safe.
Vector3 well_force(const SnapWell& well, const Vector3& position);

/// The energy (J) of a hand there, 0 outside, at least -0.583 strength * radius. Real-time safe.
double well_energy(const SnapWell& well, const Vector3& position);

/// The well as an effect for the servo loop.
std::unique_ptr<haptics::Effect> effect_of(const SnapWell& well);

/// The spring that makes the hand feel collisions, between the place where it wants an object and the place
/// where surfaces let it be (virtual coupling, Colgate, Stanley and Brown 1995).
struct CouplingSettings {
  double stiffness = 300.0;  // N/m, usually 100 to 1000
  double damping = 1.0;      // N s/m, against going further in or out, usually 0 to 5
  double limit = 5.0;        // N, usually below what the device can sustain
};

/// The contact force (N) on the hand: towards where the object stopped (m), never away from it, nothing while
/// it is where it is wanted, and without a jump between. `approach` is the velocity (m/s) of the wanted place
/// less that of the stopped one. Zero where numbers are not finite. Real-time safe.
Vector3 contact_force(const Vector3& wanted, const Vector3& stopped, const Vector3& approach,
                      const CouplingSettings& settings);

/// The contacts that hold objects against a push (m, world frame), three at most: the fewest whose normals
/// add up to the opposite of the push. Where edges meet edges, the other contacts are of no surfaces that
/// could be felt.
std::vector<Contact> holding(std::span<const Contact> contacts, const Vector3& push);

}  // namespace icome::interaction
