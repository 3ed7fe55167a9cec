#include "study/run/trial_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "interaction/object_edits.h"
#include "study/definition/needs.h"
#include "study/run/trial_watch.h"

namespace icome::study {
namespace {

using session::SessionEvent;

const charts::Colour kStartColour{0.10, 0.45, 0.95};
constexpr double kStartRadius = 0.006;           // m
const base::Vector3 kTowardEye(0.0, 0.25, 1.0);  // from the front, a little above
constexpr double kHeldApart = 0.002;             // m from the start, beyond which a mouse's hand is put back

constexpr double kLooksAgain = speech::Ear::kPatience + 0.5;  // s, with the time that opening takes

double seconds(std::int64_t nanoseconds) { return double(nanoseconds) * 1e-9; }

}  // namespace

struct TrialStage::Parts {
  Parts(session::Session& where, const Study& what, std::filesystem::path beside, Participant who)
      : session(where), study(what), folder(std::move(beside)), participant(std::move(who)) {}

  session::Session& session;
  const Study& study;
  std::filesystem::path folder;
  Participant participant;

  State state = State::Idle;
  TrialPlan plan;
  std::filesystem::path loaded;  // the scene on the stage; empty: none of ours
  std::filesystem::path loading;
  std::vector<SessionEvent> events;
  session::DisplayWish look;
  std::optional<TrialWatch> watch;
  std::map<world::ObjectId, int> thing_numbers;
  std::int64_t began = 0;  // ns, the first tick
  std::uint64_t lost_before = 0;
  bool beep = false;
  bool hides = false;  // things are hidden by try_out()
  speech::OpenSource microphone = [] { return speech::open_microphone(); };
  std::unique_ptr<TrialEar> ear;  // null: no trial that needs speech was there yet
  bool hears = false;             // does this trial need it?
  double set_up_at = 0.0;         // s, on the clock of ears
  double released_at = 0.0;       // s, likewise
  std::vector<SaidInTrial> said;
  TrialMeasures measures;
  Trace trace;
  std::string why;

  void fail(const std::string& reason);
  void load();
  void hear(const SessionEvent& event);
  void begin_seeking();
  base::Result<TrialGoal> read_goal();
  base::Result<void> open_element(const TrialGoal& goal);
  base::Result<void> listen(const TrialGoal& goal);
  void hear_choices();
  void hide_things();
  void bring_back();
  void show_start();
  void light(int thing);
  void take_ticks();
  void take_tick(const session::PointerView& tick, const session::TouchedNames& names);
  void hold();
  void release();
  void end();
  void leave();
};

TrialStage::TrialStage(session::Session& session, const Study& study, std::filesystem::path folder,
                       const Participant& participant)
    : parts_(std::make_unique<Parts>(session, study, std::move(folder), participant)) {
  session::GrabSettings settings = session.hands().grab();
  settings.takes_hold = false;
  session.hands().set_grab(settings);
}

TrialStage::~TrialStage() { stop(); }

void TrialStage::set_look(const session::DisplayWish& look) {
  parts_->look = look;
  parts_->show_start();
}

void TrialStage::begin(const TrialPlan& plan) {
  stop();  // brings back the things of the trial before, unseen
  parts_->plan = plan;
  parts_->load();
}

void TrialStage::stop() {
  parts_->leave();
  parts_->bring_back();
  parts_->session.view().follow_head(true);
  parts_->session.view().ask_for_stereo(std::nullopt);
  parts_->state = State::Idle;
}

/// Undoes the changes that a trial has made to the session, apart from hidden things.
void TrialStage::Parts::leave() {
  session.hands().trace(false);
  session.hands().hold_pointer({});
  session.hands().give_forces(true);
  session.menu().close();
  light(-1);
  watch.reset();
  show_start();
}

void TrialStage::Parts::fail(const std::string& reason) {
  leave();
  state = State::Failed;
  why = reason;
}

void TrialStage::Parts::load() {
  const TrialScene* const scene = scene_of(study, plan);
  if (scene == nullptr || scene->file.empty())
    return fail(
        "No scene file says where this trial takes place: write one in the study file, as file = "
        "\"room.wrl\".");
  loading = folder / scene->file;
  state = State::Loading;
  if (loading == loaded) return begin_seeking();
  loaded.clear();
  session.files().open(loading);
}

void TrialStage::Parts::hear(const SessionEvent& event) {
  if (event.kind == SessionEvent::Kind::DeviceLost && state > State::Loading && state < State::Over)
    return fail(event.text);
  if (state != State::Loading) return;
  if (event.kind == SessionEvent::Kind::OpenFailed) fail(event.text);
  if (event.kind != SessionEvent::Kind::Opened) return;
  loaded = loading;
  begin_seeking();
}

base::Result<TrialGoal> TrialStage::Parts::read_goal() {
  const TrialScene* const scene = scene_of(study, plan);
  if (!scene->element) return trial_goal(study, participant, plan, session.world());
  const auto element = read_stage_element(*scene->element, folder);
  if (!element) return tl::unexpected(element.error());
  return trial_goal(study, participant, plan, session.world(), &*element);
}

/// Opens the trial's element in the session, where it is seen and felt. What counts is what the watch's own
/// use of it makes of each tick; both have the same pointer and the same settings.
base::Result<void> TrialStage::Parts::open_element(const TrialGoal& goal) {
  if (!goal.element) return {};
  const interaction::Element& element = *goal.element->element;
  return session.menu().open(element, element.languages[goal.element->language], {});
}

void TrialStage::Parts::begin_seeking() {
  hide_things();
  auto goal = read_goal();
  if (!goal) return fail(goal.error().message);
  session.settle();
  thing_numbers.clear();
  trace = {};
  for (const Thing& thing : goal->things) {
    if (thing.widget == nullptr) thing_numbers[thing.object] = int(trace.things.size());
    trace.things.push_back(thing.name);
  }
  trace.rate_hz = session.hands().servo().rate_hz;
  trace.device = session.hands().pointer_info(0).name;
  base::Bounds all;
  for (const Thing& thing : goal->things) all.extend(thing.bounds);
  all.extend(goal->start);
  session.view().set(interaction::fitted(session.view().now(), all, kTowardEye, base::Vector3::UnitY(),
                                         session.view().aspect()));
  session.view().follow_head(goal->head);
  session.view().ask_for_stereo(goal->stereo);
  if (const auto opened = open_element(*goal); !opened) return fail(opened.error().message);
  if (const auto listening = listen(*goal); !listening) return fail(listening.error().message);
  watch.emplace(std::move(*goal));
  session.hands().take_trace();  // the rest of another trial
  lost_before = session.hands().take_trace().lost;
  session.hands().trace(true);
  began = 0;
  state = State::Seeking;
  show_start();
}

base::Result<void> TrialStage::Parts::listen(const TrialGoal& goal) {
  said.clear();
  set_up_at = speech::clock_of_ears();
  hears = goal.speech;
  if (ear) ear->mute(!hears);
  if (!hears) return {};
  if (!ear) ear = std::make_unique<TrialEar>(microphone);
  return ear->expect(goal);
}

/// Lets what was said since the start choose. What was begun before it is kept, and chooses nothing. A trial
/// that is done again begins while the ear may not have looked yet whether the microphone is back.
void TrialStage::Parts::hear_choices() {
  const bool has_looked = speech::clock_of_ears() > set_up_at + kLooksAgain || state == State::Running;
  if (const std::string problem = ear->problem(); has_looked && !problem.empty())
    return fail("Nothing can be heard: " + problem + (problem.ends_with('.') ? "" : "."));
  for (SaidInTrial& one : ear->take()) {
    if (state != State::Running) continue;
    one.begin -= released_at;
    one.end -= released_at;
    if (one.begin < 0.0) one.thing = -1;
    if (one.thing >= 0) watch->say(one.thing);
    said.push_back(std::move(one));
  }
}

void TrialStage::Parts::hide_things() {
  const auto hidden = hidden_things(study, plan, session.world());
  if (hidden.empty()) return;
  const auto done = session.history().try_out(interaction::delete_objects(session.world(), hidden), "Trial");
  hides = done.has_value();
  if (!done) fail(done.error().message);
}

void TrialStage::Parts::bring_back() {
  if (std::exchange(hides, false)) (void)session.history().take_back();
}

/// Shows a ball at the start while it is sought.
void TrialStage::Parts::show_start() {
  session::DisplayWish wish = look;
  if (state == State::Seeking && watch)
    wish.look.overlay.balls.push_back({watch->goal().start, kStartRadius, kStartColour});
  session.view().set_look(wish);
}

void TrialStage::Parts::light(int thing) {
  std::vector<world::ObjectId> lit;
  const bool is_object = watch && thing >= 0 && !watch->goal().things[std::size_t(thing)].widget;
  if (is_object) lit.push_back(watch->goal().things[std::size_t(thing)].object);
  if (session.selection() != lit) session.select(lit);
}

TrialStage::State TrialStage::update() {
  for (SessionEvent& event : parts_->session.update()) {
    parts_->hear(event);
    parts_->events.push_back(std::move(event));
  }
  if (parts_->watch && parts_->state != State::Over) parts_->take_ticks();
  return parts_->state;
}

void TrialStage::Parts::take_ticks() {
  const session::SessionHands::Ticks taken = session.hands().take_trace();
  // Ticks that are lost before the pointer is caught would not be kept anyway.
  if (watch->state() == TrialWatch::State::Seeking) lost_before = taken.lost;
  if (taken.lost > lost_before)
    return fail("The computer was too busy to keep every movement: the trial has to be done again.");
  if (hears) hear_choices();
  if (!watch) return;  // nothing can be heard
  for (const session::PointerView& tick : taken.ticks)
    if (watch->state() != TrialWatch::State::Over) take_tick(tick, *taken.names);
  if (watch->is_due() && (!hears || ear->is_ready())) release();
  if (watch->state() == TrialWatch::State::Over) return end();
  if (state == State::Seeking || state == State::Holding) hold();
  light(watch->lit());
}

void TrialStage::Parts::take_tick(const session::PointerView& tick, const session::TouchedNames& names) {
  if (tick.status == devices::DeviceStatus::Lost) return;  // update() gets the event
  if (began == 0) began = tick.time;
  Sample sample;
  sample.time = seconds(tick.time - began);
  sample.tip = tick.tip;
  sample.orientation = tick.orientation;
  sample.scp = tick.scp;
  sample.force = tick.force;
  sample.buttons = tick.buttons;
  if (tick.touching) {
    const auto object = names.object(tick.touched);
    const auto number = object ? thing_numbers.find(*object) : thing_numbers.end();
    if (number != thing_numbers.end()) sample.touched = number->second;
  }
  const TrialWatch::State before = watch->state();
  if (watch->step(sample) == before) return;
  if (watch->state() == TrialWatch::State::Holding) {
    state = State::Holding;
    session.hands().hold_pointer(watch->goal().start);
    session.view().recentre_head();
  } else if (watch->state() == TrialWatch::State::Seeking) {
    state = State::Seeking;
    session.hands().hold_pointer({});
  }
  show_start();
}

/// Puts a mouse's hand at the start, and back there, also after a new view has moved it: a mouse cannot find
/// a place in three dimensions, and its hand would pull stronger than a device may.
void TrialStage::Parts::hold() {
  const base::Vector3& start = watch->goal().start;
  if (session.hands().is_mouse_driven() && (session.hands().pointer(0).tip - start).norm() > kHeldApart)
    session.hands().put(start);
}

void TrialStage::Parts::release() {
  if (state == State::Running) return;  // the tick that starts it is still to come
  // Springs hold the pointer in all conditions alike; the condition's setting of forces begins now.
  session.hands().hold_pointer({});
  session.hands().give_forces(watch->goal().forces);
  watch->release();
  released_at = speech::clock_of_ears();
  state = State::Running;
  beep = study.trials.beep;
}

void TrialStage::Parts::end() {
  trace.samples = watch->samples();
  measures = watch->measures();
  leave();
  state = State::Over;
}

TrialStage::State TrialStage::state() const { return parts_->state; }

std::vector<SessionEvent> TrialStage::take_events() { return std::exchange(parts_->events, {}); }

bool TrialStage::take_beep() { return std::exchange(parts_->beep, false); }

double TrialStage::hold_left() const { return parts_->watch ? parts_->watch->hold_left() : 0.0; }

bool TrialStage::awaits_ear() const {
  return parts_->state == State::Holding && hold_left() <= 0.0 && parts_->hears && !parts_->ear->is_ready();
}

base::Vector3 TrialStage::start() const {
  return parts_->watch ? parts_->watch->goal().start : base::Vector3(base::Vector3::Zero());
}

const std::vector<SaidInTrial>& TrialStage::said() const { return parts_->said; }

void TrialStage::listen_to(speech::OpenSource microphone) {
  parts_->microphone = std::move(microphone);
  const std::vector<std::string> needs = all_needs(parts_->study);
  if (std::ranges::find(needs, "speech") == needs.end()) return;
  // The recogniser takes some seconds to come, in which people read.
  parts_->ear = std::make_unique<TrialEar>(parts_->microphone);
}

const TrialMeasures& TrialStage::measures() const { return parts_->measures; }

const Trace& TrialStage::trace() const { return parts_->trace; }

const std::string& TrialStage::why() const { return parts_->why; }

}  // namespace icome::study
