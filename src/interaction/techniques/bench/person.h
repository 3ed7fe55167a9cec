#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"

namespace icome::interaction {

// People as the bench simulates them. The forms of the laws are from the literature that is named; numbers
// that are named "chosen" are of a plausible size and nobody's measurement. A simulation says how techniques
// compare under these assumptions. It is no study of people.

/// Movement of a part of the body: positions of the hand are in m, directions of wrist and head in rad.
struct LimbModel {
  double noise = 0.025;        // s: a movement ends off by a deviation of noise * amplitude / duration
  double acceleration = 20.0;  // (m or rad)/s^2, at most
  double tremor = 0.0005;      // m or rad, root mean square, while held still
  double press_jolt = 0.0;     // m or rad, deviation of the jolt that pressing the button gives
};

/// Movement times that are known beforehand, to test the bench itself: intercept + slope * ID.
struct KnownDuration {
  double intercept = 0.1;  // s
  double slope = 0.1;      // s/bit
};

struct PersonModel {
  LimbModel arm = {0.025, 20.0, 0.0005, 0.001};     // the hand in free air
  LimbModel wrist = {0.025, 80.0, 0.0010, 0.0015};  // a hand that points
  LimbModel head = {0.025, 30.0, 0.0010, 0.0};      // looking with the head
  double aside = 0.5;           // deviation across a movement, as a share of that along it
  double tremor_hz = 9.0;       // Hz
  double reaction = 0.24;       // s, from seeing the target to the first movement
  double correction = 0.17;     // s, from the end of a movement to seeing and deciding what to do
  double press = 0.07;          // s, to press the button
  double shortest = 0.1;        // s, of any movement
  double give_up = 10.0;        // s after which a person presses anyway
  double stereo_acuity = 3e-4;  // rad: deviation of depth is acuity * distance^2 / eye distance
  double eye_distance = 0.063;  // m
  double arm_length = 0.7;      // m, from the chest
  double spread = 0.12;         // deviation of the logarithm of each person's noise, tremor and times
  std::optional<KnownDuration> known = {};  // none: as quick as pays off
};

/// One number of the model, for reports.
struct PersonAssumption {
  std::string name;
  double value;
  std::string unit;
  std::string source;
};
std::vector<PersonAssumption> assumptions(const PersonModel& model);

/// Another random person of that kind.
PersonModel drawn_person(const PersonModel& model, base::Random& random);

/// A number of the standard normal distribution (Box and Muller).
double normal_number(base::Random& random);

/// Progress of a movement of minimum jerk after a share of its time, in [0, 1] (Flash and Hogan 1985).
double minimum_jerk(double share);

/// The shortest time of a movement of minimum jerk over that amplitude.
double shortest_duration(const LimbModel& limb, const PersonModel& person, double amplitude);

/// The time that a person takes for a movement over `amplitude` to within `tolerance` of a goal: that with
/// which moving, and correcting where the movement misses, is over soonest on average (the idea of Meyer et
/// al. 1988); or as known.
double planned_duration(const LimbModel& limb, const PersonModel& person, double amplitude, double tolerance);

}  // namespace icome::interaction
