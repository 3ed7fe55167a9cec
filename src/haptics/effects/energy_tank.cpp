#include "haptics/effects/energy_tank.h"

#include <algorithm>

namespace icome::haptics {
namespace {

constexpr double kNewest = 0.05;  // weight of the last tick in drift_, the mean of the last few

}  // namespace

Vector3 EnergyTank::give(const Vector3& force) {
  const double gives = std::max(force.dot(way_), force.dot(drift_));
  acting_ = gives <= 0.0 ? force : Vector3(std::clamp(stored_ / gives, 0.0, 1.0) * force);
  return acting_;
}

void EnergyTank::acts(double share) {
  least_share_ = std::min(share, least_share_.value_or(share));
  most_share_ = std::max(share, most_share_);
}

void EnergyTank::settle(const Vector3& way) {
  const double given = acting_.dot(way);
  stored_ = std::min(kMost, stored_ - given * (given > 0.0 ? most_share_ : least_share_.value_or(0.0)));
  acting_.setZero();
  least_share_.reset();
  most_share_ = 0.0;
  way_ = way;
  drift_ += kNewest * (way - drift_);
}

}  // namespace icome::haptics
