#include "speech/listening/ear.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "speech/hearing/held_speech.h"

namespace icome::speech {
namespace {

constexpr double kStep = 0.02;     // s, between two looks at the source
constexpr double kPatience = 2.0;  // s, until a lost source is looked for again

}  // namespace

double clock_of_ears() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Ear::Ear(OpenSource open, MakeRecogniser make, const VoiceSettings& voice)
    : open_(std::move(open)),
      make_(std::move(make)),
      voice_(voice),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

Ear::~Ear() {
  thread_.request_stop();
  waits_.notify_all();
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
}

std::vector<HeardUtterance> Ear::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(heard_, {});
}

EarState Ear::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Ear::pause(double seconds, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  waits_.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
}

void Ear::run(const std::stop_token& stop) {
  const auto recogniser = make_();
  if (!recogniser)
    return change([&](EarState& state) {
      state.doing = EarState::Doing::Lost;
      state.problem = recogniser.error().message;
    });
  while (!knows_ && !stop.stop_requested()) {
    follow(**recogniser);
    if (!knows_) pause(kStep, stop);
  }
  while (!stop.stop_requested()) {
    auto source = open_();
    if (source) {
      change([](EarState& state) { state.problem.clear(); });
      listen(**source, **recogniser, stop);
    } else {
      change([&](EarState& state) {
        state.doing = EarState::Doing::Lost;
        state.problem = source.error().message;
      });
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
  /// s, of the first sample: samples come late, not early.
  double clock = std::numeric_limits<double>::infinity();
};

void Ear::listen(SoundSource& source, Recogniser& recogniser, const std::stop_token& stop) {
  VoiceSettings voice = voice_;
  std::optional<Hearing> hearing;  // none: muted
  while (!stop.stop_requested()) {
    follow(recogniser);
    const auto came = read(source);
    if (!came) return;
    const Wishes wished = wishes();
    if (wished.is_muted) {
      if (hearing) voice.first_noise = hearing->activity.noise_level();
      hearing.reset();
      change([](EarState& state) { state.doing = EarState::Doing::Muted; });
      pause(kStep, stop);
      continue;
    }
    if (!hearing) hearing.emplace(voice);
    const std::vector<Utterance> utterances = hear(*hearing, *came, wished);
    for (const Utterance& utterance : utterances) understand(recogniser, utterance, hearing->clock);
    if (utterances.empty()) pause(kStep, stop);
  }
}

/// The samples that came; none where the source is lost.
std::optional<std::vector<std::int16_t>> Ear::read(SoundSource& source) {
  auto came = source.read();
  if (came) return std::move(*came);
  change([&](EarState& state) {
    state.doing = EarState::Doing::Lost;
    state.problem = came.error().message;
  });
  return std::nullopt;
}

/// The utterances that end with these samples.
std::vector<Utterance> Ear::hear(Hearing& hearing, Sound samples, const Wishes& wishes) {
  hearing.samples += samples.size();
  hearing.clock = std::min(hearing.clock, clock_of_ears() - double(hearing.samples) / kSampleRate);
  std::vector<Utterance> utterances = hearing.activity.hear(samples);
  bool is_hearing = hearing.activity.is_speaking();
  if (auto held = hearing.held.hear(samples, wishes.is_held); wishes.attention == Attention::WhileHeld) {
    utterances.clear();
    if (held) utterances.push_back(std::move(*held));
    is_hearing = hearing.held.is_taking();
  }
  change([&](EarState& state) {
    state.doing = !utterances.empty() ? EarState::Doing::Understanding
                  : is_hearing        ? EarState::Doing::Hearing
                                      : EarState::Doing::Listening;
    state.level = hearing.activity.level();
    state.noise = hearing.activity.noise_level();
  });
  return utterances;
}

void Ear::follow(Recogniser& recogniser) {
  std::optional<Expected> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = std::exchange(expected_, std::nullopt);
  }
  if (!wanted) return;
  auto silent = recogniser.set_grammar(wanted->grammar, {wanted->sentence, wanted->usual});
  knows_ = knows_ || silent.has_value();
  change([&](EarState& state) {
    state.problem = silent ? "" : silent.error().message;
    if (silent) state.silent = std::move(*silent);
  });
}

void Ear::understand(Recogniser& recogniser, const Utterance& utterance, double clock) {
  const double begun = clock_of_ears();
  auto sentences = recogniser.recognise(utterance.samples);
  if (!sentences) return change([&](EarState& state) { state.problem = sentences.error().message; });
  const std::lock_guard lock(mutex_);
  heard_.push_back({clock + utterance.begin, clock + utterance.speech_end, std::move(*sentences),
                    clock_of_ears() - begun});
}

}  // namespace icome::speech
