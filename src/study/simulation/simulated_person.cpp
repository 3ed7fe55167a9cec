#include "study/simulation/simulated_person.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "devices/simulated/simulated_device.h"
#include "haptics/servo/servo.h"
#include "session/elements/felt_sheets.h"
#include "study/definition/needs.h"
#include "study/run/trial_watch.h"
#include "study/simulation/depth_sight.h"
#include "study/simulation/route.h"

namespace icome::study {
namespace {

using base::Vector3;

constexpr double kRate = 1000.0;         // Hz
constexpr double kClearance = 0.010;     // m, kept from things that are not to be touched
constexpr double kWayTolerance = 0.006;  // m, at corners of the way
constexpr double kHover = 0.008;         // m, before the thing that is to be touched
constexpr double kTouchDepth = 0.010;    // m, behind the surface, aimed at by a touch
constexpr double kRestDepth = 0.001;     // m, behind the surface, where a click rests
constexpr double kTouchTime = 0.25;      // s, of the last bit of a touch
constexpr double kPushTime = 0.6;        // s, of a push
constexpr double kPushSurplus = 6.0;     // times the depth: surfaces push back
constexpr int kMostSeekTicks = 10'000;   // in which the start is to be found
constexpr int kTicksAFrame = 16;         // after which the element's sheets are followed, as by a display
constexpr int kYoungest = 18, kOldest = 65;

std::uint64_t mixed(std::uint64_t seed, std::initializer_list<std::uint64_t> parts) {
  for (const std::uint64_t part : parts)
    seed = base::Random(seed ^ ((part + 1) * 0x9e3779b97f4a7c15ULL)).bits();
  return seed;
}

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char c : text) hash = (hash ^ std::uint64_t(static_cast<unsigned char>(c))) * 0x100000001b3ULL;
  return hash;
}

std::string any_answer(const Item& item, base::Random& random) {
  switch (item.kind) {
    case ItemKind::Choice:
      return item.choices[random.index(item.choices.size())].id;
    case ItemKind::Choices: {
      std::string some;
      for (const Level& choice : item.choices)
        if (random.index(2) == 0) some.append(some.empty() ? "" : ",").append(choice.id);
      return some.empty() ? item.choices.front().id : some;
    }
    case ItemKind::Rating:
      return std::to_string(1 + random.index(std::uint64_t(item.points)));
    case ItemKind::Number: {
      const double least = item.least.value_or(item.most ? *item.most - 100.0 : 0.0);
      const double most = item.most.value_or(least + 100.0);
      return fmt::format("{}", std::clamp(std::round(random.uniform(least, most)), least, most));
    }
    case ItemKind::OpenText:
      break;
  }
  return "SIMULATED";
}

/// A trial under way. Time passes in ticks of the servo; the code gives the hand's intentions in sequence.
class SimulatedTrialRun {
 public:
  SimulatedTrialRun(const interaction::PersonModel& model, const TrialGoal& goal, bool tracked,
                    const FeltScene& where, std::uint64_t seed)
      : model_(model),
        sight_(model, goal.stereo.value_or(false), goal.head && tracked),
        random_(seed),
        where_(where),
        watch_(goal),
        hand_(hand_settings()),
        servo_(hand_, servo_settings(goal.start)),
        at_(goal.start) {
    for (std::size_t i = 0; i < goal.things.size(); ++i)
      if (goal.things[i].widget == nullptr) numbers_[goal.things[i].object] = int(i);
    servo_.publish(where.scene);
    servo_.give_forces(goal.forces);
    for (int axis = 0; axis < 3; ++axis) {
      phase_[axis] = random_.uniform(0.0, 2.0 * std::numbers::pi);
      frequency_[axis] = model_.tremor_hz * random_.uniform(0.9, 1.1);
      amplitude_[axis] = std::numbers::sqrt2 * model_.arm.tremor / gain_at(frequency_[axis]);
    }
    find_goal();
  }
  SimulatedTrialRun(const SimulatedTrialRun&) = delete;
  SimulatedTrialRun& operator=(const SimulatedTrialRun&) = delete;

  SimulatedPerson::Run go() {
    take_hold();
    while (!over() && watch_.state() != TrialWatch::State::Seeking) {
      find_goal();
      for (const Vector3& corner : route(at_, hover_, obstacles_, kClearance)) move(corner, corner == hover_);
      const bool is_wrong = sees_another();
      rest(model_.correction);
      if (!is_wrong) choose();
    }
    SimulatedPerson::Run run;
    run.measures = watch_.measures();
    run.measures.completed = run.measures.completed && over();
    run.trace.rate_hz = kRate;
    run.trace.device = hand_.info().name;
    for (const Thing& thing : watch_.goal().things) run.trace.things.push_back(thing.name);
    run.trace.samples = watch_.samples();
    return run;
  }

 private:
  static devices::SimulatedSettings hand_settings() {
    devices::SimulatedSettings settings;
    settings.rate = kRate;
    return settings;
  }

  static haptics::ServoSettings servo_settings(const Vector3& start) {
    haptics::ServoSettings settings;
    settings.rate_hz = kRate;
    settings.world_from_device.translation() = start;
    return settings;
  }

  /// Comes to the start, where the trial begins. A start in something solid, which the hand is kept out of,
  /// is given up.
  void take_hold() {
    for (int i = 0; i < kMostSeekTicks && watch_.state() != TrialWatch::State::Holding; ++i) tick();
    if (watch_.state() != TrialWatch::State::Holding) return;
    sight_.recentre();  // as the program does it for people
    rest(kSimulatedHold);
    watch_.release();
    rest(model_.reaction);
  }

  /// Finds the face that the hand is to come to.
  void find_goal() {
    obstacles_.clear();
    for (const Thing& thing : watch_.goal().things)
      if (!thing.target && thing.widget == nullptr) obstacles_.push_back(thing.bounds);
    watch_.goal().is_in_element() ? find_widget() : find_object();
    hover_ = surface_ + kHover * outward_;
  }

  /// The widget to aim at now: the target or, while the menu that it is in is closed, the item that leads
  /// there and can be seen.
  const interaction::LaidWidget* aim_at(const std::vector<interaction::Widget>& widgets) const {
    const auto& laid = watch_.element()->layout().widgets;
    for (const interaction::Widget& widget : widgets) {
      const int number = watch_.goal().thing_of(widget);
      const interaction::LaidWidget* found = aim_at(widget.widgets);
      const bool is_target = number >= 0 && watch_.goal().things[std::size_t(number)].target;
      if (found == nullptr && !is_target && !leads_to_target(widget)) continue;
      const auto seen = std::ranges::find(laid, &widget, &interaction::LaidWidget::widget);
      if (found == nullptr && seen != laid.end()) found = &*seen;
      if (found != nullptr) return found;
    }
    return nullptr;
  }

  bool leads_to_target(const interaction::Widget& widget) const {
    return std::ranges::any_of(widget.widgets, [&](const interaction::Widget& below) {
      const int number = watch_.goal().thing_of(below);
      return (number >= 0 && watch_.goal().things[std::size_t(number)].target) || leads_to_target(below);
    });
  }

  /// Comes to an element from its front, from where it is felt and pushed.
  void find_widget() {
    const interaction::LaidWidget* const laid = aim_at(watch_.element()->element().widgets);
    const interaction::ElementFrame& frame = watch_.element()->frame();
    outward_ = frame.normal();
    surface_ = frame.in_world(laid->centre);
    tolerance_ = std::max(std::min(kWayTolerance, frame.size * laid->half.minCoeff()), 1e-4);
  }

  /// Finds the face of the target that is turned to the start.
  void find_object() {
    const TrialGoal& goal = watch_.goal();
    base::Bounds target;
    for (const Thing& thing : goal.things)
      if (thing.target) target.extend(thing.bounds);
    const Vector3 half = 0.5 * target.sizes();
    int facing = 0;
    Vector3 toward = goal.start - target.center();
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(toward[axis]) - half[axis] > std::abs(toward[facing]) - half[facing]) facing = axis;
    outward_ = Vector3::Zero();
    outward_[facing] = toward[facing] < 0.0 ? -1.0 : 1.0;
    surface_ = target.center() + half[facing] * outward_;
    tolerance_ = kWayTolerance;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != facing) tolerance_ = std::min(tolerance_, std::max(half[axis], 1e-4));
  }

  /// The share of a motion at a frequency (Hz) that a hand with the device in it follows in free air. The
  /// model's tremor is that of the tip, which this would change.
  static double gain_at(double frequency) {
    const devices::SimulatedSettings settings = hand_settings();
    const double w = 2.0 * std::numbers::pi * frequency;
    const double mass = settings.info.effective_mass + settings.hand.mass;
    const double spring = settings.hand.stiffness;
    return spring / std::hypot(spring - mass * w * w, settings.hand.damping * w);
  }

  /// Is something lit that would be a wrong choice? Who sees that corrects the movement first.
  bool sees_another() const {
    const int lit = watch_.lit();
    return lit >= 0 && watch_.goal().things[std::size_t(lit)].wrong;
  }

  bool over() const { return watch_.state() == TrialWatch::State::Over; }

  Vector3 tremor() const {
    Vector3 off;
    for (int axis = 0; axis < 3; ++axis)
      off[axis] = amplitude_[axis] *
                  std::sin(2.0 * std::numbers::pi * frequency_[axis] * hand_.time() + phase_[axis]);
    return off;
  }

  void tick() {
    hand_.set_target(at_ + tremor() - watch_.goal().start);
    const haptics::TickReport& report = servo_.tick(1.0 / kRate);
    Sample sample;
    sample.time = hand_.time();
    sample.tip = report.tip;
    sample.orientation = report.orientation;
    sample.scp = report.contact.touching ? report.contact.scp : report.tip;
    sample.force = report.force;
    sample.buttons = report.buttons;
    if (report.contact.touching) sample.touched = number_of(report.object);
    watch_.step(sample);
    sight_.look(sample.time);
    feel_element();
  }

  /// Lets the hand feel the element's sheets, as a session does for people.
  void feel_element() {
    if (watch_.element() == nullptr || ticks_++ % kTicksAFrame != 0) return;
    if (sheets_.follow(watch_.element(), hand_.time())) servo_.publish_effects(sheets_.effects());
  }

  int number_of(base::ObjectId felt) const {
    const auto object = where_.names->object(felt);
    const auto found = object ? numbers_.find(*object) : numbers_.end();
    return found == numbers_.end() ? -1 : found->second;
  }

  /// Lets time pass while the hand moves to a place, or stays; less time if the trial ends.
  void pass(double duration, const Vector3& to) {
    const Vector3 from = at_;
    const int ticks = std::max(1, int(std::lround(duration * kRate)));
    for (int i = 1; i <= ticks && !over(); ++i) {
      at_ = from + interaction::minimum_jerk(double(i) / ticks) * (to - from);
      tick();
    }
  }

  void rest(double duration) { pass(duration, at_); }

  /// Makes one movement; its end is off by noise, and a goal's depth is not seen sharply.
  void move(const Vector3& corner, bool last) {
    Vector3 seen = corner;
    if (last) seen.z() += sight_.deviation() * interaction::normal_number(random_);
    const Vector3 way = seen - at_;
    const double amplitude = way.norm();
    if (amplitude == 0.0) return;
    const double duration =
        interaction::planned_duration(model_.arm, model_, amplitude, last ? tolerance_ : kWayTolerance);
    const double deviation = model_.arm.noise * amplitude / duration;
    const Vector3 along = way / amplitude;
    Vector3 off;
    for (int axis = 0; axis < 3; ++axis)
      off[axis] = model_.aside * deviation * interaction::normal_number(random_);
    off += (deviation * interaction::normal_number(random_) - off.dot(along)) * along;
    pass(duration, seen + off);
  }

  void choose() {
    const TrialGoal& goal = watch_.goal();
    const Vector3 before = at_;
    if (goal.choosing == Choosing::Click) {
      pass(kTouchTime, at_ - (kHover + kRestDepth) * outward_);
      press();
    } else {
      const bool touch = goal.choosing == Choosing::Touch;
      const double depth = touch ? kTouchDepth : kPushSurplus * goal.depth;
      pass(touch ? kTouchTime : kPushTime, at_ - (kHover + depth) * outward_);
    }
    if (!over()) pass(kTouchTime, before);
  }

  void press() {
    rest(model_.press);
    if (over()) return;
    for (int axis = 0; axis < 3; ++axis)
      at_[axis] += model_.arm.press_jolt * interaction::normal_number(random_);
    hand_.hold_buttons(1);
    rest(model_.press);
    hand_.hold_buttons(0);
  }

  const interaction::PersonModel& model_;
  DepthSight sight_;
  base::Random random_;
  const FeltScene& where_;
  TrialWatch watch_;
  devices::SimulatedDevice hand_;
  haptics::Servo servo_;
  session::FeltSheets sheets_;
  int ticks_ = 0;
  std::map<world::ObjectId, int> numbers_;
  std::vector<base::Bounds> obstacles_;
  Vector3 at_;  // the intended place of the hand, without its tremor; m, stage frame
  Vector3 outward_, surface_, hover_;
  double tolerance_ = kWayTolerance;
  Vector3 phase_, frequency_, amplitude_;  // rad, Hz, m: of the tremor that the hand intends, by axis
};

}  // namespace

SimulatedPerson::SimulatedPerson(const Study& study, std::uint64_t number)
    : seed_(mixed(study.seed, {number, 1})) {
  const std::vector<std::string> needs = all_needs(study);
  tracked_ = std::ranges::find(needs, "head-tracking") != needs.end();
  base::Random random(seed_);
  model_ = interaction::drawn_person({}, random);
}

std::vector<std::string> SimulatedPerson::control(const Study& study, std::uint64_t number) {
  base::Random random(mixed(study.seed, {number, 2}));
  std::vector<std::string> answers;
  for (const ControlVariable& variable : study.control)
    answers.push_back(variable.levels.empty()
                          ? std::to_string(kYoungest + random.index(kOldest - kYoungest + 1))
                          : variable.levels[random.index(variable.levels.size())].id);
  return answers;
}

std::vector<std::string> SimulatedPerson::answers(const Questionnaire& questionnaire,
                                                  std::size_t position) const {
  base::Random random(mixed(seed_, {hash_of(questionnaire.id), position}));
  std::vector<std::string> answers;
  for (const Item& item : questionnaire.items) answers.push_back(any_answer(item, random));
  return answers;
}

SimulatedPerson::Run SimulatedPerson::trial(const TrialPlan& plan, const TrialGoal& goal,
                                            const FeltScene& where) const {
  const std::uint64_t seed = mixed(seed_, {plan.position, plan.number, plan.practice ? 1U : 0U});
  return SimulatedTrialRun(model_, goal, tracked_, where, seed).go();
}

}  // namespace icome::study
