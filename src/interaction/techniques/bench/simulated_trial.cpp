#include "interaction/techniques/bench/simulated_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace icome::interaction {
namespace {

constexpr double kDeviceRate = 50.0;  // Hz, of hands and head
constexpr int kMostMovementsOfTrial = 200;

/// One run under way.
class SimulatedRun {
 public:
  SimulatedRun(const Technique& technique, const PersonModel& person, const Aiming& aiming,
               const TechniqueScene& scene, const TrialTask& task, base::Random& random)
      : technique_(technique),
        person_(person),
        limb_(aiming.limb(person)),
        aiming_(aiming),
        scene_(scene),
        task_(task),
        random_(random),
        state_(begun(technique)),
        at_(task.start_control) {
    for (int axis = 0; axis < 3; ++axis) {
      phase_[axis] = random_.uniform(0.0, 2.0 * std::numbers::pi);
      rate_[axis] = person_.tremor_hz * random_.uniform(0.9, 1.1);
    }
  }

  TrialRun go() {
    rest(person_.reaction);
    bool sure = false;
    while (!sure && time_ < person_.give_up && run_.movements < kMostMovementsOfTrial) {
      move_towards_goal();
      ++run_.movements;
      // The view of now is understood later.
      sure = outcome_.pointed.id == task_.target;
      rest(person_.correction);
    }
    press();
    return std::move(run_);
  }

 private:
  /// The steering on the axes that this way of selecting has.
  Vector3 on_axes(const Vector3& control) const {
    return aiming_.goes() ? control : Vector3(control.x(), control.y(), 0.0);
  }

  Vector3 tremor() const {
    Vector3 off;
    for (int axis = 0; axis < 3; ++axis) {
      const double wave = std::sin(2.0 * std::numbers::pi * rate_[axis] * time_ + phase_[axis]);
      off[axis] = std::numbers::sqrt2 * limb_.tremor * wave;
    }
    return on_axes(off);
  }

  void feed(bool grab) {
    held_ = at_ + tremor();
    run_.stream.push_back(aiming_.input(held_, time_, grab));
    TechniqueStep next = step(technique_, state_, run_.stream.back(), scene_);
    state_ = std::move(next.state);
    outcome_ = next.outcome;
  }

  /// Lets time go on while the limb goes from one place to another, or stays.
  void pass(double asked, const Vector3& to) {
    const double duration = std::clamp(asked, 0.0, person_.give_up);
    const Vector3 from = at_;
    const double begun_at = time_;
    const int steps = std::max(1, int(std::ceil(duration * kDeviceRate)));
    for (int i = 1; i <= steps; ++i) {
      const double share = double(i) / steps;
      time_ = begun_at + share * duration;
      at_ = i == steps ? to : Vector3(from + minimum_jerk(share) * (to - from));
      feed(false);
    }
  }

  void rest(double duration) { pass(duration, at_); }

  /// The goal as the person perceives it: depth is not seen sharply.
  Vector3 perceived_goal() {
    if (!aiming_.goes() || !(person_.stereo_acuity > 0.0)) return task_.goal.control;
    const Vector3 target = ball_of(*scene_.find(task_.target)).centre;
    const Vector3 aimed_at = aiming_.reached(scene_, task_.goal.control, target);
    const Vector3 sight = (aimed_at - Aiming::eyes());
    const double distance = aiming_.viewing_distance(scene_, aimed_at);
    const double blur = person_.stereo_acuity * distance * distance / person_.eye_distance;
    // As a share of the distance, so that a miniature's depth is that of its copy.
    const double off = blur / distance * normal_number(random_);
    return aiming_.control_for(scene_, aimed_at + off * sight).value_or(task_.goal.control);
  }

  void move_towards_goal() {
    const Vector3 way = perceived_goal() - at_;
    const double amplitude = way.norm();
    const double duration = planned_duration(limb_, person_, amplitude, task_.goal.tolerance);
    Vector3 end = at_ + way;
    if (amplitude > 0.0 && limb_.noise > 0.0) {
      const double deviation = limb_.noise * amplitude / duration;
      const Vector3 along = way / amplitude;
      Vector3 off;
      for (int axis = 0; axis < 3; ++axis) off[axis] = person_.aside * deviation * normal_number(random_);
      off += (deviation * normal_number(random_) - off.dot(along)) * along;
      end += on_axes(off);
    }
    pass(duration, end);
  }

  void press() {
    rest(person_.press);
    Vector3 jolt = Vector3::Zero();
    if (limb_.press_jolt > 0.0)
      for (int axis = 0; axis < 3; ++axis) jolt[axis] = limb_.press_jolt * normal_number(random_);
    at_ += on_axes(jolt);
    feed(true);
    const Vector3 target = ball_of(*scene_.find(task_.target)).centre;
    run_.trial = {task_.start, target, aiming_.reached(scene_, held_, target), time_,
                  outcome_.selected == task_.target};
    run_.end_control = at_;
  }

  const Technique& technique_;
  const PersonModel& person_;
  const LimbModel& limb_;
  const Aiming& aiming_;
  const TechniqueScene& scene_;
  const TrialTask& task_;
  base::Random& random_;
  TechniqueState state_;
  TechniqueOutcome outcome_;
  TrialRun run_;
  Vector3 at_;                      // the limb without its tremor
  Vector3 held_ = Vector3::Zero();  // and with it
  Vector3 phase_, rate_;            // rad, Hz: of the tremor, by axis
  double time_ = 0.0;               // s
};

}  // namespace

TrialRun simulated_trial(const Technique& technique, const PersonModel& person, const Aiming& aiming,
                         const TechniqueScene& scene, const TrialTask& task, base::Random& random) {
  return SimulatedRun(technique, person, aiming, scene, task, random).go();
}

}  // namespace icome::interaction
