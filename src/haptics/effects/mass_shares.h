#pragma once
#include <span>
#include <vector>

#include "haptics/effects/reach.h"

namespace icome::haptics {

// How forces that act on one tip share what it can render stably. What is stable on a device of mass m is a
// stiffness of at most 0.1 m/dt^2, a damping in proportion to m/dt (surface_force.h) and a mass added in
// proportion to m (Inertia): all grow with m. So the device is thought of as made of pieces that move as one,
// each of which renders one force: what each keeps stable on its piece is stable in sum.

/// What one force needs of a device: the least mass (kg) on which it is felt as it was asked for, no more
/// than the device's own; and where it acts, in one frame for all.
struct MassNeed {
  double mass = 0.0;  // kg, >= 0
  Reach reach = {};
};

/// For each of them, the mass (kg) that it and all that may act at the same places need together. Who never
/// act together take nothing from each other; an effect's part depends on where others reach, not on where
/// the tip is, so that its force stays the same function of place and gives no energy.
std::vector<double> needed_together(std::span<const MassNeed> needs);

/// The piece (kg) of a device of `device_mass` for a force that needs `own`, among forces that need
/// `together` with it: all of the device where that is enough for all, else in proportion to what they need.
/// Real-time safe.
double mass_share(double device_mass, double own, double together);

}  // namespace icome::haptics
