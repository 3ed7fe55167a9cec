#include "haptics/energy_tank.h"

#include <algorithm>

namespace icome::haptics {

Vector3 EnergyTank::give(const Vector3& force) {
  const double gives = force.dot(way_);
  acting_ = gives <= 0.0 ? force : Vector3(std::clamp(stored_ / gives, 0.0, 1.0) * force);
  return acting_;
}

void EnergyTank::settle(const Vector3& way, double share) {
  stored_ -= share * acting_.dot(way);
  acting_.setZero();
  way_ = way;
}

}  // namespace icome::haptics
