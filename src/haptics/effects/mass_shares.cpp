#include "haptics/effects/mass_shares.h"

namespace icome::haptics {

std::vector<double> needed_together(std::span<const MassNeed> needs) {
  std::vector<double> together(needs.size(), 0.0);
  for (std::size_t i = 0; i < needs.size(); ++i)
    for (const MassNeed& other : needs)
      if (meet(needs[i].reach, other.reach)) together[i] += other.mass;
  return together;
}

double mass_share(double device_mass, double own, double together) {
  // A force that needs no mass takes none from the others, whatever it is given.
  return own > 0.0 && together > device_mass ? device_mass * (own / together) : device_mass;
}

}  // namespace icome::haptics
