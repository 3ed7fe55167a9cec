#include "study/run/trial_stage.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "session/sessions.h"
#include "speech/said_aloud.h"
#include "study/trial_menus.h"
#include "study/trial_scenes.h"

namespace icome::study {
namespace {

using State = TrialStage::State;
using base::Vector3;

/// Takes the stage on until it is there, or farther where the machine is slow; a test that waits for ever
/// says by its name what for.
template <typename Meanwhile>
State wait_for(TrialStage& stage, State state, const Meanwhile& meanwhile) {
  while (stage.state() < state) {
    stage.update();
    meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return stage.state();
}
State wait_for(TrialStage& stage, State state) {
  return wait_for(stage, state, [] {});
}

/// The hand of the mouse goes straight to a place, at some decimetres a second.
auto leads_to(session::Session& session, const Vector3& goal) {
  return [&session, goal] {
    const Vector3 tip = session.hands().pointer(0).tip;
    const Vector3 way = goal - tip;
    session.hands().aim(way.norm() < 0.01 ? goal : Vector3(tip + 0.01 * way.normalized()));
  };
}

struct Blank {
  Blank() {
    study.trials.hold = 0.05;
    stage = std::make_unique<TrialStage>(*session, study, folder.path(), Participant{});
  }
  TemplateFolder folder{"blank"};
  Study study = folder.study();
  std::unique_ptr<session::Session> session = session::start();
  std::unique_ptr<TrialStage> stage;
};

TEST(TrialStage, MeasuresATrialWithTheMousesHand) {
  Blank blank;
  blank.stage->begin(measured_trial(blank.study, {}, 0, 0));
  ASSERT_EQ(wait_for(*blank.stage, State::Running), State::Running) << blank.stage->why();
  EXPECT_TRUE(blank.stage->take_beep());
  EXPECT_FALSE(blank.stage->take_beep());
  EXPECT_NEAR((blank.session->hands().pointer(0).tip - blank.study.task->start).norm(), 0.0, 0.002);
  // Over the block, to the target.
  bool is_over_block = false;
  const auto climbs = leads_to(*blank.session, {0.06, 0.03, 0.0});
  const auto reaches = leads_to(*blank.session, {0.06, -0.03, -0.06});
  ASSERT_EQ(wait_for(*blank.stage, State::Over,
                     [&] {
                       is_over_block = is_over_block || blank.session->hands().pointer(0).tip.y() > 0.025;
                       is_over_block ? reaches() : climbs();
                     }),
            State::Over)
      << blank.stage->why();
  const TrialMeasures& measures = blank.stage->measures();
  EXPECT_TRUE(measures.completed);
  EXPECT_GT(measures.distance, 0.15);
  EXPECT_LT(measures.approach_time, measures.time);
  const Trace& trace = blank.stage->trace();
  EXPECT_EQ(trace.rate_hz, 1000.0);
  ASSERT_GE(trace.samples.size(), 100U);
  EXPECT_EQ(trace.things[std::size_t(trace.samples.back().touched)], "target");
  EXPECT_NEAR(trace.samples.back().time, measures.time, 1e-6);
  for (std::size_t i = 1; i < trace.samples.size(); ++i)
    EXPECT_GT(trace.samples[i].time, trace.samples[i - 1].time);
}

TEST(TrialStage, AHeldPointerStaysAtTheStart) {
  Blank blank;
  blank.study.trials.hold = 2.0;
  blank.stage->begin(measured_trial(blank.study, {}, 0, 0));
  ASSERT_EQ(wait_for(*blank.stage, State::Holding), State::Holding) << blank.stage->why();
  EXPECT_GT(blank.stage->hold_left(), 0.1);
  double farthest = 0.0;
  const auto pulls = leads_to(*blank.session, {0.1, 0.0, 0.1});
  wait_for(*blank.stage, State::Running, [&] {
    farthest = std::max(farthest, (blank.session->hands().pointer(0).tip - blank.study.task->start).norm());
    pulls();
  });
  EXPECT_LT(farthest, 0.03);
}

TEST(TrialStage, GivesNoForcesWhereTheConditionHasNone) {
  Blank blank;
  TrialPlan plan = measured_trial(blank.study, {}, 0, 0);
  plan.condition = 0;  // "old": without forces
  blank.stage->begin(plan);
  ASSERT_EQ(wait_for(*blank.stage, State::Running), State::Running) << blank.stage->why();
  wait_for(*blank.stage, State::Over, leads_to(*blank.session, {0.06, -0.03, -0.06}));
  double strongest = 0.0;
  // What held it is let go within some ticks.
  for (const Sample& sample : blank.stage->trace().samples)
    if (sample.time > 0.05) strongest = std::max(strongest, sample.force.norm());
  EXPECT_EQ(strongest, 0.0);
}

/// A quiet room in which somebody speaks when told to.
class Speaking final : public speech::SoundSource {
 public:
  struct Person {
    std::mutex mutex;
    std::vector<std::int16_t> left;  // to be said

    void say(const std::string& sentence) {
      std::vector<std::int16_t> said = speech::said_aloud(sentence);
      const std::lock_guard lock(mutex);
      left = std::move(said);
    }
  };
  explicit Speaking(Person& person) : person_(person) {}

  base::Result<std::vector<std::int16_t>> read() override {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun_;
    const auto now = std::size_t(passed.count() * speech::kSampleRate);
    std::vector<std::int16_t> came(now - read_, 0);
    for (std::size_t i = 0; i < came.size(); ++i) came[i] = std::int16_t((read_ + i) * 7919 % 13) - 6;
    read_ = now;
    const std::lock_guard lock(person_.mutex);
    const std::size_t count = std::min(came.size(), person_.left.size());
    std::copy_n(person_.left.begin(), count, came.begin());
    person_.left.erase(person_.left.begin(), person_.left.begin() + std::ptrdiff_t(count));
    return came;
  }

 private:
  Person& person_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::size_t read_ = 0;
};

/// Lets the stage go on for so many seconds, or until the trial is over.
void go_on(TrialStage& stage, double seconds) {
  const double end = speech::clock_of_ears() + seconds;
  while (speech::clock_of_ears() < end && stage.update() < State::Over)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

TEST(TrialStage, ThingsAreChosenBySayingTheirNamesWhereTheConditionHasIt) {
  Blank blank;
  blank.study.independent[0].levels[1].needs = {"speech"};
  Speaking::Person person;
  blank.stage->listen_to([&]() -> base::Result<std::unique_ptr<speech::SoundSource>> {
    return std::make_unique<Speaking>(person);
  });
  TrialPlan plan = measured_trial(blank.study, {}, 0, 0);
  plan.condition = 1;
  blank.stage->begin(plan);
  ASSERT_EQ(wait_for(*blank.stage, State::Running), State::Running) << blank.stage->why();
  go_on(*blank.stage, 0.5);
  person.say("block");
  go_on(*blank.stage, 4.0);
  ASSERT_EQ(blank.stage->state(), State::Running);
  person.say("select the target");
  ASSERT_EQ(wait_for(*blank.stage, State::Over), State::Over) << blank.stage->why();
  EXPECT_TRUE(blank.stage->measures().completed);
  EXPECT_EQ(blank.stage->measures().errors, 1);
  const std::vector<SaidInTrial>& said = blank.stage->said();
  ASSERT_EQ(said.size(), 2U);
  const auto name = [&](int thing) { return blank.stage->trace().things.at(std::size_t(thing)); };
  EXPECT_EQ(said[0].heard, "block");
  EXPECT_EQ(name(said[0].thing), "block");
  EXPECT_EQ(said[1].heard, "select the target");
  EXPECT_EQ(name(said[1].thing), "target");
  EXPECT_NEAR(said[0].begin, 0.6, 0.3);
  EXPECT_GT(said[1].begin, said[0].end);
  EXPECT_LT(said[1].end, blank.stage->measures().time);
  // The other condition has no ears.
  plan.condition = 0;
  blank.stage->begin(plan);
  ASSERT_EQ(wait_for(*blank.stage, State::Running), State::Running) << blank.stage->why();
  person.say("select the target");
  go_on(*blank.stage, 3.0);
  EXPECT_EQ(blank.stage->state(), State::Running);
  EXPECT_TRUE(blank.stage->said().empty());
}

TEST(TrialStage, ATrialThatNeedsSpeechFailsWithoutAMicrophone) {
  Blank blank;
  blank.study.needs = {"speech"};
  blank.stage->listen_to([]() -> base::Result<std::unique_ptr<speech::SoundSource>> {
    return base::fail("there is no microphone");
  });
  blank.stage->begin(measured_trial(blank.study, {}, 0, 0));
  ASSERT_EQ(wait_for(*blank.stage, State::Over), State::Failed);
  EXPECT_EQ(blank.stage->why(), "Nothing can be heard: there is no microphone.");
}

TEST(TrialStage, AMicrophoneThatIsBackIsHeardInTheTrialThatIsDoneAgain) {
  Blank blank;
  blank.study.needs = {"speech"};
  Speaking::Person person;
  std::atomic<bool> is_there = false;
  blank.stage->listen_to([&]() -> base::Result<std::unique_ptr<speech::SoundSource>> {
    if (!is_there) return base::fail("there is no microphone");
    return std::make_unique<Speaking>(person);
  });
  const TrialPlan plan = measured_trial(blank.study, {}, 0, 0);
  blank.stage->begin(plan);
  ASSERT_EQ(wait_for(*blank.stage, State::Over), State::Failed);
  is_there = true;
  blank.stage->begin(plan);
  EXPECT_EQ(wait_for(*blank.stage, State::Running), State::Running) << blank.stage->why();
}

/// A head that leans to the right.
class LeaningHead final : public devices::HeadDevice {
 public:
  const std::string& name() const override { return name_; }
  devices::DeviceStatus read(base::Pose& user_from_head) override {
    user_from_head = base::Pose::Identity();
    user_from_head.translation().x() = lean;
    return devices::DeviceStatus::Ok;
  }
  double lean = 0.0;  // m

 private:
  std::string name_ = "leaning";
};

/// How far the eye is off the study's view while the head leans in a trial of that condition, m.
double eye_off_view(std::size_t condition) {
  const TemplateFolder folder("head-tracking");
  Study study = folder.study();
  study.trials.hold = 0.05;
  session::SessionSettings settings = session::quiet_settings();
  auto head = std::make_unique<LeaningHead>();
  LeaningHead& leaning = *head;
  leaning.lean = 0.08;  // as the person sits: the eye is at rest there
  settings.head = std::move(head);
  const auto session = session::start(std::move(settings));
  TrialStage stage(*session, study, folder.path(), Participant{});
  TrialPlan plan = measured_trial(study, {}, 0, 0);
  plan.condition = condition;
  stage.begin(plan);
  EXPECT_EQ(wait_for(stage, State::Running), State::Running) << stage.why();
  const auto off = [&] {
    return (session->view().drawn_view().world_from_eye.translation() -
            session->view().now().world_from_eye.translation())
        .norm();
  };
  EXPECT_LT(off(), 1e-3) << "recentred as the pointer was caught";
  leaning.lean = 0.2;
  for (int i = 0; i < 50; ++i) {
    stage.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return off();
}

TEST(TrialStage, TheEyeFollowsTheHeadWhereTheConditionHasIt) {
  EXPECT_GT(eye_off_view(0), 0.01);
  EXPECT_LT(eye_off_view(1), 1e-3);
}

TEST(TrialStage, ThingsThatAreNotInATrialAreBackAfterIt) {
  TemplateFolder folder("menu");
  Study study = folder.study();
  study.trials.hold = 0.02;
  const auto session = session::start();
  TrialStage stage(*session, study, folder.path(), {});
  stage.begin(measured_trial(study, {}, 0, 0));
  ASSERT_EQ(wait_for(stage, State::Running), State::Running) << stage.why();
  const std::size_t shown = session->world().objects().size();
  stage.stop();
  EXPECT_EQ(session->world().objects().size(), shown + 6);
  EXPECT_FALSE(session->files().modified());
  stage.begin(measured_trial(study, {}, 0, 1));
  EXPECT_EQ(wait_for(stage, State::Running), State::Running) << stage.why();
  EXPECT_EQ(session->world().objects().size(), shown);
}

/// The menu study with a mouse's hand, in one of its groups (click, push) and conditions (forces, none).
struct Menu {
  Menu(std::size_t group, std::size_t condition) {
    study.trials.hold = 0.02;
    Participant person;
    person.group = group;
    plan = measured_trial(study, person, 0, 0);
    plan.condition = condition;
    stage = std::make_unique<TrialStage>(*session, study, folder.path(), person);
    session->menu().on_choice([this](const session::MenuChoice& it) { shown.push_back(it.widget.name); });
    stage->begin(plan);
  }

  std::string target() const { return study.trials.variables[0].values[plan.values[0]].id; }
  std::string other() const { return target() == "red" ? "green" : "red"; }
  Vector3 before(const std::string& item, double front) const {
    const interaction::ElementUse& use = *session->menu().use();
    return middle_of(use, item) + front * use.frame().normal();
  }
  bool is_at(const Vector3& place) const { return (session->hands().pointer(0).tip - place).norm() < 0.004; }
  /// The hand goes there, and stays until that is so.
  template <typename IsSo>
  void go(const Vector3& place, const IsSo& is_so) {
    const auto leads = leads_to(*session, place);
    while (stage->update() < State::Over && !is_so()) {
      leads();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  void go(const Vector3& place) {
    go(place, [&] { return is_at(place); });
  }
  void click() {
    for (const std::uint32_t buttons : {1U, 0U}) {
      session->hands().hold_buttons(buttons);
      for (int i = 0; i < 20; ++i) {
        stage->update();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    }
  }
  std::vector<std::string> chosen() const {
    std::vector<std::string> names;
    for (const Sample& sample : stage->trace().samples)
      if (sample.chosen >= 0) names.push_back(stage->trace().things[std::size_t(sample.chosen)]);
    return names;
  }
  double strongest() const {
    double strongest = 0.0;
    for (const Sample& sample : stage->trace().samples)
      if (sample.time > 0.05) strongest = std::max(strongest, sample.force.norm());
    return strongest;
  }

  TemplateFolder folder{"menu"};
  Study study = folder.study();
  std::unique_ptr<session::Session> session = session::start();
  TrialPlan plan;
  std::vector<std::string> shown;  // by what is on the display
  std::unique_ptr<TrialStage> stage;
};

TEST(TrialStage, AMenuOfTheSceneIsClickedWithTheMousesHand) {
  Menu menu(0, 0);
  ASSERT_EQ(wait_for(*menu.stage, State::Running), State::Running) << menu.stage->why();
  ASSERT_NE(menu.session->menu().use(), nullptr);
  EXPECT_LT(menu.session->menu().use()->opacity(), 0.6);
  menu.go(menu.before(menu.other(), 0.008));
  menu.click();
  ASSERT_EQ(menu.stage->state(), State::Running);
  EXPECT_GT(menu.session->menu().use()->opacity(), 0.6);
  menu.go(menu.before(menu.target(), 0.008));
  EXPECT_EQ(menu.session->menu().use()->lit()->name, menu.target());
  menu.click();
  ASSERT_EQ(menu.stage->state(), State::Over);
  EXPECT_EQ(menu.session->menu().use(), nullptr);
  EXPECT_EQ(menu.stage->measures().errors, 1);
  EXPECT_TRUE(menu.stage->measures().completed);
  EXPECT_GT(menu.stage->measures().approach_time, 0.0);
  EXPECT_LT(menu.stage->measures().approach_time, menu.stage->measures().time);
  EXPECT_EQ(menu.chosen(), (std::vector<std::string>{"menu/" + menu.other(), "menu/" + menu.target()}));
  menu.stage->update();
  // The trial counts its own samples; the menu may be gone before it tells its last choice.
  ASSERT_FALSE(menu.shown.empty());
  EXPECT_EQ(menu.shown.front(), menu.other());
  if (menu.shown.size() > 1) {
    EXPECT_EQ(menu.shown.back(), menu.target());
  }
}

TEST(TrialStage, AMenuOfTheSceneIsPushedAndFelt) {
  Menu menu(1, 0);
  ASSERT_EQ(wait_for(*menu.stage, State::Running), State::Running) << menu.stage->why();
  menu.go(menu.before(menu.target(), 0.01));
  menu.click();
  ASSERT_EQ(menu.stage->state(), State::Running);  // the button does not choose here
  const Vector3 deep = menu.before(menu.target(), -0.018);
  menu.go(deep, [] { return false; });
  EXPECT_EQ(menu.stage->state(), State::Over);
  EXPECT_EQ(menu.stage->measures().errors, 0);
  EXPECT_GT(menu.strongest(), 0.5);
  EXPECT_EQ(menu.stage->trace().things[std::size_t(menu.stage->trace().samples.back().touched)],
            "menu/" + menu.target());
}

TEST(TrialStage, AMenuWithoutForcesIsPushedAndNotFelt) {
  Menu menu(1, 1);
  ASSERT_EQ(wait_for(*menu.stage, State::Running), State::Running) << menu.stage->why();
  menu.go(menu.before(menu.target(), 0.01));
  EXPECT_EQ(menu.session->menu().use()->lit()->name, menu.target());
  const Vector3 deep = menu.before(menu.target(), -0.008);
  menu.go(deep, [] { return false; });
  EXPECT_EQ(menu.stage->state(), State::Over);
  EXPECT_EQ(menu.strongest(), 0.0);
  EXPECT_EQ(menu.chosen(), std::vector<std::string>{"menu/" + menu.target()});
}

TEST(TrialStage, AnElementThatIsGoneFailsWithItsName) {
  Menu menu(0, 0);
  menu.study.trials.scenes[0].element->file = "scenes/gone.toml";
  menu.stage->begin(menu.plan);
  ASSERT_EQ(wait_for(*menu.stage, State::Running), State::Failed);
  EXPECT_NE(menu.stage->why().find("gone.toml"), std::string::npos);
}

TEST(TrialStage, ASceneThatIsNotThereFailsWithItsName) {
  Blank blank;
  blank.study.trials.scenes[0].file = "scenes/gone.wrl";
  blank.stage->begin(measured_trial(blank.study, {}, 0, 0));
  ASSERT_EQ(wait_for(*blank.stage, State::Running), State::Failed);
  EXPECT_NE(blank.stage->why().find("gone.wrl"), std::string::npos);
}

TEST(TrialStage, ALostDeviceFailsTheTrialAndItCanBeDoneAgain) {
  TemplateFolder folder("blank");
  Study study = folder.study();
  study.trials.hold = 0.02;
  auto device = session::hand_at(Vector3::Zero());
  devices::SimulatedDevice& hand = *device;
  session::SessionSettings settings = session::quiet_settings();
  settings.pointers.push_back(std::move(device));
  const auto session = session::start(std::move(settings));
  TrialStage stage(*session, study, folder.path(), {});
  const auto seeks = [&] {
    const session::PointerView& view = session->hands().pointer(0);
    base::Pose stage_from_stylus = base::Pose::Identity();
    stage_from_stylus.linear() = view.orientation.toRotationMatrix();
    stage_from_stylus.translation() = view.tip;
    const base::Pose device_from_stage = view.device_from_stylus * stage_from_stylus.inverse();
    hand.set_target(device_from_stage * study.task->start);
  };
  stage.begin(measured_trial(study, {}, 0, 0));
  ASSERT_EQ(wait_for(stage, State::Seeking), State::Seeking) << stage.why();
  EXPECT_EQ(stage.start(), study.task->start);
  ASSERT_EQ(wait_for(stage, State::Running, seeks), State::Running) << stage.why();
  hand.inject(devices::SimulatedFailure::Unplugged);
  ASSERT_EQ(wait_for(stage, State::Over), State::Failed);
  EXPECT_NE(stage.why().find("does not answer"), std::string::npos);
  hand.inject(devices::SimulatedFailure::None);
  stage.begin(measured_trial(study, {}, 0, 0));
  EXPECT_EQ(wait_for(stage, State::Running, seeks), State::Running) << stage.why();
}

}  // namespace
}  // namespace icome::study
