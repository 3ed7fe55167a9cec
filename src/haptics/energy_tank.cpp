#include "haptics/energy_tank.h"

#include <algorithm>

namespace icome::haptics {
namespace {

constexpr double kNewest = 0.05;  // the share of the last tick in what counts as the last few

}  // namespace

Vector3 EnergyTank::give(const Vector3& force) {
  const double gives = std::max(force.dot(way_), force.dot(drift_));
  acting_ = gives <= 0.0 ? force : Vector3(std::clamp(stored_ / gives, 0.0, 1.0) * force);
  return acting_;
}

void EnergyTank::settle(const Vector3& way, double share) {
  stored_ -= share * acting_.dot(way);
  acting_.setZero();
  way_ = way;
  drift_ += kNewest * (way - drift_);
}

}  // namespace icome::haptics
