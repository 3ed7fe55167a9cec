#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/result.h"

namespace icome::speech {

/// A sentence as a synthetic voice says it: one channel of 16 bits.
struct SpokenSentence {
  int rate = 0;  // samples a second
  std::vector<std::int16_t> samples = {};
};

/// The sentence in the voice of espeak-ng. Fails where its data are missing.
base::Result<SpokenSentence> spoken_sentence(const std::string& sentence);

/// Plays what is spoken. One thread uses it.
class Loudspeaker {
 public:
  virtual ~Loudspeaker() = default;
  /// Plays this at once, in place of what is played now; does not wait.
  virtual void play(SpokenSentence sentence) = 0;
  virtual void stop() = 0;
  virtual bool is_playing() const = 0;
  /// Is it of no more use, so that another one is to be opened?
  virtual bool is_lost() const { return false; }
};
/// Opens a loudspeaker for a rate. Fails where there is none, saying what to do.
using OpenLoudspeaker = std::function<base::Result<std::unique_ptr<Loudspeaker>>(int rate)>;

/// The system's default sound output.
base::Result<std::unique_ptr<Loudspeaker>> open_loudspeaker(int rate);

/// Speaks sentences on a thread of its own, so that whoever owns it never waits. A sentence that comes while
/// another is spoken takes its place.
class Speaker {
 public:
  explicit Speaker(OpenLoudspeaker open = open_loudspeaker);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  void say(std::string sentence);
  /// Says no more of what it was told.
  void stop() { say({}); }
  /// From say() until the last sound was played.
  bool is_speaking() const;
  /// May it be heard by an ear in the room: is it speaking, or has it spoken within kEcho s?
  bool is_about() const;
  static constexpr double kEcho = 0.4;  // s, in which what was spoken may still come back
  /// Why it cannot be heard, a sentence; empty: it can, or has not spoken yet.
  std::string problem() const;

 private:
  void run(const std::stop_token& stop);
  void speak(const std::string& sentence, const std::stop_token& stop);

  OpenLoudspeaker open_;
  std::unique_ptr<Loudspeaker> loudspeaker_;  // null before the first sentence; its thread's
  mutable std::mutex mutex_;
  std::condition_variable_any waits_;
  std::optional<std::string> told_;  // to be said next; empty: nothing
  bool speaks_ = false;
  double spoken_at_ = -std::numeric_limits<double>::infinity();  // s of the steady clock, its last sound
  std::string problem_;
  std::jthread thread_;  // the last one, as it uses all others
};

}  // namespace icome::speech
