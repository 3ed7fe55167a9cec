#pragma once
#include <span>
#include <vector>

#include "haptics/effects/reach.h"

namespace icome::haptics {

// Forces that act on one tip share the range in which it is stable. A device of mass m is stable with a
// stiffness of at most 0.1 m/dt^2, a damping in proportion to m/dt (surface_force.h) and an added mass in
// proportion to m (Inertia): all grow with m. So the device is thought of as made of pieces that move as one,
// each of which renders one force: if each force is stable on its piece, so is their sum.

/// The needs of one force: the least mass (kg) of a device on which it is felt with its requested
/// settings, no more than the device's own; and its reach, in one frame for all.
struct MassNeed {
  double mass = 0.0;  // kg, >= 0
  Reach reach = {};
};

/// For each need, the mass (kg) that it and all that may act at the same places need together. Forces that
/// never act together take nothing from each other. The mass depends on the reaches, not on the place of
/// the tip, so that an effect's force stays the same function of place and gives no energy.
std::vector<double> needed_together(std::span<const MassNeed> needs);

/// The piece (kg) of a device of `device_mass` for a force that needs `own`, among forces that need
/// `together` with it: all of the device where that is enough for all, else in proportion to what they need.
/// Real-time safe.
double mass_share(double device_mass, double own, double together);

}  // namespace icome::haptics
