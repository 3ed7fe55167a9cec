#pragma once
#include <optional>

#include "interaction/head/head_motion.h"
#include "interaction/techniques/bench/person.h"

namespace icome::study {

/// The sharpness with which a simulated person sees depth in a trial: from the picture alone, with an image
/// for each eye, and by swaying a tracked head, whose view moves as it does for people
/// (interaction::HeadMotion). Each is a measurement of its own; they combine by their variances (Landy,
/// Maloney, Johnston and Young 1995). Values are of a plausible size, and nobody's measurement.
class DepthSight {
 public:
  // The deviation of depth seen in a picture, as a share of the distance (chosen).
  static constexpr double kOfPicture = 0.01;
  // rad: that by moving the view is acuity * distance^2 / width of the move. Twice that of two eyes, chosen
  // after Rogers and Graham 1982, whose observers did somewhat worse by motion parallax than by stereopsis.
  static constexpr double kParallaxAcuity = 6e-4;
  static constexpr double kSway = 0.05;     // m to each side, of a head that looks round (chosen)
  static constexpr double kSwayHz = 0.5;    // (chosen)
  static constexpr double kDistance = 0.5;  // m, from the eyes to the scene

  DepthSight(const interaction::PersonModel& person, bool stereo, bool tracked);

  /// The head sways on to that time (s, never falls).
  void look(double time);
  /// The head of now is at rest.
  void recentre();
  /// The deviation of depth as it is seen now, m.
  double deviation() const;
  /// Distance between the places farthest aside that the view had, m.
  double width() const { return most_ - least_; }

 private:
  double variances_inverted_;  // 1/m^2, of what does not change
  std::optional<interaction::HeadMotion> head_;
  double least_ = 0.0, most_ = 0.0;  // m, of the view's place aside
  double next_ = 0.0;                // s, of the tracker's next sample
};

}  // namespace icome::study
