// An ear with a microphone and a recogniser that are played, as no sound device is needed.
#include "speech/listening/ear.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <thread>

#include "speech/listening/sample_clock.h"
#include "speech/until.h"

namespace icome::speech {
namespace {

using std::chrono::steady_clock;

/// A tone between pauses, over and over; it is lost when it is told so.
class Whistle final : public SoundSource {
 public:
  explicit Whistle(const std::atomic<bool>& lost) : lost_(lost) {}

  base::Result<std::vector<std::int16_t>> read() override {
    if (lost_) return base::fail("the whistle was lost");
    const std::chrono::duration<double> passed = steady_clock::now() - begun_;
    std::vector<std::int16_t> samples;
    for (; double(count_) < passed.count() * kSampleRate; ++count_) {
      const double time = double(count_) / kSampleRate;
      const bool sounds = std::fmod(time, 1.0) > 0.3 && std::fmod(time, 1.0) < 0.6;
      samples.push_back(
          std::int16_t(sounds ? 4000.0 * std::sin(2.0 * std::numbers::pi * 400.0 * time) : count_ % 7));
    }
    return samples;
  }

 private:
  const std::atomic<bool>& lost_;
  steady_clock::time_point begun_ = steady_clock::now();
  std::size_t count_ = 0;
};

/// Hears "yes" in everything.
class YesHearer final : public Recogniser {
 public:
  base::Result<std::vector<std::string>> set_grammar(const Grammar&, const HeardRules& rules) override {
    if (rules.sentence != "s") return base::fail("there is no such rule");
    return std::vector<std::string>{"xyzzy"};
  }
  base::Result<std::vector<Heard>> recognise(Sound) override {
    return std::vector<Heard>{{.words = {{"yes", 0.1, 0.3}}}};
  }
};

base::Result<std::unique_ptr<Recogniser>> yes_hearer() {
  return std::unique_ptr<Recogniser>(std::make_unique<YesHearer>());
}

TEST(Ear, TellsWhatWasSaidAndWhen) {
  std::atomic<bool> lost = false;
  Ear ear([&]() -> base::Result<std::unique_ptr<SoundSource>> { return std::make_unique<Whistle>(lost); },
          yes_hearer);
  ear.expect({}, "s", "often");
  std::vector<HeardUtterance> all;
  ASSERT_TRUE(until([&] {
    for (HeardUtterance& it : ear.take()) all.push_back(std::move(it));
    return all.size() >= 2;
  }));
  for (const HeardUtterance& it : all) {
    ASSERT_EQ(it.sentences.size(), 1U);
    EXPECT_EQ(it.sentences.front().sentence(), "yes");
    EXPECT_GE(it.seconds, 0.0);
    EXPECT_NEAR(it.end - it.begin, 0.5, 0.1);  // the lead is 0.2 s
  }
  // The whistle comes once a second.
  EXPECT_NEAR(all[1].begin - all[0].begin, 1.0, 0.1);
  const double now = std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
  EXPECT_GT(now, all[1].end);
  EXPECT_LT(now, all[1].end + 20.0);
  EXPECT_EQ(ear.state().silent, std::vector<std::string>{"xyzzy"});
  EXPECT_TRUE(ear.state().problem.empty());
}

TEST(Ear, HearsWhatIsSaidWhileAKeyIsHeld) {
  std::atomic<bool> lost = false;
  Ear ear([&]() -> base::Result<std::unique_ptr<SoundSource>> { return std::make_unique<Whistle>(lost); },
          yes_hearer);
  ear.attend(Attention::WhileHeld);
  ear.expect({}, "s", "often");
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_TRUE(ear.take().empty());
  ear.hold(true);
  EXPECT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Hearing; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(2200));
  EXPECT_TRUE(ear.take().empty());  // it ends with the key, not with a pause
  ear.hold(false);
  std::vector<HeardUtterance> all;
  ASSERT_TRUE(until([&] {
    for (HeardUtterance& it : ear.take()) all.push_back(std::move(it));
    return !all.empty();
  }));
  EXPECT_GT(all[0].end - all[0].begin, 1.0);  // two tones or three
  EXPECT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Listening; }));
}

TEST(Ear, HearsNothingWhileItIsMuted) {
  std::atomic<bool> lost = false;
  Ear ear([&]() -> base::Result<std::unique_ptr<SoundSource>> { return std::make_unique<Whistle>(lost); },
          yes_hearer);
  ear.mute(true);
  ear.expect({}, "s", "often");
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Muted; }));
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_TRUE(ear.take().empty());
  ear.mute(false);
  const double heard_again = clock_of_ears();
  std::vector<HeardUtterance> all;
  ASSERT_TRUE(until([&] {
    for (HeardUtterance& it : ear.take()) all.push_back(std::move(it));
    return !all.empty();
  }));
  EXPECT_GT(all[0].end, heard_again - 0.1);
}

/// Understands nothing until it is let.
class SlowHearer final : public Recogniser {
 public:
  explicit SlowHearer(const std::atomic<bool>& may) : may_(may) {}
  base::Result<std::vector<std::string>> set_grammar(const Grammar&, const HeardRules&) override {
    return std::vector<std::string>{};
  }
  base::Result<std::vector<Heard>> recognise(Sound) override {
    (void)until([&] { return may_.load(); });
    return std::vector<Heard>{{.words = {{"yes", 0.1, 0.3}}}};
  }

 private:
  const std::atomic<bool>& may_;
};

TEST(Ear, HearsWhatIsSaidWhileItUnderstandsWhatWasSaidBefore) {
  std::atomic<bool> lost = false, may = false;
  Ear ear([&]() -> base::Result<std::unique_ptr<SoundSource>> { return std::make_unique<Whistle>(lost); },
          [&]() -> base::Result<std::unique_ptr<Recogniser>> { return std::make_unique<SlowHearer>(may); });
  ear.attend(Attention::WhileHeld);
  ear.expect({}, "s", "often");
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Listening; }));
  const auto press = [&] {
    ear.hold(true);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    ear.hold(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
  };
  press();
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Understanding; }));
  press();
  EXPECT_TRUE(ear.take().empty());
  may = true;
  std::vector<HeardUtterance> all;
  ASSERT_TRUE(until([&] {
    for (HeardUtterance& it : ear.take()) all.push_back(std::move(it));
    return all.size() >= 2;
  }));
  EXPECT_GT(all[0].seconds, 1.4);  // as long as it waited
  EXPECT_GT(all[1].begin, all[0].end);
}

TEST(SampleClock, GoesByTheSamplesThatComeSoonest) {
  constexpr double kBegan = 1000.0, kLump = 0.02, kLate = 0.1;  // s
  SampleClock clock;
  std::size_t samples = 0;
  // Lumps are heard from then on, and each comes late but for some.
  const auto come = [&](double from, int lumps) {
    for (int i = 1; i <= lumps; ++i) {
      samples += std::size_t(kLump * kSampleRate);
      clock.came(samples, from + i * kLump + (i % 25 == 0 ? 0.0 : kLate));
    }
  };
  come(kBegan, 250);
  EXPECT_NEAR(clock.first(), kBegan, 1e-6);
  // Three seconds long nothing comes, and what was said in them is lost.
  come(kBegan + 8.0, int(2.2 * SampleClock::kSpan / kLump));
  EXPECT_NEAR(clock.first(), kBegan + 3.0, 1e-6);
}

TEST(Ear, LooksForAMicrophoneThatWasLost) {
  std::atomic<bool> lost = false;
  Ear ear(
      [&]() -> base::Result<std::unique_ptr<SoundSource>> {
        if (lost) return base::fail("there is no whistle");
        return std::make_unique<Whistle>(lost);
      },
      yes_hearer);
  ear.expect({}, "s", "often");
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Listening; }));
  lost = true;
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Lost; }));
  EXPECT_NE(ear.state().problem.find("whistle"), std::string::npos);
  lost = false;
  ASSERT_TRUE(until([&] { return ear.state().doing == EarState::Doing::Listening; }));
  EXPECT_TRUE(ear.state().problem.empty());
}

TEST(Ear, TellsWhyItHearsNothing) {
  Ear deaf([]() -> base::Result<std::unique_ptr<SoundSource>> { return base::fail("no sound here"); },
           []() -> base::Result<std::unique_ptr<Recogniser>> { return base::fail("no model of English"); });
  EXPECT_TRUE(until([&] { return deaf.state().problem == "no model of English"; }));
  std::atomic<bool> lost = false;
  Ear ear([&]() -> base::Result<std::unique_ptr<SoundSource>> { return std::make_unique<Whistle>(lost); },
          yes_hearer);
  ear.expect({}, "another rule", "often");
  EXPECT_TRUE(until([&] { return ear.state().problem == "there is no such rule"; }));
  EXPECT_TRUE(ear.take().empty());
}

TEST(Microphone, ThatIsNotThereIsTold) {
  EXPECT_FALSE(open_recording("/no/such/recording.wav"));
  const std::string empty = testing::TempDir() + "icome_no_sound.raw";
  std::ofstream(empty).flush();
  EXPECT_FALSE(open_recording(empty));
#ifdef ICOME_ADDRESS_SANITIZER
  GTEST_SKIP() << "libraries of sound systems keep memory when they are unloaded, which looks like ours";
#endif
  const auto microphone = open_microphone("a microphone that nobody has");
  ASSERT_FALSE(microphone);
  EXPECT_NE(microphone.error().message.find("microphone"), std::string::npos) << microphone.error().message;
}

}  // namespace
}  // namespace icome::speech
