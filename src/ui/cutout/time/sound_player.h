#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"

namespace icome::ui {

/// An output of sound: 16 bits, channels side by side.
class SoundOutput {
 public:
  virtual ~SoundOutput() = default;
  virtual int rate() const = 0;  // moments a second
  virtual int channels() const = 0;
  /// Takes moments, and waits while it has as many as it can hold. False: it is gone.
  virtual bool write(std::span<const std::int16_t> values) = 0;
  /// Time until what was written last is heard, s.
  virtual double delay() = 0;
  /// Forgets what is not heard yet.
  virtual void drop() = 0;
};

/// Opens the system's default output through ALSA, which PipeWire and PulseAudio support, too. Fails, saying
/// what to do, where there is none.
base::Result<std::unique_ptr<SoundOutput>> open_sound_output(int rate, int channels);

/// Plays sound on a thread of its own, which nothing that the window does can make stumble, and tells which
/// moment of it is heard.
class SoundPlayer {
 public:
  /// Makes the sound from a time on (s since play()), so many moments. Called on the player's thread.
  using Fill = std::function<std::vector<float>(double from, std::size_t moments)>;

  explicit SoundPlayer(std::unique_ptr<SoundOutput> output);
  ~SoundPlayer();

  int rate() const;
  int channels() const;
  /// Begins with the time 0 of `fill`, in place of what was played.
  void play(Fill fill);
  void stop();
  /// The time, s since play(), that is heard now; nothing while nothing is played, before the first moment
  /// is on its way, or when the output is gone.
  std::optional<double> heard() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
