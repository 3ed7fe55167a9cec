#include "speech/listening/ear.h"

#include <chrono>
#include <utility>

#include "speech/hearing/held_speech.h"
#include "speech/listening/sample_clock.h"

namespace icome::speech {
namespace {

constexpr double kStep = 0.02;           // s, between two looks at the source
constexpr std::size_t kMostWaiting = 4;  // utterances; where it is too slow, nobody waits for older ones

}  // namespace

double clock_of_ears() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Ear::Ear(OpenSource open, MakeRecogniser make, const VoiceSettings& voice)
    : open_(std::move(open)),
      make_(std::move(make)),
      voice_(voice),
      listening_([this](const std::stop_token& stop) { listen(stop); }),
      recognising_([this](const std::stop_token& stop) { recognise(stop); }) {}

Ear::~Ear() {
  listening_.request_stop();
  recognising_.request_stop();
}

template <typename Change>
void Ear::change(const Change& change) {
  const std::lock_guard lock(mutex_);
  change(state_);
}

void Ear::attend(Attention attention) {
  const std::lock_guard lock(mutex_);
  wishes_.attention = attention;
}

void Ear::hold(bool is_held) {
  const std::lock_guard lock(mutex_);
  wishes_.is_held = is_held;
}

void Ear::mute(bool muted) {
  const std::lock_guard lock(mutex_);
  wishes_.is_muted = muted;
}

Ear::Wishes Ear::wishes() const {
  const std::lock_guard lock(mutex_);
  return wishes_;
}

void Ear::expect(Grammar grammar, std::string sentence, std::string usual) {
  const std::lock_guard lock(mutex_);
  expected_ = Expected{std::move(grammar), std::move(sentence), std::move(usual)};
  waits_.notify_all();
}

std::vector<HeardUtterance> Ear::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(heard_, {});
}

EarState Ear::state() const {
  const std::lock_guard lock(mutex_);
  EarState state = state_;
  if (state.problem.empty()) state.problem = no_words_;
  const bool understands = is_understanding_ || !cut_.empty();
  if (understands && state.doing == EarState::Doing::Listening) state.doing = EarState::Doing::Understanding;
  return state;
}

void Ear::pause(double seconds, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  waits_.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
}

void Ear::lose(const std::string& why) {
  change([&](EarState& state) {
    state.doing = EarState::Doing::Lost;
    state.problem = why;
  });
}

/// The listening thread, which begins once there is something to be understood.
void Ear::listen(const std::stop_token& stop) {
  {
    std::unique_lock lock(mutex_);
    waits_.wait(lock, stop, [&] { return knows_; });
  }
  while (!stop.stop_requested()) {
    if (auto source = open_()) {
      change([](EarState& state) { state.problem.clear(); });
      listen_to(**source, stop);
    } else {
      lose(source.error().message);
    }
    if (!stop.stop_requested()) pause(kPatience, stop);
  }
}

/// All that was heard of a source since it was opened, or since the ear was muted.
struct Ear::Hearing {
  explicit Hearing(const VoiceSettings& voice) : activity(voice), held(voice) {}

  VoiceActivity activity;
  HeldSpeech held;
  std::size_t samples = 0;
  SampleClock clock;
};

/// Until the source is lost.
void Ear::listen_to(SoundSource& source, const std::stop_token& stop) {
  VoiceSettings voice = voice_;
  std::optional<Hearing> hearing;  // none: muted
  for (; !stop.stop_requested(); pause(kStep, stop)) {
    const auto came = read(source);
    if (!came) return;
    const Wishes wished = wishes();
    if (wished.is_muted) {
      if (hearing) voice.first_noise = hearing->activity.noise_level();
      hearing.reset();
      change([](EarState& state) { state.doing = EarState::Doing::Muted; });
      continue;
    }
    if (!hearing) hearing.emplace(voice);
    hear(*hearing, *came, wished);
  }
}

/// The samples that came; none where the source is lost.
std::optional<std::vector<std::int16_t>> Ear::read(SoundSource& source) {
  auto came = source.read();
  if (came) return std::move(*came);
  lose(came.error().message);
  return std::nullopt;
}

/// Leaves the utterances that end with these samples to the recogniser.
void Ear::hear(Hearing& hearing, Sound samples, const Wishes& wishes) {
  hearing.samples += samples.size();
  hearing.clock.came(hearing.samples, clock_of_ears());
  std::vector<Utterance> utterances = hearing.activity.hear(samples);
  bool is_hearing = hearing.activity.is_speaking();
  if (auto held = hearing.held.hear(samples, wishes.is_held); wishes.attention == Attention::WhileHeld) {
    utterances.clear();
    if (held) utterances.push_back(std::move(*held));
    is_hearing = hearing.held.is_taking();
  }
  change([&](EarState& state) {
    state.doing = is_hearing ? EarState::Doing::Hearing : EarState::Doing::Listening;
    state.level = hearing.activity.level();
    state.noise = hearing.activity.noise_level();
    for (Utterance& it : utterances) cut_.push_back({std::move(it), hearing.clock.first(), clock_of_ears()});
    while (cut_.size() > kMostWaiting) cut_.pop_front();
  });
  if (!utterances.empty()) waits_.notify_all();
}

/// The recognising thread.
void Ear::recognise(const std::stop_token& stop) {
  const auto recogniser = make_();
  if (!recogniser) return lose(recogniser.error().message);
  while (!stop.stop_requested()) {
    if (const auto wanted = take_expected()) learn(**recogniser, *wanted);
    if (const auto cut = next_cut(stop)) understand(**recogniser, *cut);
  }
}

std::optional<Ear::Expected> Ear::take_expected() {
  const std::lock_guard lock(mutex_);
  return std::exchange(expected_, std::nullopt);
}

/// Waits for the next utterance; none where other words are expected first, or where it is to stop.
std::optional<Ear::Cut> Ear::next_cut(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  is_understanding_ = false;
  waits_.wait(lock, stop, [&] { return expected_ || !cut_.empty(); });
  if (stop.stop_requested() || expected_ || cut_.empty()) return std::nullopt;
  is_understanding_ = true;
  Cut cut = std::move(cut_.front());
  cut_.pop_front();
  return cut;
}

void Ear::learn(Recogniser& recogniser, const Expected& wanted) {
  auto silent = recogniser.set_grammar(wanted.grammar, {wanted.sentence, wanted.usual});
  change([&](EarState& state) {
    knows_ = knows_ || silent.has_value();
    no_words_ = silent ? "" : silent.error().message;
    if (silent) state.silent = std::move(*silent);
  });
  waits_.notify_all();
}

void Ear::understand(Recogniser& recogniser, const Cut& cut) {
  auto sentences = recogniser.recognise(cut.utterance.samples);
  const std::lock_guard lock(mutex_);
  if (!sentences) {
    no_words_ = sentences.error().message;
    return;
  }
  heard_.push_back({cut.clock + cut.utterance.begin, cut.clock + cut.utterance.speech_end,
                    std::move(*sentences), clock_of_ears() - cut.at});
}

}  // namespace icome::speech
