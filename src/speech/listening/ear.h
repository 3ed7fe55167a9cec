#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "speech/hearing/recogniser.h"
#include "speech/hearing/voice_activity.h"
#include "speech/listening/sound_source.h"

namespace icome::speech {

/// The time now on the clock that ears tell times by, s: the steady clock.
double clock_of_ears();

/// An utterance that an ear heard.
struct HeardUtterance {
  double begin = 0.0, end = 0.0;      // s, of its sound and of its last word
  std::vector<Heard> sentences = {};  // as Recogniser::recognise(); their times are from `begin`
  double seconds = 0.0;               // from the end of the utterance to this
};

/// The state of an ear.
struct EarState {
  enum class Doing : std::uint8_t { Starting, Listening, Hearing, Understanding, Muted, Lost };

  Doing doing = Doing::Starting;
  double level = -100.0, noise = -100.0;  // dB below full scale: of the sound now, and of the noise
  std::string problem = {};               // why it hears nothing, a sentence; empty: it does
  std::vector<std::string> silent = {};   // words that cannot be heard, as they have no sounds
};

/// Says which speech an ear takes for spoken to it.
enum class Attention : std::uint8_t {
  Always,     // whatever is said
  WhileHeld,  // what is said while a key is held down
};

/// Listens on one thread of its own and recognises on another, so that whoever owns it never waits, and what
/// is said while it recognises is cut as it comes. A source that is lost is looked for every kPatience.
class Ear {
 public:
  static constexpr double kPatience = 2.0;  // s

  using MakeRecogniser = std::function<base::Result<std::unique_ptr<Recogniser>>()>;

  Ear(OpenSource open, MakeRecogniser make, const VoiceSettings& voice = {});
  ~Ear();
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  /// To what it listens from now on; always at first.
  void attend(Attention attention);
  /// Is the key held down, while which it listens?
  void hold(bool is_held);
  /// Hears nothing from now on (true), as somebody speaks who is not meant; whatever is being said is
  /// dropped.
  void mute(bool muted);
  /// Sentences of these rules are recognised from now on; before the first call the source is not opened.
  void expect(Grammar grammar, std::string sentence, std::string usual);
  /// The utterances since the last call.
  std::vector<HeardUtterance> take();
  EarState state() const;

 private:
  struct Hearing;
  struct Expected {
    Grammar grammar;
    std::string sentence, usual;
  };

  /// The settings that its owner changes while it listens.
  struct Wishes {
    Attention attention = Attention::Always;
    bool is_held = false, is_muted = false;
  };

  /// An utterance that is still to be recognised.
  struct Cut {
    Utterance utterance;
    double clock = 0.0;  // s, of the first sample of its source
    double at = 0.0;     // s, when it had ended
  };

  void listen(const std::stop_token& stop);
  void listen_to(SoundSource& source, const std::stop_token& stop);
  std::optional<std::vector<std::int16_t>> read(SoundSource& source);
  void hear(Hearing& hearing, Sound samples, const Wishes& wishes);
  void lose(const std::string& why);
  Wishes wishes() const;
  void recognise(const std::stop_token& stop);
  std::optional<Expected> take_expected();
  std::optional<Cut> next_cut(const std::stop_token& stop);
  void learn(Recogniser& recogniser, const Expected& wanted);
  void understand(Recogniser& recogniser, const Cut& cut);
  void pause(double seconds, const std::stop_token& stop);
  template <typename Change>
  void change(const Change& change);

  OpenSource open_;
  MakeRecogniser make_;
  VoiceSettings voice_;
  mutable std::mutex mutex_;
  std::condition_variable_any waits_;
  Wishes wishes_;
  std::optional<Expected> expected_;  // what the recogniser does not know yet
  bool knows_ = false;                // has the recogniser a grammar?
  EarState state_;                    // of listening
  std::string no_words_;              // why the recogniser understands nothing; empty: it does
  std::deque<Cut> cut_;
  bool is_understanding_ = false;
  std::vector<HeardUtterance> heard_;
  std::jthread listening_, recognising_;  // the last ones, as they use all others
};

}  // namespace icome::speech
