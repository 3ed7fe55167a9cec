#include "study/menus/menu_person.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "devices/simulated/simulated_device.h"
#include "haptics/servo/servo.h"
#include "interaction/elements/element_feel.h"

namespace icome::study {
namespace {

using base::Vector3;
using interaction::ElementUse;
using interaction::LaidWidget;
using interaction::LimbModel;
using interaction::PersonModel;

constexpr double kMenuRate = 1000.0;    // Hz
constexpr double kBefore = 0.03;        // m, from the tip to the element at the beginning
constexpr double kClickDepth = 0.001;   // m, behind the plane: a hand that clicks rests on the ground
constexpr double kHoverOfPush = 0.005;  // m, before the plane: a hand that will push keeps away from it
constexpr double kSpreadsAway = 2.0;    // deviations of the movement in depth, that it keeps away besides
constexpr double kFarthestHover = 0.7;  // of the distance in which items light up
constexpr double kPushesPast = 0.009;   // m, behind the depth of a push, which the ground holds back
constexpr double kSharpest = 0.001;     // m, tolerance that nobody goes below
constexpr int kMostMenuMovements = 200;

/// The distance from its middle within which a widget is still hit, m.
double tolerance_of(const LaidWidget& laid) {
  if (!laid.sector) return std::max(laid.half.minCoeff(), kSharpest);
  const double half_angle = std::min(0.5 * (laid.sector->to - laid.sector->from), 0.5 * std::numbers::pi);
  const double across = laid.centre.norm() * std::sin(half_angle);
  return std::max(std::min(across, laid.centre.norm() - laid.sector->inner), kSharpest);
}

/// One choice under way. Time passes in ticks of the servo.
class MenuRunning {
 public:
  MenuRunning(const PersonModel& person, const interaction::Element& element,
              const interaction::TextMeasure& measure, base::Random& random)
      : person_(person),
        limb_(person.arm),
        element_(element),
        random_(random),
        use_(element, 0, measure),
        hand_(hand_settings()),
        servo_(hand_, servo_settings()) {
    use_.place({});
    for (int axis = 0; axis < 3; ++axis) {
      phase_[axis] = random_.uniform(0.0, 2.0 * std::numbers::pi);
      hertz_[axis] = person_.tremor_hz * random_.uniform(0.9, 1.1);
    }
    const interaction::FeltSheet felt =
        interaction::feel_of(element, use_.layout(), use_.frame(), use_.settings()).front();
    haptics::PlacedEffect effect;
    effect.id = 1;
    effect.world_from_effect = felt.world_from_sheet;
    effect.panel = std::make_shared<const haptics::PanelSettings>(felt.panel);
    servo_.publish_effects({effect});
  }

  MenuRun go(const interaction::Widget& widget) {
    const auto& laid = use_.layout().widgets;
    const LaidWidget& target = *std::ranges::find(laid, &widget, &LaidWidget::widget);
    rest(person_.reaction);
    while (!is_over() && run_.movements < kMostMenuMovements) {
      move_to(target);
      ++run_.movements;
      const bool sure = use_.lit() == &widget;  // of now, understood after the next rest
      rest(person_.correction);
      if (sure) element_.choosing.by_push ? push() : press();
    }
    if (run_.chosen == nullptr) run_.seconds = time_;
    return run_;
  }

 private:
  static devices::SimulatedSettings hand_settings() {
    devices::SimulatedSettings settings;
    settings.rate = kMenuRate;
    settings.start = {0.0, 0.0, kBefore};
    return settings;
  }
  static haptics::ServoSettings servo_settings() {
    haptics::ServoSettings settings;
    settings.rate_hz = kMenuRate;
    return settings;
  }

  bool is_over() const { return run_.chosen != nullptr || time_ >= person_.give_up; }

  Vector3 tremor() const {
    Vector3 off;
    for (int axis = 0; axis < 3; ++axis)
      off[axis] = std::numbers::sqrt2 * limb_.tremor *
                  std::sin(2.0 * std::numbers::pi * hertz_[axis] * time_ + phase_[axis]);
    return off;
  }

  void tick() {
    time_ += 1.0 / kMenuRate;
    hand_.set_target(aim_ + tremor());
    const haptics::TickReport& report = servo_.tick(1.0 / kMenuRate);
    run_.way += (report.tip - tip_).norm();
    run_.most_force = std::max(run_.most_force, report.force.norm());
    tip_ = report.tip;
    const auto choice = use_.point({time_, tip_, button_});
    if (!choice || run_.chosen != nullptr) return;
    run_.chosen = choice->widget;
    run_.seconds = time_;
  }

  /// Lets time go on while the hand aims from one place to another, or stays.
  void pass(double seconds, const Vector3& to) {
    const Vector3 from = aim_;
    const int ticks = std::max(1, int(std::ceil(std::min(seconds, person_.give_up) * kMenuRate)));
    for (int i = 1; i <= ticks && !is_over(); ++i) {
      aim_ = from + interaction::minimum_jerk(double(i) / ticks) * (to - from);
      tick();
    }
  }
  void rest(double seconds) { pass(seconds, aim_); }

  /// Who will push keeps so far away that the error of the movement seldom makes a push of it.
  double height_of_goal(const LaidWidget& target, double amplitude) const {
    if (!element_.choosing.by_push) return -kClickDepth;
    const double seconds = interaction::planned_duration(limb_, person_, amplitude, tolerance_of(target));
    const double spread = person_.aside * limb_.noise * amplitude / seconds;
    return std::min(kHoverOfPush + kSpreadsAway * spread, kFarthestHover * element_.choosing.near);
  }

  /// A movement to the widget from where the tip is seen, with the error that its speed brings.
  void move_to(const LaidWidget& target) {
    const base::Vector2 aside = target.centre - tip_.head<2>();
    Vector3 way(aside.x(), aside.y(), height_of_goal(target, aside.norm()) - aim_.z());
    const double amplitude = way.norm();
    const double seconds = interaction::planned_duration(limb_, person_, amplitude, tolerance_of(target));
    if (amplitude > 0.0) {
      const double deviation = limb_.noise * amplitude / seconds;
      const Vector3 along = way / amplitude;
      Vector3 off;
      for (int axis = 0; axis < 3; ++axis)
        off[axis] = person_.aside * deviation * interaction::normal_number(random_);
      off += (deviation * interaction::normal_number(random_) - off.dot(along)) * along;
      way += off;
    }
    pass(seconds, aim_ + way);
  }

  /// The finger moves the hand while it goes down, more quickly than a person could correct that.
  void press() {
    Vector3 jolt;
    for (int axis = 0; axis < 3; ++axis) jolt[axis] = limb_.press_jolt * interaction::normal_number(random_);
    pass(person_.press, aim_ + jolt);
    button_ = true;
    tick();
    button_ = false;
    tick();
  }

  /// A push straight in, off aside as any movement; a hand that has not pushed deep enough comes back.
  void push() {
    const double depth = aim_.z() + element_.choosing.push_depth + kPushesPast;
    const double seconds = interaction::planned_duration(limb_, person_, depth, kPushesPast);
    const double aside = person_.aside * limb_.noise * depth / seconds;
    const Vector3 before = aim_;
    pass(seconds, aim_ + Vector3(aside * interaction::normal_number(random_),
                                 aside * interaction::normal_number(random_), -depth));
    rest(person_.correction);
    pass(seconds, before);
  }

  const PersonModel& person_;
  const LimbModel& limb_;
  const interaction::Element& element_;
  base::Random& random_;
  ElementUse use_;
  devices::SimulatedDevice hand_;
  haptics::Servo servo_;
  Vector3 phase_, hertz_;                     // rad, Hz: of the tremor, by axis
  Vector3 aim_ = Vector3(0.0, 0.0, kBefore);  // of the hand, without its tremor
  Vector3 tip_ = aim_;
  bool button_ = false;
  double time_ = 0.0;  // s
  MenuRun run_;
};

}  // namespace

MenuRun choose_from_menu(const PersonModel& person, const interaction::Element& element,
                         const interaction::TextMeasure& measure, const interaction::Widget& widget,
                         base::Random& random) {
  return MenuRunning(person, element, measure, random).go(widget);
}

}  // namespace icome::study
