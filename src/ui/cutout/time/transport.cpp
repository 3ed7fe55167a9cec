#include "ui/cutout/time/transport.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "animation/sound/sound_track.h"
#include "base/clock.h"

namespace icome::ui {
namespace {

constexpr int kTick = 4;                     // ms
constexpr double kBeat = 0.5;                // s: 120 a minute
constexpr double kRecordedTolerance = 0.25;  // px; keys that make less of a difference are left out
constexpr int kSilentRate = 48'000;          // Hz, of clicks without other sound

}  // namespace

float click_at(double since_beat, bool first) {
  constexpr double kLength = 0.05;  // s
  if (since_beat < 0.0 || since_beat >= kLength) return 0.0F;
  const double pitch = first ? 1600.0 : 1000.0;  // Hz
  const double fade = std::exp(-60.0 * since_beat) * std::min(1.0, since_beat / 0.001);
  return float(0.5 * fade * std::sin(2.0 * std::numbers::pi * pitch * since_beat));
}

Transport::Transport(CutoutDocument& document)
    : document_(document), clock_([] { return 1e-9 * double(base::steady_nanoseconds()); }) {
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.setInterval(kTick);
  QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] { tick(); });
}

void Transport::set_state(State state) {
  state_ = state;
  changed_();
}

void Transport::play() {
  if (!is_still()) stop();
  start(State::Playing, 0);
}

void Transport::record(std::optional<animation::LayerId> layer) {
  if (!is_still()) stop();
  start(count_in_ > 0 ? State::CountIn : State::Recording, count_in_, layer);
}

void Transport::start(State state, int beats, std::optional<animation::LayerId> recorded) {
  const animation::Stage& stage = document_.project().stage;
  const int last = document_.last_frame();
  // From the last frame it goes on with the first.
  const int from = document_.frame() >= last && last > 0 ? 0 : document_.frame();
  const bool records = state != State::Playing;
  plan_ = {.rate = stage.rate,
           .first = 0,
           .last = last,
           .from = from,
           .again = again_ && !records,
           .count_in = beats,
           .beat = kBeat};
  due_ = shown_ = 0;
  last_due_ = -1;
  beats_ = beats;
  started_ = clock_() + count_in_seconds(plan_);
  latest_ = -count_in_seconds(plan_);
  document_.go_to(from);
  if (records) document_.begin_recording(recorded);
  start_sound();
  timer_.start();
  set_state(state);
}

/// The film's sound and the clicks of the count-in, as they come one after the other.
SoundPlayer::Fill Transport::fill() const {
  const auto sound = document_.project().sound;
  return [plan = plan_, samples = sound_on_ && sound ? samples_ : nullptr, sound,
          channels = player_->channels(), rate = player_->rate()](double from, std::size_t moments) {
    std::vector<float> values(moments * std::size_t(channels), 0.0F);
    const double before = count_in_seconds(plan);
    for (std::size_t i = 0; i < moments;) {
      const double time = from + double(i) / rate - before;
      if (time < 0.0) {
        const double beats = (time + before) / plan.beat;
        const float click = click_at((beats - std::floor(beats)) * plan.beat, std::floor(beats) == 0.0);
        for (int k = 0; k < channels; ++k) values[i * std::size_t(channels) + std::size_t(k)] = click;
        ++i;
        continue;
      }
      if (!samples) break;
      // As far as the film goes on without coming back to its beginning.
      const double film = film_time(plan, time);
      std::size_t run = moments - i;
      if (plan.again) {
        const double left = (plan.last + 1) / plan.rate - film;
        run = std::clamp(std::size_t(std::max(1.0, std::ceil(left * rate))), std::size_t(1), run);
      }
      const std::vector<float> piece = animation::sound_of(*samples, *sound, film, run);
      std::copy_n(piece.begin(), std::min(piece.size(), run * std::size_t(channels)),
                  values.begin() + std::ptrdiff_t(i * std::size_t(channels)));
      i += run;
    }
    return values;
  };
}

void Transport::start_sound() {
  follows_sound_ = false;
  const bool has_track = sound_on_ && samples_ && document_.project().sound;
  if (!has_track && (plan_.count_in == 0 || !sound_on_)) return;
  const int rate = has_track ? samples_->rate : kSilentRate;
  const int channels = has_track ? samples_->channels : 1;
  if (!player_ || player_->rate() != rate || player_->channels() != channels) {
    player_.reset();
    auto output = open_(rate, channels);
    if (!output) {
      if (!std::exchange(told_no_output_, true)) document_.remark(output.error().message);
      return;
    }
    player_ = std::make_unique<SoundPlayer>(std::move(*output));
  }
  player_->play(fill());
  follows_sound_ = true;
}

/// Time since the first frame was due, s.
double Transport::seconds() const {
  const double by_clock = clock_() - started_;
  if (!follows_sound_) return by_clock;
  // Until the first of it is heard nothing moves.
  const auto heard = player_->heard();
  return heard ? *heard - count_in_seconds(plan_) : std::min(by_clock, -count_in_seconds(plan_));
}

void Transport::tick() {
  if (is_still()) return;
  // An output that is gone, or is not heard after a second, is no clock.
  if (follows_sound_ && !player_->heard() && clock_() - started_ + count_in_seconds(plan_) > 1.0) {
    follows_sound_ = false;
    document_.remark("The sound output stopped: the animation goes on without its sound.");
  }
  // An output tells its delay a little unevenly.
  latest_ = std::max(latest_, seconds());
  const PlayMoment moment = moment_at(plan_, latest_);
  if (moment.beats != beats_) {
    beats_ = moment.beats;
    if (beats_ == 0 && state_ == State::CountIn) state_ = State::Recording;
    changed_();
  }
  if (moment.beats > 0) return;
  if (moment.ended) return stop();
  if (moment.frame == last_due_) return;
  due_ += last_due_ < 0 ? 1 : std::max(1, moment.frame - last_due_);
  ++shown_;
  last_due_ = moment.frame;
  document_.go_to(moment.frame);
}

void Transport::stop() {
  if (is_still()) return;
  timer_.stop();
  if (player_) player_->stop();
  const bool records = state_ != State::Playing;
  beats_ = 0;
  state_ = State::Still;
  if (records) document_.end_recording(kRecordedTolerance);
  changed_();
}

}  // namespace icome::ui
