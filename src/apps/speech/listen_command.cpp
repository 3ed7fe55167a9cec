#include "apps/speech/listen_command.h"

#include <fmt/format.h>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/speech/answer_text.h"
#include "apps/speech/talk.h"
#include "apps/stopwatch.h"
#include "files/design_files.h"
#include "speech/hearing/likely_meant.h"
#include "speech/hearing/recording.h"
#include "speech/hearing/voice_activity.h"

namespace icome::apps {
namespace {

using base::Result;
using interaction::Value;

/// Understands the utterances of recordings, one after the other.
class Listener {
 public:
  Listener(const ListenOptions& options, Talk& talk, speech::Recogniser& recogniser)
      : options_(options), talk_(talk), recogniser_(recogniser) {
    if (options.least_score) limits_.least_score = *options.least_score;
  }

  Result<void> hear_recording(const std::filesystem::path& file) {
    const auto sound = speech::read_recording(file);
    if (!sound) return tl::unexpected(sound.error());
    const auto utterances = speech::utterances_of(*sound, {.hang = options_.hang});
    for (const speech::Utterance& utterance : utterances) {
      if (interrupted()) return base::fail("interrupted");
      if (const auto heard = hear_utterance(utterance, file); !heard) return heard;
    }
    if (utterances.empty() && !options_.talk.json) print(fmt::format("{}: nobody speaks\n", file.string()));
    time_ += double(sound->size()) / speech::kSampleRate;
    return {};
  }

 private:
  Result<void> hear_utterance(const speech::Utterance& utterance, const std::filesystem::path& file) {
    const Stopwatch watch;
    if (const auto ready = follow_grammar(); !ready) return ready;
    const auto heard = recogniser_.recognise(utterance.samples);
    if (!heard) return tl::unexpected(heard.error());
    // Without --apply each is understood by itself.
    std::unique_ptr<Talk> own = options_.apply ? nullptr : talk_.beginning();
    Talk& talk = own ? *own : talk_;
    talk.dialogue().vocabulary();
    const speech::Heard* const meant = speech::likely_meant(*heard, talk.dialogue(), limits_);
    speech::Answer answer{.reply = "That was no sentence that I know."};
    if (meant != nullptr) answer = talk.dialogue().hear(meant->sentence(), times_of(*meant, utterance));
    const speech::Heard nearest = meant != nullptr ? *meant
                                  : heard->empty() ? speech::Heard{}
                                                   : heard->front();
    if (meant == nullptr) answer.heard = nearest.sentence();
    return tell_answer(answer, nearest.score, utterance, file, talk.world(), 1000.0 * watch.seconds());
  }

  speech::WordTimes times_of(const speech::Heard& heard, const speech::Utterance& utterance) const {
    speech::WordTimes times{.now = time_ + utterance.speech_end};
    for (const speech::HeardWord& word : heard.words)
      times.words.push_back(time_ + utterance.begin + word.begin);
    return times;
  }

  /// The recogniser knows what can be said now.
  Result<void> follow_grammar() {
    const speech::Grammar& grammar = talk_.dialogue().vocabulary().grammar;
    std::string jsgf = grammar.jsgf(speech::Dialogue::kSentence, "icome");
    if (jsgf == known_) return {};
    const auto silent =
        recogniser_.set_grammar(grammar, {speech::Dialogue::kSentence, speech::Dialogue::kUsualSentence});
    if (!silent) return tl::unexpected(silent.error());
    if (!silent->empty() && *silent != silent_)
      tell(fmt::format("nobody can be heard to say: {}", fmt::join(*silent, ", ")));
    silent_ = *silent;
    known_ = std::move(jsgf);
    return {};
  }

  Result<void> tell_answer(const speech::Answer& answer, double score, const speech::Utterance& utterance,
                           const std::filesystem::path& file, const world::World& world, double ms) const {
    std::string text;
    if (options_.talk.json) {
      Value::Fields fields{
          {"file", file.string()}, {"begin_s", utterance.begin}, {"end_s", utterance.speech_end}};
      for (auto& [name, value] : answer_value(answer, world)) {
        fields.emplace_back(name == "reply" ? "said" : name, std::move(value));
        if (name == "heard") fields.emplace_back("score", score);
      }
      fields.emplace_back("ms", ms);
      text = interaction::json_from_value(fields) + "\n";
    } else {
      text = fmt::format("{}, {:.2f} s: {}", file.string(), utterance.begin, answer_text(answer, world));
    }
    if (print_answer(text) != 0) return base::fail("the answers cannot be written");
    return {};
  }

  const ListenOptions& options_;
  Talk& talk_;
  speech::Recogniser& recogniser_;
  speech::HearingLimits limits_;
  std::string known_;  // the grammar that the recogniser has
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
  Result<HandPath> hand = HandPath{};
  if (!options.pointer.empty()) hand = hand_from_file(options.pointer);
  if (!hand) return tl::unexpected(hand.error());
  const auto talk = Talk::open(options.talk, status);
  if (!talk) return tl::unexpected(talk.error());
  (*talk)->stage().hand = *hand;
  const auto save = [&] { return (*talk)->save(out, options.force); };
  if (!out.empty()) (*talk)->stage().saving = save;
  status.say("Loading the recogniser");
  const auto recogniser = speech::make_sphinx_recogniser();
  if (!recogniser) return tl::unexpected(recogniser.error());
  status.clear();
  Listener listener(options, **talk, **recogniser);
  for (const std::filesystem::path& file : options.recordings)
    if (const auto heard = listener.hear_recording(file); !heard) return heard;
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
