#include "ui/cutout/time/sound_player.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/clock.h"

namespace icome::ui {
namespace {

constexpr unsigned kOutputBuffer = 80'000;  // us that the output holds: it cannot run dry while others work
constexpr double kPiece = 0.01;             // s that are made at once

/// Keeps ALSA from writing its own account of every failure to standard error.
void hush_alsa(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
               const char* /*format*/, ...) {}

class AlsaOutput final : public SoundOutput {
 public:
  AlsaOutput(snd_pcm_t* sound, int rate, int channels) : sound_(sound), rate_(rate), channels_(channels) {}
  AlsaOutput(const AlsaOutput&) = delete;
  AlsaOutput& operator=(const AlsaOutput&) = delete;
  ~AlsaOutput() override {
    snd_pcm_drop(sound_);
    snd_pcm_close(sound_);
  }

  int rate() const override { return rate_; }
  int channels() const override { return channels_; }
  bool write(std::span<const std::int16_t> values) override {
    const auto step = std::size_t(channels_);
    while (!values.empty()) {
      const snd_pcm_sframes_t written = snd_pcm_writei(sound_, values.data(), values.size() / step);
      if (written < 0) {
        // It ran dry, or the system slept: on from here.
        if (snd_pcm_recover(sound_, int(written), 1) < 0) return false;
        continue;
      }
      values = values.subspan(std::size_t(written) * step);
    }
    return true;
  }
  double delay() override {
    snd_pcm_sframes_t moments = 0;
    return snd_pcm_delay(sound_, &moments) < 0 ? 0.0
                                               : double(std::max<snd_pcm_sframes_t>(0, moments)) / rate_;
  }
  void drop() override {
    snd_pcm_drop(sound_);
    snd_pcm_prepare(sound_);
  }

 private:
  snd_pcm_t* sound_;
  int rate_, channels_;
};

std::int16_t sample_of(float value) {
  return std::int16_t(std::lround(32767.0F * std::clamp(value, -1.0F, 1.0F)));
}

}  // namespace

base::Result<std::unique_ptr<SoundOutput>> open_sound_output(int rate, int channels) {
  snd_lib_error_set_handler(hush_alsa);
  snd_pcm_t* sound = nullptr;
  // Not blocking: does not wait for an output that another program has for itself.
  int error = snd_pcm_open(&sound, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (error == 0) {
    snd_pcm_nonblock(sound, 0);
    error = snd_pcm_set_params(sound, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, unsigned(channels),
                               unsigned(rate), 1, kOutputBuffer);
    if (error == 0) return std::make_unique<AlsaOutput>(sound, rate, channels);
    snd_pcm_close(sound);
  }
  return base::fail(fmt::format(
      "The sound output cannot be used ({}), so the animation plays without its sound. Check with "
      "`speaker-test -t sine -l 1`; on PipeWire, install the package pipewire-alsa.",
      snd_strerror(error)));
}

struct SoundPlayer::Parts {
  explicit Parts(std::unique_ptr<SoundOutput> opened) : output(std::move(opened)) {}

  std::unique_ptr<SoundOutput> output;
  mutable std::mutex lock;
  std::condition_variable_any asked;
  Fill wanted;             // none: silence
  std::uint64_t turn = 0;  // counts play() and stop()
  bool is_playing = false;
  // The time that was heard at a time on the steady clock; none before the first piece.
  std::optional<double> heard_then;
  std::int64_t then = 0;  // ns
  double written = 0.0;   // s that the output has been given
  std::jthread thread;

  void run(const std::stop_token& end);
  void play_pieces(const std::stop_token& end, const Fill& fill, std::uint64_t its_turn);
  bool is_turn(std::uint64_t its_turn) const {
    const std::lock_guard hold(lock);
    return turn == its_turn;
  }
};

void SoundPlayer::Parts::play_pieces(const std::stop_token& end, const Fill& fill, std::uint64_t its_turn) {
  const auto step = std::size_t(std::lround(kPiece * output->rate()));
  std::vector<std::int16_t> values;
  std::uint64_t moments = 0;
  while (!end.stop_requested() && is_turn(its_turn)) {
    const std::vector<float> piece = fill(double(moments) / output->rate(), step);
    values.resize(step * std::size_t(output->channels()));
    std::ranges::fill(values, std::int16_t{0});
    std::transform(piece.begin(), piece.begin() + std::ptrdiff_t(std::min(piece.size(), values.size())),
                   values.begin(), sample_of);
    const bool written_down = output->write(values);
    moments += step;
    const double delay = output->delay();
    const std::lock_guard hold(lock);
    if (turn != its_turn) break;
    if (!written_down) {
      is_playing = false;
      return;
    }
    written = double(moments) / output->rate();
    heard_then = written - delay;
    then = base::steady_nanoseconds();
  }
  output->drop();
}

void SoundPlayer::Parts::run(const std::stop_token& end) {
  std::uint64_t done = 0;
  while (true) {
    Fill fill;
    std::uint64_t its_turn = 0;
    {
      std::unique_lock hold(lock);
      if (!asked.wait(hold, end, [&] { return turn != done; })) return;
      its_turn = done = turn;
      fill = wanted;
    }
    if (fill) play_pieces(end, fill, its_turn);
  }
}

SoundPlayer::SoundPlayer(std::unique_ptr<SoundOutput> output)
    : parts_(std::make_unique<Parts>(std::move(output))) {
  parts_->thread = std::jthread([&its = *parts_](const std::stop_token& end) { its.run(end); });
}

SoundPlayer::~SoundPlayer() {
  stop();
  parts_->thread.request_stop();
  parts_->thread.join();
}

int SoundPlayer::rate() const { return parts_->output->rate(); }
int SoundPlayer::channels() const { return parts_->output->channels(); }

void SoundPlayer::play(Fill fill) {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->wanted = std::move(fill);
    parts_->is_playing = true;
    parts_->heard_then.reset();
    parts_->written = 0.0;
    ++parts_->turn;
  }
  parts_->asked.notify_one();
}

void SoundPlayer::stop() {
  {
    const std::lock_guard hold(parts_->lock);
    parts_->wanted = nullptr;
    parts_->is_playing = false;
    ++parts_->turn;
  }
  parts_->asked.notify_one();
}

std::optional<double> SoundPlayer::heard() const {
  const std::lock_guard hold(parts_->lock);
  if (!parts_->is_playing || !parts_->heard_then) return std::nullopt;
  const double since = 1e-9 * double(base::steady_nanoseconds() - parts_->then);
  // Not beyond what the output has: it may stand still.
  return std::min(*parts_->heard_then + since, parts_->written);
}

}  // namespace icome::ui
