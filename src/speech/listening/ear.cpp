#include "speech/listening/ear.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

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

void Ear::listen(SoundSource& source, Recogniser& recogniser, const std::stop_token& stop) {
  VoiceActivity activity(voice_);
  std::size_t samples = 0;
  double clock =
      std::numeric_limits<double>::infinity();  // s, of the first sample: samples come late, not early
  while (!stop.stop_requested()) {
    follow(recogniser);
    const auto came = source.read();
    if (!came)
      return change([&](EarState& state) {
        state.doing = EarState::Doing::Lost;
        state.problem = came.error().message;
      });
    samples += came->size();
    clock = std::min(clock, clock_of_ears() - double(samples) / kSampleRate);
    auto utterances = activity.hear(*came);
    change([&](EarState& state) {
      state.doing = !utterances.empty()      ? EarState::Doing::Understanding
                    : activity.is_speaking() ? EarState::Doing::Hearing
                                             : EarState::Doing::Listening;
      state.level = activity.level();
      state.noise = activity.noise_level();
    });
    for (Utterance& utterance : utterances) understand(recogniser, std::move(utterance), clock);
    if (utterances.empty()) pause(kStep, stop);
  }
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

void Ear::understand(Recogniser& recogniser, Utterance utterance, double clock) {
  const double begun = clock_of_ears();
  auto sentences = recogniser.recognise(utterance.samples);
  if (!sentences) return change([&](EarState& state) { state.problem = sentences.error().message; });
  const std::lock_guard lock(mutex_);
  heard_.push_back({clock + utterance.begin, clock + utterance.speech_end, std::move(*sentences),
                    clock_of_ears() - begun});
}

}  // namespace icome::speech
