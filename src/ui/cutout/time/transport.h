#pragma once
#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>

#include "sound/sound_file.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/time/play_clock.h"
#include "ui/cutout/time/sound_player.h"

namespace icome::ui {

/// Plays and records the animation of a document, which outlives it. With sound the picture follows what is
/// heard; pictures that come late are left out, never sound.
class Transport {
 public:
  enum class State : std::uint8_t { Still, Playing, CountIn, Recording };

  explicit Transport(CutoutDocument& document);

  State state() const { return state_; }
  bool is_still() const { return state_ == State::Still; }
  void play();
  /// Records what cells do: of one layer, or of all where it is none.
  void record(std::optional<animation::LayerId> layer);
  /// Ends playing; what was recorded goes into the animation.
  void stop();

  bool plays_again() const { return again_; }
  void play_again(bool again) { again_ = again; }
  bool has_sound() const { return sound_on_; }
  void set_sound(bool on) { sound_on_ = on; }
  /// Beats before a recording begins.
  void set_count_in(int beats) { count_in_ = beats; }
  int count_in() const { return count_in_; }

  /// The samples of the project's sound; null: there are none.
  void use_samples(std::shared_ptr<const sound::Samples> samples) { samples_ = std::move(samples); }
  /// Opens outputs; by default the system's.
  using OpenOutput = std::function<base::Result<std::unique_ptr<SoundOutput>>(int rate, int channels)>;
  void use_outputs(OpenOutput open) { open_ = std::move(open); }
  /// Time on the steady clock, s; by default the system's.
  void use_clock(std::function<double()> clock) { clock_ = std::move(clock); }

  /// Called when the state or the beats that are left have changed.
  void on_state(std::function<void()> state) { changed_ = std::move(state); }
  /// Beats that are left of a count-in.
  int beats() const { return beats_; }
  /// Frames that were due in the last run, and those of them that were shown.
  int due() const { return due_; }
  int shown() const { return shown_; }
  /// Goes on to what is due now; the timer calls it.
  void tick();

 private:
  void start(State state, int beats, std::optional<animation::LayerId> recorded = std::nullopt);
  void start_sound();
  double seconds() const;
  void set_state(State state);
  SoundPlayer::Fill fill() const;

  CutoutDocument& document_;
  QTimer timer_;
  State state_ = State::Still;
  PlayPlan plan_;
  bool again_ = false, sound_on_ = true;
  int count_in_ = 4;
  int beats_ = 0;
  int due_ = 0, shown_ = 0, last_due_ = 0;
  double started_ = 0.0;  // by the clock: when the first frame is due
  double latest_ = 0.0;   // since then, s
  bool follows_sound_ = false;
  bool told_no_output_ = false;
  std::shared_ptr<const sound::Samples> samples_;
  std::unique_ptr<SoundPlayer> player_;
  OpenOutput open_ = open_sound_output;
  std::function<double()> clock_;
  std::function<void()> changed_ = [] {};
};

/// A click of the count-in at a time since a beat, s: silence after a twentieth of a second. `first`: of the
/// bar, higher than the others.
float click_at(double since_beat, bool first);

}  // namespace icome::ui
