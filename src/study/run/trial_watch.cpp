#include "study/run/trial_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "charts/lettering.h"

namespace icome::study {
namespace {

constexpr double kCatch = 0.01;  // m
constexpr double kLose = 0.02;   // m
/// Losing a thing for less than this and touching it again is a single touch: hands bounce.
constexpr double kBounce = 0.25;  // s

/// Rounds to a microsecond or a micrometre: anything less is noise of summation.
double in_millionths(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

TrialWatch::TrialWatch(TrialGoal goal)
    : goal_(std::move(goal)), touched_at_(goal_.things.size(), kNeverTouched) {
  if (goal_.element) element_.emplace(*goal_.element->element, goal_.element->language, charts::line_width);
}

double TrialWatch::hold_left() const {
  return state_ == State::Holding ? std::max(0.0, goal_.hold - (now_ - caught_)) : 0.0;
}

TrialWatch::State TrialWatch::step(const Sample& reading) {
  Sample tick = reading;
  now_ = tick.time;
  follow_element(tick);
  if (state_ == State::Seeking && (tick.tip - goal_.start).norm() <= kCatch) {
    state_ = State::Holding;
    caught_ = now_;
  }
  // Springs are only so strong: a person who pulls the pointer away has to bring it back.
  if (state_ == State::Holding && !released_ && (tick.tip - goal_.start).norm() > kLose) {
    state_ = State::Seeking;
    samples_.clear();
  }
  if (state_ == State::Seeking || state_ == State::Over) return state_;
  samples_.push_back(tick);
  if (state_ == State::Running) {
    run(tick);
  } else if (released_) {
    start(now_);
  }
  tip_ = tick.tip;
  buttons_ = tick.buttons;
  return state_;
}

/// Lets the pointer do its work on the element, before the start, too: menus that it opens are open then. A
/// pointer that is pressed into the ground touches the widget there.
void TrialWatch::follow_element(Sample& tick) {
  of_element_ = -1;
  if (!element_ || state_ == State::Over) return;
  if (const auto choice = element_->point({tick.time, tick.tip, (tick.buttons & 1U) != 0}))
    of_element_ = goal_.thing_of(*choice->widget);
  const interaction::ElementFrame& frame = element_->frame();
  const double front = frame.front_distance(tick.tip);
  if (tick.touched >= 0 || element_->side() != haptics::PanelSide::Front || front >= 0.0) return;
  const interaction::LaidWidget* const pressed = element_->layout().at(frame.projected(tick.tip));
  if (pressed == nullptr) return;
  tick.touched = goal_.thing_of(*pressed->widget);
  if (tick.touched >= 0) tick.scp = tick.tip - front * frame.size * frame.normal();
}

bool TrialWatch::is_approached(const base::Vector3& tip) const {
  return goal_.is_in_element() ? is_in_vicinity(*element_, tip, goal_.vicinity)
                               : goal_.distance_to_vicinity(tip) <= goal_.vicinity;
}

void TrialWatch::start(double time) {
  state_ = State::Running;
  start_ = time;
  for (Sample& sample : samples_) sample.time -= start_;
}

void TrialWatch::run(const Sample& tick) {
  const double time = now_ - start_;
  samples_.back().time = time;
  measures_.distance += (tick.tip - tip_).norm();
  if (!approached_ && is_approached(tick.tip)) {
    approached_ = true;
    measures_.approach_time = time;
  }
  int choice = chosen(tick);
  if (!said_.empty()) {
    choice = said_.front();
    said_.pop_front();
  }
  samples_.back().lit = lit_;
  samples_.back().chosen = choice;
  if (choice >= 0 && goal_.things[std::size_t(choice)].target) return end(true, time);
  if (choice >= 0 && goal_.things[std::size_t(choice)].wrong) ++measures_.errors;
  if (time >= goal_.limit) end(false, time);
}

void TrialWatch::end(bool completed, double time) {
  state_ = State::Over;
  lit_ = -1;
  measures_.completed = completed;
  measures_.time = in_millionths(time);
  measures_.approach_time = in_millionths(approached_ ? measures_.approach_time : time);
  measures_.homing_time = in_millionths(measures_.time - measures_.approach_time);
  measures_.distance = in_millionths(measures_.distance);
}

/// The thing chosen in this tick; -1: none.
int TrialWatch::chosen(const Sample& tick) {
  const bool pressed = (tick.buttons & ~buttons_ & 1U) != 0;
  const int touched = touched_anew(tick);
  if (goal_.choosing == Choosing::Touch) return touched;
  // An element that is near is before what lies behind it.
  const bool at_element = element_ && element_->is_near();
  if (at_element) {
    lit_ = element_->lit() ? goal_.thing_of(*element_->lit()) : -1;
    return of_element_;
  }
  lit_ = goal_.nearest(tick.tip);
  if (goal_.choosing == Choosing::Click) return pressed ? lit_ : -1;
  return pushed(tick);
}

/// The thing that a part belongs to: things with the same name are one, for which the first of them stands.
std::size_t TrialWatch::whole_of(int part) const {
  const std::string& name = goal_.things[std::size_t(part)].name;
  if (name.empty()) return std::size_t(part);
  return std::size_t(std::ranges::find(goal_.things, name, &Thing::name) - goal_.things.begin());
}

bool TrialWatch::is_same(int one, int other) const {
  return one == other || (one >= 0 && other >= 0 && whole_of(one) == whole_of(other));
}

/// The thing that is touched and was not touched just before; -1: none.
int TrialWatch::touched_anew(const Sample& tick) {
  const int before = std::exchange(in_contact_, tick.touched);
  if (!is_same(before, tick.touched)) pushed_ = false;
  if (tick.touched < 0) return -1;
  double& touched_at = touched_at_[whole_of(tick.touched)];
  const bool anew = now_ - std::exchange(touched_at, now_) > kBounce;
  return anew ? tick.touched : -1;
}

/// The thing pushed in this tick; -1: none. Each contact is one push at most.
int TrialWatch::pushed(const Sample& tick) {
  if (tick.touched < 0 || goal_.things[std::size_t(tick.touched)].widget != nullptr || pushed_ ||
      (tick.tip - tick.scp).norm() < goal_.depth)
    return -1;
  pushed_ = true;
  return tick.touched;
}

}  // namespace icome::study
