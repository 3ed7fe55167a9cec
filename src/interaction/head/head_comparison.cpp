#include "interaction/head/head_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace icome::interaction {
namespace {

using base::Quaternion;
using base::Vector3;
using devices::HeadSample;

constexpr double kStretch = 0.5;          // s, of a recording that is asked whether it is still
constexpr double kStillShare = 0.05;      // of the stretches
constexpr std::size_t kLeastSamples = 8;  // in a stretch: a line leaves fewer nothing to deviate by
constexpr double kMostAhead = 0.4, kMostBehind = 0.6;  // s, of shifts that are tried

double angle_between_turns(const Quaternion& one, const Quaternion& other) {
  return one.angularDistance(other);
}

/// The poses of a recording between two of its samples; time goes forward from call to call of the same
/// shift, so that a place is found from the last one.
class Recording {
 public:
  explicit Recording(std::span<const HeadSample> samples) {
    for (const HeadSample& it : samples) {
      times_.push_back(it.time);
      poses_.push_back(HeadPose::of(it.tracker_from_head));
    }
  }

  std::size_t size() const { return times_.size(); }
  double time(std::size_t i) const { return times_[i]; }
  const HeadPose& pose(std::size_t i) const { return poses_[i]; }
  /// The pose at a time, `near` a sample not after it, which is brought there.
  HeadPose at(double time, std::size_t& near) const {
    while (near + 2 < size() && times_[near + 1] <= time) ++near;
    const std::size_t next = std::min(near + 1, size() - 1);
    const double gap = times_[next] - times_[near];
    const double part = gap > 0.0 ? std::clamp((time - times_[near]) / gap, 0.0, 1.0) : 0.0;
    const HeadPose &a = poses_[near], &b = poses_[next];
    const double sign = a.rotation.dot(b.rotation) < 0.0 ? -1.0 : 1.0;
    HeadPose between;
    between.place = a.place + part * (b.place - a.place);
    between.rotation.coeffs() =
        ((1.0 - part) * a.rotation.coeffs() + part * sign * b.rotation.coeffs()).normalized();
    return between;
  }

 private:
  std::vector<double> times_;
  std::vector<HeadPose> poses_;
};

/// A part of a recording: samples from the first on, before the last.
struct Stretch {
  std::size_t begin, end;
};

/// The sum of the squared distances to the straight line over time that fits best.
double deviation2(const Stretch& stretch, const Recording& recording,
                  const std::function<Vector3(std::size_t)>& point) {
  const auto count = double(stretch.end - stretch.begin);
  double middle = 0.0, spread = 0.0;
  Vector3 mean = Vector3::Zero(), slope = Vector3::Zero();
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    middle += recording.time(i) / count;
    mean += point(i) / count;
  }
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const double time = recording.time(i) - middle;
    spread += time * time;
    slope += time * (point(i) - mean);
  }
  if (spread > 0.0) slope /= spread;
  double sum = 0.0;
  for (std::size_t i = stretch.begin; i < stretch.end; ++i)
    sum += (point(i) - mean - (recording.time(i) - middle) * slope).squaredNorm();
  return sum;
}

std::vector<Stretch> stretches_of(const Recording& recording) {
  std::vector<Stretch> all;
  for (std::size_t begin = 0, i = 0; i < recording.size(); ++i) {
    if (recording.time(i) - recording.time(begin) < kStretch) continue;
    if (i - begin >= kLeastSamples) all.push_back({begin, i});
    begin = i;
  }
  return all;
}

/// Places, or turns from the first pose of the stretch, of poses; rad.
std::function<Vector3(std::size_t)> points_of(const std::vector<HeadPose>& poses, const Stretch& stretch,
                                              bool turns) {
  if (!turns) return [&poses](std::size_t i) { return poses[i].place; };
  const Quaternion back = poses[stretch.begin].rotation.conjugate();
  return [&poses, back](std::size_t i) { return base::turn_of(poses[i].rotation * back); };
}

/// The longest distance between the means of quarters of a stretch: of a motion, in which noise counts for
/// little.
double movement(const Stretch& stretch, const std::function<Vector3(std::size_t)>& point) {
  constexpr std::size_t kParts = 4;
  std::array<Vector3, kParts> means;
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t count = stretch.end - stretch.begin;
    const std::size_t begin = stretch.begin + count * k / kParts,
                      end = stretch.begin + count * (k + 1) / kParts;
    means[k].setZero();
    for (std::size_t i = begin; i < end; ++i) means[k] += point(i) / double(end - begin);
  }
  double most = 0.0;
  for (const Vector3& one : means)
    for (const Vector3& other : means) most = std::max(most, (one - other).norm());
  return most;
}

/// The stretches of the recording in which the head moves, or turns, least.
std::vector<Stretch> stillest(const Recording& recording, const std::vector<HeadPose>& raw, bool turns) {
  std::vector<Stretch> all = stretches_of(recording);
  std::vector<std::pair<double, std::size_t>> moves;
  for (std::size_t i = 0; i < all.size(); ++i)
    moves.emplace_back(movement(all[i], points_of(raw, all[i], turns)), i);
  std::sort(moves.begin(), moves.end());
  moves.resize(std::size_t(std::ceil(kStillShare * double(moves.size()))));
  std::vector<Stretch> still;
  for (const auto& it : moves) still.push_back(all[it.second]);
  return still;
}

std::optional<double> jitter(const Recording& recording, const std::vector<Stretch>& still,
                             const std::vector<HeadPose>& poses, bool turns) {
  double sum = 0.0, count = 0.0;
  for (const Stretch& it : still) {
    sum += deviation2(it, recording, points_of(poses, it, turns));
    count += double(it.end - it.begin) - 2.0;  // a line takes two degrees of freedom away
  }
  return count > 0.0 ? std::optional(std::sqrt(sum / count)) : std::nullopt;
}

/// The mean of the squared distances of poses to the recording as it was `shift` s before, places in m^2 and
/// turns in about rad^2.
double distance2(const Recording& recording, const std::vector<HeadPose>& poses, double shift, bool turns) {
  double sum = 0.0, count = 0.0;
  std::size_t near = 0;
  const double first = recording.time(0) + kMostBehind,
               last = recording.time(recording.size() - 1) - kMostAhead;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (recording.time(i) < first || recording.time(i) > last) continue;
    const HeadPose then = recording.at(recording.time(i) - shift, near);
    const double dot = then.rotation.dot(poses[i].rotation);
    sum += turns ? std::max(0.0, 4.0 * (1.0 - dot * dot)) : (then.place - poses[i].place).squaredNorm();
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// The shift of the least distance: the best of a grid, then by golden sections beside it.
std::optional<double> best_shift(const std::function<double(double)>& distance) {
  constexpr double kStep = 0.01;  // s
  constexpr int kSections = 24;   // down to a microsecond
  double best = 0.0, least = HUGE_VAL, most = 0.0;
  const int steps = int(std::lround((kMostAhead + kMostBehind) / kStep));
  for (int i = 0; i <= steps; ++i) {
    const double shift = -kMostAhead + kStep * i, now = distance(shift);
    most = std::max(most, now);
    if (now < least) best = shift;
    least = std::min(least, now);
  }
  constexpr double kMoves = 1e-12;  // m^2 or rad^2: less is rounding
  if (!(most - least > kMoves)) return std::nullopt;
  constexpr double kGolden = 0.6180339887498949;
  double low = best - kStep, high = best + kStep;
  for (int i = 0; i < kSections; ++i) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    distance(a) < distance(b) ? high = b : low = a;
  }
  return 0.5 * (low + high);
}

std::optional<double> lag(const Recording& recording, const std::vector<HeadPose>& poses, bool turns) {
  constexpr double kLeast = 0.5;  // s, of the recording beside the shifts
  if (recording.time(recording.size() - 1) - recording.time(0) < kMostAhead + kMostBehind + kLeast)
    return std::nullopt;
  return best_shift([&](double shift) { return distance2(recording, poses, shift, turns); });
}

}  // namespace

std::vector<HeadPose> steadied(std::span<const HeadSample> samples, const HeadFilterSettings& settings) {
  HeadFilter filter(settings);
  std::vector<HeadPose> poses;
  poses.reserve(samples.size());
  for (const HeadSample& it : samples) {
    filter.take(it.tracker_from_head, it.time);
    poses.push_back(filter.ahead());
  }
  return poses;
}

std::vector<HeadFilterScore> compare_head_filters(std::span<const HeadSample> samples,
                                                  std::span<const HeadFilterSettings> ways) {
  const Recording recording(samples);
  const std::vector<HeadPose> raw = steadied(samples, {HeadFilterKind::None, 0.0});
  const auto still_places = stillest(recording, raw, false), still_turns = stillest(recording, raw, true);
  std::vector<HeadFilterScore> scores;
  for (const HeadFilterSettings& way : ways) {
    const std::vector<HeadPose> poses = steadied(samples, way);
    HeadFilterScore score{way, jitter(recording, still_places, poses, false),
                          jitter(recording, still_turns, poses, true), lag(recording, poses, false),
                          lag(recording, poses, true)};
    double place = 0.0, turn = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      place += (poses[i].place - raw[i].place).squaredNorm() / double(poses.size());
      const double angle = angle_between_turns(poses[i].rotation, raw[i].rotation);
      turn += angle * angle / double(poses.size());
    }
    score.behind_place = std::sqrt(place);
    score.behind_turn = std::sqrt(turn);
    scores.push_back(score);
  }
  return scores;
}

}  // namespace icome::interaction
