#include "interaction/head/head_motion.h"

#include <algorithm>
#include <cassert>

namespace icome::interaction {

/// The eigenvector of the greatest eigenvalue of sum(q qT) (Markley et al. 2007, "Averaging quaternions"), by
/// iteration: for what a head does in five samples, two or three steps.
base::Quaternion mean_rotation(std::span<const base::Quaternion> rotations) {
  assert(!rotations.empty());
  constexpr int kMostSteps = 1000;
  constexpr double kSame = 1e-15;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const base::Quaternion& rotation : rotations) sum += rotation.coeffs() * rotation.coeffs().transpose();
  Eigen::Vector4d mean = rotations.back().coeffs();
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector4d next = (sum * mean).normalized();
    const double change = (next - mean).cwiseAbs().maxCoeff();
    mean = next;
    if (change <= kSame) break;
  }
  return base::Quaternion(mean);
}

base::Pose HeadMotion::mean() const {
  const std::size_t count = std::min(count_, kSamples);
  base::Vector3 place = base::Vector3::Zero();
  for (std::size_t i = 0; i < count; ++i) place += places_[i];
  base::Pose mean = base::Pose::Identity();
  mean.translation() = place / double(count);
  mean.linear() = mean_rotation(std::span(turns_).first(count)).toRotationMatrix();
  return mean;
}

void HeadMotion::set_rest(const base::Pose& tracker_from_rest) {
  tracker_from_rest_ = tracker_from_rest;
  has_rest_ = true;
}

void HeadMotion::recentre() {
  if (count_ > 0) set_rest(mean());
}

base::Pose HeadMotion::newest_from_rest() const {
  const std::size_t newest = (count_ - 1) % kSamples;
  return tracker_from_rest_.inverse() * (Eigen::Translation3d(places_[newest]) * turns_[newest]);
}

base::Pose HeadMotion::moved(const base::Pose& tracker_from_head) {
  const std::size_t next = count_++ % kSamples;
  places_[next] = tracker_from_head.translation();
  turns_[next] = base::Quaternion(tracker_from_head.linear()).normalized();
  if (!has_rest_) recentre();
  return transferred(tracker_from_rest_.inverse() * mean(), transfer_);
}

}  // namespace icome::interaction
