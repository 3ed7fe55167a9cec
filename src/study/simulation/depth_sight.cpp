#include "study/simulation/depth_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::study {
namespace {

constexpr double kSampleSeconds = 1.0 / 60.0;  // of the tracker

double inverse_square(double deviation) { return 1.0 / (deviation * deviation); }

}  // namespace

DepthSight::DepthSight(const interaction::PersonModel& person, bool stereo, bool tracked)
    : variances_inverted_(inverse_square(kOfPicture * kDistance)) {
  if (stereo && person.stereo_acuity > 0.0)
    variances_inverted_ += inverse_square(person.stereo_acuity * kDistance * kDistance / person.eye_distance);
  if (tracked) head_.emplace();
}

void DepthSight::look(double time) {
  if (!head_) return;
  for (; next_ <= time; next_ += kSampleSeconds) {
    base::Pose head = base::Pose::Identity();
    head.translation().x() = kSway * std::sin(2.0 * std::numbers::pi * kSwayHz * next_);
    const double aside = head_->moved(head, next_).translation().x();
    least_ = std::min(least_, aside);
    most_ = std::max(most_, aside);
  }
}

void DepthSight::recentre() {
  if (!head_) return;
  head_->recentre();
  least_ = most_ = 0.0;
}

double DepthSight::deviation() const {
  double inverted = variances_inverted_;
  if (width() > 0.0) inverted += inverse_square(kParallaxAcuity * kDistance * kDistance / width());
  return 1.0 / std::sqrt(inverted);
}

}  // namespace icome::study
