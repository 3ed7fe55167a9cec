// The only source that plays through ALSA.
#include "sound/sound_output.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>

namespace icome::sound {
namespace {

constexpr unsigned kSoundBuffer = 200000;  // us: short tones fit in as a whole, so they cannot run dry
constexpr int kPiecesASecond = 50;         // between two of them it looks for what is to be played instead

void ignore_error(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
                  const char* /*format*/, ...) {}

base::Result<snd_pcm_t*> open_alsa(int rate) {
  quieten_alsa();
  snd_pcm_t* sound = nullptr;
  // Not blocking: does not wait for an output that another program has for itself.
  int error = snd_pcm_open(&sound, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (error == 0) {
    snd_pcm_nonblock(sound, 0);
    error = snd_pcm_set_params(sound, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, unsigned(rate), 1,
                               kSoundBuffer);
    if (error == 0) return sound;
    snd_pcm_close(sound);
  }
  return base::fail(
      fmt::format("The sound output cannot be used ({}). Check with `speaker-test -t sine -l 1`; on "
                  "PipeWire, install the "
                  "package pipewire-alsa.",
                  snd_strerror(error)));
}

}  // namespace

void quieten_alsa() { snd_lib_error_set_handler(&ignore_error); }

struct SoundOutput::Parts {
  Parts(snd_pcm_t* opened, int samples_a_second) : sound(opened), rate(samples_a_second) {}

  snd_pcm_t* sound;
  int rate;
  mutable std::mutex lock;
  std::condition_variable_any asked;
  std::optional<std::vector<std::int16_t>> wanted;  // to be played next; empty samples: silence
  bool plays = false;
  std::jthread thread;

  void run(const std::stop_token& end);
  void play(std::span<const std::int16_t> samples, const std::stop_token& end);
  bool write(std::span<const std::int16_t> samples) const;
  bool is_asked() const;
};

bool SoundOutput::Parts::is_asked() const {
  const std::lock_guard hold(lock);
  return wanted.has_value();
}

/// False where the output is lost: the next sound may be heard again.
bool SoundOutput::Parts::write(std::span<const std::int16_t> samples) const {
  while (!samples.empty()) {
    auto written = snd_pcm_writei(sound, samples.data(), samples.size());
    if (written < 0) written = snd_pcm_recover(sound, int(written), 1);
    if (written < 0) return false;
    samples = samples.subspan(std::size_t(written));
  }
  return true;
}

void SoundOutput::Parts::play(std::span<const std::int16_t> samples, const std::stop_token& end) {
  snd_pcm_drop(sound);
  if (samples.empty() || snd_pcm_prepare(sound) < 0) return;
  while (!samples.empty()) {
    if (is_asked() || end.stop_requested()) {
      snd_pcm_drop(sound);
      return;
    }
    const std::size_t count = std::min(samples.size(), std::size_t(rate / kPiecesASecond));
    if (!write(samples.first(count))) return;
    samples = samples.subspan(count);
  }
  snd_pcm_drain(sound);  // begins a short one, too, which has not filled the buffer
}

void SoundOutput::Parts::run(const std::stop_token& end) {
  while (true) {
    std::vector<std::int16_t> samples;
    {
      std::unique_lock hold(lock);
      plays = wanted.has_value();
      if (!asked.wait(hold, end, [this] { return wanted.has_value(); })) return;
      samples = std::exchange(wanted, std::nullopt).value();
      plays = true;
    }
    play(samples, end);
  }
}

SoundOutput::SoundOutput(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

SoundOutput::~SoundOutput() {
  parts_->thread.request_stop();
  parts_->thread.join();
  snd_pcm_close(parts_->sound);
}

base::Result<std::unique_ptr<SoundOutput>> SoundOutput::open(int rate) {
  auto sound = open_alsa(rate);
  if (!sound) return tl::unexpected(sound.error());
  auto parts = std::make_unique<Parts>(*sound, rate);
  parts->thread = std::jthread([&its = *parts](const std::stop_token& end) { its.run(end); });
  return std::unique_ptr<SoundOutput>(new SoundOutput(std::move(parts)));
}

void SoundOutput::play(std::vector<std::int16_t> samples) {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->wanted = std::move(samples);
  }
  parts_->asked.notify_one();
}

void SoundOutput::stop() {
  if (is_playing()) play({});
}

bool SoundOutput::is_playing() const {
  const std::lock_guard hold(parts_->lock);
  return parts_->plays || parts_->wanted.has_value();
}

}  // namespace icome::sound
