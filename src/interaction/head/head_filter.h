#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/one_euro.h"
#include "base/vector.h"

namespace icome::interaction {

/// The rotation with the least sum of squared chordal distances to these, which need not be near each other.
/// Precondition: at least one; unit length.
base::Quaternion mean_rotation(std::span<const base::Quaternion> rotations);

/// A place and a rotation that a head had.
struct HeadPose {
  base::Vector3 place = base::Vector3::Zero();               // m
  base::Quaternion rotation = base::Quaternion::Identity();  // unit length

  static HeadPose of(const base::Pose& pose);
  base::Pose pose() const;
};

enum class HeadFilterKind : std::uint8_t { None, Mean, OneEuro };

/// The ways of steadying, by the names that options have for them: none, mean, one-euro.
std::optional<HeadFilterKind> head_filter_of(std::string_view name);
std::string_view name_of(HeadFilterKind kind);

/// Settings of the filter that steadies a head tracker's poses, and of prediction, which puts the view ahead
/// of them.
struct HeadFilterSettings {
  HeadFilterKind kind = HeadFilterKind::Mean;  // the thesis's, 5.7.1
  double predict = 0.0;                        // s ahead of the newest sample; 0 to kMostPredicted

  static constexpr std::size_t kMeanSamples = 5;  // of the mean
  static constexpr double kMostPredicted = 0.3;   // s
  /// For places in m: the cutoff rises by 1 Hz for each 5 cm/s.
  static constexpr base::OneEuroSettings kPlaces = {1.0, 20.0, 2.0, 0.3};
  /// For rotations in rad: by 1 Hz for each 12 degrees/s.
  static constexpr base::OneEuroSettings kTurns = {1.0, 5.0, 2.0, 0.3};

  bool operator==(const HeadFilterSettings&) const = default;
};

/// The pose of a head some time ahead: the speed of the straight line, and of the even turn, that fit the
/// last tenth of a second best, in the sense of least squares, carries the newest pose on. It is bounded: at
/// most 10 cm and 20 degrees ahead, and nothing while there are fewer than three samples to tell a speed by.
class HeadPredictor {
 public:
  static constexpr double kWindow = 0.1;     // s, of the samples that tell the speed
  static constexpr double kMostMove = 0.1;   // m
  static constexpr double kMostTurn = 0.35;  // rad

  /// Takes a sample, `time` in s; one not after the last replaces it.
  void take(const HeadPose& pose, double time);
  /// The pose `ahead` s after the newest sample. Precondition: there is one.
  HeadPose at(double ahead) const;
  void forget() { samples_.clear(); }

 private:
  struct Sample {
    double time;
    HeadPose pose;
  };
  std::vector<Sample> samples_;  // of the window, the oldest first
};

/// Steadies the poses that a tracker tells, and predicts.
class HeadFilter {
 public:
  explicit HeadFilter(const HeadFilterSettings& settings = {}) : settings_(settings) {}

  /// Takes a sample at `time`, s, which does not go back.
  void take(const base::Pose& tracker_from_head, double time);
  bool is_empty() const { return poses_.empty(); }
  /// The newest sample, steadied. Precondition: there is one, as for ahead().
  const HeadPose& steady() const { return steady_; }
  /// Steadied and predicted.
  HeadPose ahead() const;
  /// Begins anew: what comes next is not near what came last.
  void forget();

  const HeadFilterSettings& settings() const { return settings_; }

 private:
  HeadPose steadied(double time);

  HeadFilterSettings settings_;
  std::vector<HeadPose> poses_;  // the last ones as they came, the newest last
  base::SteadyPoint<3> places_{HeadFilterSettings::kPlaces};
  base::SteadyRotation turns_{HeadFilterSettings::kTurns};
  HeadPose steady_;
  HeadPredictor predictor_;
};

}  // namespace icome::interaction
