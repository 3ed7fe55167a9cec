#include "apps/speech/listen_command.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/speech/answer_text.h"
#include "apps/speech/talk.h"
#include "apps/stopwatch.h"
#include "files/design_files.h"
#include "speech/hearing/likely_meant.h"
#include "speech/hearing/recording.h"
#include "speech/hearing/voice_activity.h"
#include "speech/hearing/wake_word.h"
#include "speech/listening/ear.h"
#include "speech/speaking/speaker.h"

namespace icome::apps {
namespace {

using base::Result;
using interaction::Value;

/// The place of an utterance in all that is heard, s from its beginning.
struct HeardAt {
  std::string file;  // or kMicrophoneName
  double begin = 0.0, end = 0.0;
  double file_begin = 0.0;  // of the file, whose times are told
};
constexpr const char* kMicrophoneName = "microphone";

/// Understands utterances, one after the other.
class Listener {
 public:
  Listener(const ListenOptions& options, std::optional<speech::WakeWord> wake_word, Talk& talk)
      : options_(options), talk_(talk), wake_word_(std::move(wake_word)) {
    if (options.speak) speaker_.emplace();
    if (options.least_score) limits_.least_score = *options.least_score;
  }

  Result<void> hear_recording(const std::filesystem::path& file, speech::Recogniser& recogniser) {
    const auto sound = speech::read_recording(file);
    if (!sound) return tl::unexpected(sound.error());
    if (sound->empty()) return base::fail(fmt::format("{}: there is no sound in it", file.string()));
    const auto utterances = speech::utterances_of(*sound, {.hang = options_.hang});
    for (const speech::Utterance& utterance : utterances) {
      if (interrupted()) return base::fail("interrupted");
      const Stopwatch watch;
      if (const auto grammar = new_grammar()) {
        const auto silent = recogniser.set_grammar(*grammar, rules());
        if (!silent) return tl::unexpected(silent.error());
        tell_silent(*silent);
      }
      const auto heard = recogniser.recognise(utterance.samples);
      if (!heard) return tl::unexpected(heard.error());
      const HeardAt place{file.string(), time_ + utterance.begin, time_ + utterance.speech_end, time_};
      if (const auto told = understand(*heard, place, watch); !told) return told;
    }
    if (utterances.empty() && !options_.talk.json) print(fmt::format("{}: nobody speaks\n", file.string()));
    time_ += double(sound->size()) / speech::kSampleRate;
    return {};
  }

  /// Listens until Ctrl-C. Fails where there is no microphone; one that is lost later is told, and looked
  /// for.
  Result<void> hear_microphone(std::unique_ptr<speech::Recogniser> recogniser) {
    if (const auto there = speech::open_microphone(options_.microphone); !there)
      return base::fail(there.error().message + "; give it recordings instead");
    const double begin = speech::clock_of_ears();
    speech::Ear ear([this] { return speech::open_microphone(options_.microphone); },
                    [&]() -> Result<std::unique_ptr<speech::Recogniser>> { return std::move(recogniser); },
                    {.hang = options_.hang});
    std::string problem;
    bool listens = false;
    while (!interrupted()) {
      if (auto grammar = new_grammar())
        ear.expect(std::move(*grammar), std::string(rules().sentence), std::string(rules().usual));
      follow_speaker(ear, speech::clock_of_ears() - begin);
      for (const speech::HeardUtterance& it : ear.take()) {
        const Stopwatch watch;
        const HeardAt place{kMicrophoneName, it.begin - begin, it.end - begin, 0.0};
        if (const auto told = understand(it.sentences, place, watch, it.seconds); !told) return told;
      }
      const speech::EarState state = ear.state();
      tell_silent(state.silent);
      if (state.problem != problem && !state.problem.empty()) tell(state.problem);
      problem = state.problem;
      const bool is_listening = state.doing >= speech::EarState::Doing::Listening && problem.empty();
      if (is_listening && !listens) tell("listening; Ctrl-C ends it");
      listens = is_listening;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
  }

 private:
  /// `before`: s that recognising took before the watch began.
  Result<void> understand(const std::vector<speech::Heard>& heard, const HeardAt& place,
                          const Stopwatch& watch, double before = 0.0) {
    // Without --apply each is understood by itself.
    std::unique_ptr<Talk> own = options_.apply ? nullptr : talk_.beginning();
    Talk& talk = own ? *own : talk_;
    const auto [answer, nearest, is_addressed] = speech::understand_utterance(
        talk.dialogue(), heard, place.begin, place.end, limits_, wake_word_ ? &*wake_word_ : nullptr);
    if (speaker_ && is_addressed) speaker_->say(answer.reply);
    const Value score = nearest ? Value(nearest->score) : Value();
    return tell_answer(answer, score, place, talk.world(), 1000.0 * (before + watch.seconds()));
  }

  speech::HeardRules rules() const {
    if (wake_word_) return speech::WakeWord::kRules;
    return {speech::Dialogue::kSentence, speech::Dialogue::kUsualSentence};
  }

  /// The grammar of this moment, where it has changed; none: it has not.
  std::optional<speech::Grammar> new_grammar() {
    speech::Grammar grammar = talk_.dialogue().vocabulary().grammar;
    if (wake_word_)
      grammar =
          wake_word_->with_word(grammar, {speech::Dialogue::kSentence, speech::Dialogue::kUsualSentence});
    std::string jsgf = grammar.jsgf(rules().sentence, "icome");
    if (jsgf == known_) return std::nullopt;
    known_ = std::move(jsgf);
    return grammar;
  }

  /// Hears nothing while it speaks; a question of its own is answered without the wake word.
  void follow_speaker(speech::Ear& ear, double time) {
    if (!speaker_) return;
    const bool is_about = speaker_->is_about();
    if (is_about && wake_word_ && talk_.dialogue().asks()) wake_word_->stay_awake(time);
    ear.mute(is_about);
    const std::string problem = speaker_->problem();
    if (std::exchange(unheard_, problem) != problem && !problem.empty()) tell(problem);
  }

  void tell_silent(const std::vector<std::string>& silent) {
    if (silent == silent_) return;
    silent_ = silent;
    if (!silent.empty()) tell(fmt::format("nobody can be heard to say: {}", fmt::join(silent, ", ")));
  }

  Result<void> tell_answer(const speech::Answer& answer, const Value& score, const HeardAt& place,
                           const world::World& world, double ms) const {
    std::string text;
    const double begin = place.begin - place.file_begin, end = place.end - place.file_begin;
    if (options_.talk.json) {
      Value::Fields fields{{"file", place.file}, {"begin_s", begin}, {"end_s", end}};
      for (auto& [name, value] : answer_value(answer, world)) {
        fields.emplace_back(name == "reply" ? "said" : name, std::move(value));
        if (name == "heard") fields.emplace_back("score", score);
      }
      fields.emplace_back("ms", ms);
      text = interaction::json_from_value(fields) + "\n";
    } else {
      text = fmt::format("{}, {:.2f} s: {}", place.file, begin, answer_text(answer, world));
    }
    if (print_answer(text) != 0) return base::fail("the answers cannot be written");
    return {};
  }

  const ListenOptions& options_;
  Talk& talk_;
  speech::HearingLimits limits_;
  std::optional<speech::WakeWord> wake_word_;
  std::optional<speech::Speaker> speaker_;
  std::string unheard_;  // why the speaker is not heard, as it was told
  std::string known_;    // the grammar that the recogniser has
  std::vector<std::string> silent_;
  double time_ = 0.0;  // s, of the beginning of the recording
};

/// Where the design goes; empty: nowhere.
std::filesystem::path destination(const ListenOptions& options) {
  if (!options.apply || !options.out.empty()) return options.out;
  return options.talk.design == kNewDesign ? std::filesystem::path()
                                           : std::filesystem::path(options.talk.design);
}

Result<void> listen(const ListenOptions& options, StatusLine& status) {
  const std::filesystem::path out = destination(options);
  if (!out.empty())
    if (const auto able = files::check_can_write(out); !able) return able;
  std::optional<speech::WakeWord> wake_word;
  if (options.wake_word) {
    auto word = speech::WakeWord::of(*options.wake_word);
    if (!word) return base::fail("--wake-word: " + word.error().message);
    wake_word = std::move(*word);
  }
  Result<HandPath> hand = HandPath{};
  if (!options.pointer.empty()) hand = hand_from_file(options.pointer);
  if (!hand) return tl::unexpected(hand.error());
  const auto talk = Talk::open(options.talk, status);
  if (!talk) return tl::unexpected(talk.error());
  (*talk)->stage().hand = *hand;
  const auto save = [&] { return (*talk)->save(out, options.force); };
  if (!out.empty()) (*talk)->stage().saving = save;
  status.say("Loading the recogniser");
  auto recogniser = speech::make_sphinx_recogniser();
  if (!recogniser) return tl::unexpected(recogniser.error());
  status.clear();
  Listener listener(options, std::move(wake_word), **talk);
  if (options.recordings.empty())
    if (const auto heard = listener.hear_microphone(std::move(*recogniser)); !heard) return heard;
  for (const std::filesystem::path& file : options.recordings)
    if (const auto heard = listener.hear_recording(file, **recogniser); !heard) return heard;
  return out.empty() ? Result<void>() : save();
}

}  // namespace

int run_listen(const ListenOptions& options) {
  catch_interrupts();
  StatusLine status;
  const auto heard = listen(options, status);
  return heard ? 0 : end_without_result(heard.error(), status);
}

}  // namespace icome::apps
