// The only source that plays through ALSA.
#include "sound/sound_output.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>

namespace icome::sound {
namespace {

constexpr unsigned kSoundBuffer = 200000;  // us: short tones fit in as a whole, so they cannot run dry
constexpr auto kLook = std::chrono::milliseconds(10);  // between two looks whether there is room for more
constexpr int kMostLooks = 120;                        // in vain, until the output counts as lost

void ignore_error(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
                  const char* /*format*/, ...) {}

base::Result<snd_pcm_t*> open_alsa(int rate) {
  quieten_alsa();
  snd_pcm_t* sound = nullptr;
  // Not blocking: waits neither for an output that another program has for itself nor for a suspended one.
  int error = snd_pcm_open(&sound, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (error == 0) {
    error = snd_pcm_set_params(sound, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, unsigned(rate), 1,
                               kSoundBuffer);
    if (error == 0) return sound;
    snd_pcm_close(sound);
  }
  return base::fail(fmt::format(
      "The sound output cannot be used ({}). Check with `speaker-test -t sine -l 1`; on PipeWire, "
      "install the package pipewire-alsa.",
      snd_strerror(error)));
}

}  // namespace

void quieten_alsa() { snd_lib_error_set_handler(&ignore_error); }

struct SoundOutput::Parts {
  explicit Parts(snd_pcm_t* opened) : sound(opened) {}

  snd_pcm_t* sound;
  mutable std::mutex lock;
  std::condition_variable_any asked;
  std::optional<std::vector<std::int16_t>> wanted;  // to be played next; empty samples: silence
  bool plays = false, lost = false;
  std::jthread thread;

  void run(const std::stop_token& end);
  bool play(std::span<const std::int16_t> samples, const std::stop_token& end) const;
  bool write(std::span<const std::int16_t> samples, const std::stop_token& end) const;
  bool finish(const std::stop_token& end) const;
  bool is_stopped(const std::stop_token& end) const;
  bool is_asked() const;
};

bool SoundOutput::Parts::is_asked() const {
  const std::lock_guard hold(lock);
  return wanted.has_value();
}

bool SoundOutput::Parts::is_stopped(const std::stop_token& end) const {
  return end.stop_requested() || is_asked();
}

/// Gives the output the samples; false where it takes none for a second, as a suspended one does.
bool SoundOutput::Parts::write(std::span<const std::int16_t> samples, const std::stop_token& end) const {
  for (int looks = 0; !samples.empty() && !is_stopped(end);) {
    auto written = snd_pcm_writei(sound, samples.data(), samples.size());
    if (written < 0 && written != -EAGAIN) written = snd_pcm_recover(sound, int(written), 1);
    if (written > 0) {
      samples = samples.subspan(std::size_t(written));
      looks = 0;
      continue;
    }
    if ((written < 0 && written != -EAGAIN) || ++looks > kMostLooks) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

/// Waits until all is heard; false where the output plays nothing, as a suspended one does.
bool SoundOutput::Parts::finish(const std::stop_token& end) const {
  // A short sound has not filled the buffer, which would have begun it.
  if (snd_pcm_state(sound) == SND_PCM_STATE_PREPARED) snd_pcm_start(sound);
  for (int looks = 0; looks <= kMostLooks && !is_stopped(end); ++looks) {
    snd_pcm_sframes_t left = 0;
    if (snd_pcm_state(sound) != SND_PCM_STATE_RUNNING || snd_pcm_delay(sound, &left) < 0 || left <= 0) {
      snd_pcm_drain(sound);
      return true;
    }
    std::this_thread::sleep_for(kLook);
  }
  return is_stopped(end);
}

/// Plays the samples until they end or others are wanted; false where the output is lost.
bool SoundOutput::Parts::play(std::span<const std::int16_t> samples, const std::stop_token& end) const {
  snd_pcm_drop(sound);
  if (samples.empty()) return true;
  const bool is_heard = snd_pcm_prepare(sound) >= 0 && write(samples, end) && finish(end);
  if (!is_heard || is_stopped(end)) snd_pcm_drop(sound);
  return is_heard;
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
    const bool is_heard = play(samples, end);
    const std::lock_guard hold(lock);
    lost = !is_heard;
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
  auto parts = std::make_unique<Parts>(*sound);
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

bool SoundOutput::is_lost() const {
  const std::lock_guard hold(parts_->lock);
  return parts_->lost;
}

bool SoundOutput::is_playing() const {
  const std::lock_guard hold(parts_->lock);
  return parts_->plays || parts_->wanted.has_value();
}

}  // namespace icome::sound
