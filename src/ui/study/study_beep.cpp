#include "ui/study/study_beep.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <numbers>
#include <thread>

namespace icome::ui {
namespace {

constexpr unsigned kSampleRate = 48000;    // Hz
constexpr unsigned kSoundBuffer = 200000;  // us: the whole tone fits in, so it cannot run dry

/// Keeps ALSA from writing its own account of every failure to standard error.
void hush(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/, const char* /*format*/,
          ...) {}

base::Result<snd_pcm_t*> open_sound() {
  snd_lib_error_set_handler(hush);
  snd_pcm_t* sound = nullptr;
  // Not blocking: does not wait for an output that another program has for itself.
  int error = snd_pcm_open(&sound, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (error == 0) {
    snd_pcm_nonblock(sound, 0);
    error = snd_pcm_set_params(sound, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, kSampleRate, 1,
                               kSoundBuffer);
    if (error == 0) return sound;
    snd_pcm_close(sound);
  }
  return base::fail(fmt::format(
      "The sound output cannot be used ({}), so the start of a trial is seen but not heard. Check "
      "with `speaker-test -t sine -l 1`; on PipeWire, install the package pipewire-alsa.",
      snd_strerror(error)));
}

}  // namespace

std::vector<std::int16_t> start_tone(unsigned rate) {
  constexpr double kPitch = 880.0;  // Hz
  constexpr double kLength = 0.15;  // s
  constexpr double kSwell = 0.005;  // s
  constexpr double kLoudness = 0.5;
  std::vector<std::int16_t> samples(std::size_t(std::lround(kLength * rate)));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double time = double(i) / rate;
    const double strength = std::min({1.0, time / kSwell, (kLength - time) / kSwell});
    const double wave = std::sin(2.0 * std::numbers::pi * kPitch * time);
    samples[i] = std::int16_t(std::lround(32767.0 * kLoudness * strength * wave));
  }
  return samples;
}

struct StudyBeep::Parts {
  explicit Parts(snd_pcm_t* opened) : sound(opened) {}

  snd_pcm_t* sound;
  const std::vector<std::int16_t> tone = start_tone(kSampleRate);
  std::mutex lock;
  std::condition_variable_any asked;
  bool wanted = false;
  std::jthread thread;

  void run(const std::stop_token& end);
  void play_tone();
};

/// Plays the tone. After a failure this one is not heard, but the next may be.
void StudyBeep::Parts::play_tone() {
  snd_pcm_drop(sound);
  if (snd_pcm_prepare(sound) < 0) return;
  if (snd_pcm_writei(sound, tone.data(), tone.size()) < 0) return;
  snd_pcm_drain(sound);  // starts a tone that has not begun by itself
}

void StudyBeep::Parts::run(const std::stop_token& end) {
  while (true) {
    {
      std::unique_lock hold(lock);
      if (!asked.wait(hold, end, [this] { return wanted; })) return;
      wanted = false;
    }
    play_tone();
  }
}

StudyBeep::StudyBeep(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

StudyBeep::~StudyBeep() {
  parts_->thread.request_stop();
  parts_->thread.join();
  snd_pcm_close(parts_->sound);
}

base::Result<std::unique_ptr<StudyBeep>> StudyBeep::create() {
  auto sound = open_sound();
  if (!sound) return base::fail(std::move(sound.error().message));
  auto parts = std::make_unique<Parts>(*sound);
  parts->thread = std::jthread([&its = *parts](const std::stop_token& end) { its.run(end); });
  return std::unique_ptr<StudyBeep>(new StudyBeep(std::move(parts)));
}

void StudyBeep::play() {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->wanted = true;
  }
  parts_->asked.notify_one();
}

}  // namespace icome::ui
