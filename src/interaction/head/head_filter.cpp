#include "interaction/head/head_filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace icome::interaction {
namespace {

using base::Quaternion;
using base::Vector3;

constexpr std::pair<std::string_view, HeadFilterKind> kFilterNames[] = {
    {"none", HeadFilterKind::None}, {"mean", HeadFilterKind::Mean}, {"one-euro", HeadFilterKind::OneEuro}};

/// The vector, no longer than that.
Vector3 bounded(const Vector3& vector, double most) {
  const double length = vector.norm();
  return length > most ? Vector3(most / length * vector) : vector;
}

}  // namespace

/// The eigenvector of the greatest eigenvalue of sum(q qT) (Markley et al. 2007, "Averaging quaternions"), by
/// iteration: for what a head does in five samples, two or three steps.
Quaternion mean_rotation(std::span<const Quaternion> rotations) {
  assert(!rotations.empty());
  constexpr int kMostSteps = 1000;
  constexpr double kSame = 1e-15;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Quaternion& rotation : rotations) sum += rotation.coeffs() * rotation.coeffs().transpose();
  Eigen::Vector4d mean = rotations.back().coeffs();
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector4d next = (sum * mean).normalized();
    const double change = (next - mean).cwiseAbs().maxCoeff();
    mean = next;
    if (change <= kSame) break;
  }
  return Quaternion(mean);
}

HeadPose HeadPose::of(const base::Pose& pose) {
  return {pose.translation(), Quaternion(pose.linear()).normalized()};
}

base::Pose HeadPose::pose() const { return Eigen::Translation3d(place) * rotation; }

std::optional<HeadFilterKind> head_filter_of(std::string_view name) {
  for (const auto& [known, kind] : kFilterNames)
    if (known == name) return kind;
  return std::nullopt;
}

std::string_view name_of(HeadFilterKind kind) { return kFilterNames[std::size_t(kind)].first; }

void HeadPredictor::take(const HeadPose& pose, double time) {
  std::erase_if(samples_, [&](const Sample& it) { return it.time < time - kWindow || it.time >= time; });
  samples_.push_back({time, pose});
}

HeadPose HeadPredictor::at(double ahead) const {
  assert(!samples_.empty());
  constexpr std::size_t kLeast = 3;  // of two the noise is the speed
  const HeadPose& newest = samples_.back().pose;
  if (samples_.size() < kLeast || !(ahead > 0.0)) return newest;
  double middle = 0.0;
  for (const Sample& it : samples_) middle += it.time / double(samples_.size());
  double spread = 0.0;
  Vector3 place = Vector3::Zero(), turn = Vector3::Zero();
  for (const Sample& it : samples_) {
    const double time = it.time - middle;
    spread += time * time;
    place += time * (it.pose.place - newest.place);
    turn += time * base::turn_of(it.pose.rotation * newest.rotation.conjugate());
  }
  const Vector3 move = bounded(ahead / spread * place, kMostMove);
  const Quaternion further = base::rotation_of_turn(bounded(ahead / spread * turn, kMostTurn));
  return {newest.place + move, (further * newest.rotation).normalized()};
}

HeadPose HeadFilter::steadied(double time) {
  const HeadPose& newest = poses_.back();
  if (settings_.kind == HeadFilterKind::OneEuro)
    return {places_.next(newest.place, time), turns_.next(newest.rotation, time)};
  if (settings_.kind == HeadFilterKind::None) return newest;
  std::array<Quaternion, HeadFilterSettings::kMeanSamples> turns;
  HeadPose mean;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    mean.place += poses_[i].place;
    turns[i] = poses_[i].rotation;
  }
  mean.place /= double(poses_.size());
  mean.rotation = mean_rotation(std::span(turns).first(poses_.size()));
  return mean;
}

void HeadFilter::take(const base::Pose& tracker_from_head, double time) {
  if (poses_.size() == HeadFilterSettings::kMeanSamples) poses_.erase(poses_.begin());
  poses_.push_back(HeadPose::of(tracker_from_head));
  steady_ = steadied(time);
  predictor_.take(steady_, time);
}

HeadPose HeadFilter::ahead() const {
  return predictor_.at(std::min(settings_.predict, HeadFilterSettings::kMostPredicted));
}

void HeadFilter::forget() {
  poses_.clear();
  places_.forget();
  turns_.forget();
  predictor_.forget();
}

}  // namespace icome::interaction
