// The only source that knows PocketSphinx.
#include <fmt/format.h>
#include <pocketsphinx/pocketsphinx.h>
#include <sphinxbase/err.h>
#include <sphinxbase/ngram_model.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "base/random.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/hearing/language_model.h"
#include "speech/hearing/noise_floor.h"
#include "speech/hearing/recogniser.h"
#include "speech/hearing/word_sounds.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr const char* kModel = "/usr/share/pocketsphinx/model/en-us";
constexpr const char* kSearch = "icome";
constexpr double kFramesPerSecond = 100.0;
/// Scores are sums of logarithms to a base near 1, without their last ten binary places.
constexpr int kScoreUnit = 1 << 10;
constexpr std::size_t kMostPaths = 400;  // through the words that fit, the likeliest first
constexpr std::size_t kMostSentences = 12;

/// Sentences drawn at random, mostly such as people say most, without words that cannot be heard.
std::vector<LanguageModel::Sentence> example_sentences(const Grammar& grammar, const HeardRules& rules,
                                                       const std::set<std::string>& known) {
  // Few words are known well from few sentences, and are learnt in no time.
  constexpr std::size_t kMostDrawn = 40'000, kDrawnForAWord = 200;
  const std::size_t drawn = std::min(kMostDrawn, kDrawnForAWord * known.size());
  constexpr double kUsual = 0.8;  // of them
  const Pattern* const all = grammar.find(rules.sentence);
  const Pattern* const usual = grammar.find(rules.usual);
  base::Random random(1);
  std::vector<LanguageModel::Sentence> sentences;
  if (all == nullptr) return sentences;
  for (std::size_t i = 0; i < drawn; ++i) {
    const bool is_usual = usual != nullptr && random.uniform(0.0, 1.0) < kUsual;
    auto words = sample_sentence(grammar, is_usual ? *usual : *all, random);
    if (words && std::ranges::all_of(*words, [&](const auto& word) { return known.contains(word); }))
      sentences.push_back(std::move(*words));
  }
  return sentences;
}

struct FreeDecoder {
  void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
};
struct FreePaths {
  void operator()(ps_nbest_t* paths) const { ps_nbest_free(paths); }
};
struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};

/// Is it a silence or a noise, which the recogniser puts between words?
bool is_filler(std::string_view word) {
  return word.empty() || word.front() == '<' || word.front() == '[' || word.front() == '+' ||
         word == "(NULL)";
}

/// Sound that begins with the first sound of a word is misheard, so there is a pause at both ends.
constexpr int kPause = kSampleRate / 5;  // samples
std::vector<std::int16_t> between_pauses(Sound utterance) {
  std::vector<std::int16_t> sound(utterance.size() + 2 * std::size_t(kPause), 0);
  std::ranges::copy(utterance, sound.begin() + kPause);
  return sound;
}

/// A file for as long as it is needed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    std::string path = (std::filesystem::temp_directory_path() / "icome-words-XXXXXX").string();
    const int file = mkstemp(path.data());
    if (file < 0) return;
    path_ = path;
    std::ofstream(path_) << text;
    ::close(file);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// "read(2)" is a second way to say "read".
std::string without_variant(std::string_view word) { return std::string(word.substr(0, word.find('('))); }

class SphinxRecogniser final : public Recogniser {
 public:
  SphinxRecogniser(std::unique_ptr<cmd_ln_t, FreeConfig> config,
                   std::unique_ptr<ps_decoder_t, FreeDecoder> decoder)
      : config_(std::move(config)), decoder_(std::move(decoder)) {}

  Result<std::vector<std::string>> set_grammar(const Grammar& grammar, const HeardRules& rules) override {
    const auto vocabulary = grammar.vocabulary(rules.sentence);
    if (const auto taught = teach({vocabulary.begin(), vocabulary.end()}); !taught)
      return tl::unexpected(taught.error());
    std::vector<std::string> silent;
    std::set<std::string> known;
    for (const std::string& word : vocabulary) {
      if (knows(word))
        known.insert(word);
      else
        silent.push_back(word);
    }
    const auto sentences = example_sentences(grammar, rules, known);
    if (sentences.empty()) return fail("the recogniser does not take the grammar: it has no sentence");
    if (!take(LanguageModel(sentences, known))) return fail("the recogniser does not take the words");
    grammar_ = grammar;
    rule_ = rules.sentence;
    return silent;
  }

  Result<std::vector<Heard>> recognise(Sound utterance) override {
    if (rule_.empty() || ps_start_utt(decoder_.get()) != 0)
      return fail("the recogniser did not begin; give it a grammar first");
    // The whole utterance at once: its own mean is what it is normalised by.
    const std::vector<std::int16_t> sound = with_noise_floor(between_pauses(utterance));
    const int frames = ps_process_raw(decoder_.get(), sound.data(), sound.size(), FALSE, TRUE);
    ps_end_utt(decoder_.get());
    if (frames < 0) return fail("the recogniser did not take the sound");
    return likeliest();
  }

 private:
  bool knows(const std::string& word) {
    char* const sounds = ps_lookup_word(decoder_.get(), word.c_str());
    if (sounds != nullptr) ckd_free(sounds);
    return sounds != nullptr;
  }

  /// Makes words known that are not, as the dictionary of the model says them, else by rule; some have no
  /// sounds. The library would read the whole dictionary, which takes it over a second.
  Result<void> teach(std::set<std::string> words) {
    std::erase_if(words, [&](const std::string& word) { return knows(word); });
    if (words.empty()) return {};
    const std::string dictionary = std::string(kModel) + "/cmudict-en-us.dict";
    std::ifstream lines(dictionary);
    std::string line;
    while (std::getline(lines, line)) {
      const std::size_t end = line.find(' ');
      if (end == std::string::npos || !words.contains(without_variant(line.substr(0, end)))) continue;
      const std::string sounds = line.substr(end + 1);
      line.resize(end);
      ps_add_word(decoder_.get(), line.c_str(), sounds.c_str(), FALSE);
    }
    if (lines.bad() || !lines.eof()) return fail(fmt::format("{} cannot be read", dictionary));
    for (const std::string& word : words) {
      if (knows(word)) continue;
      const std::string sounds = sounds_of_word(word);
      if (!sounds.empty()) ps_add_word(decoder_.get(), word.c_str(), sounds.c_str(), FALSE);
    }
    return {};
  }

  bool take(const LanguageModel& words) {
    const TemporaryFile file(words.arpa());
    // It keeps the logarithms by itself, whatever its header says.
    ngram_model_t* const model =
        ngram_model_read(config_.get(), file.path().c_str(), NGRAM_ARPA, ps_get_logmath(decoder_.get()));
    if (model == nullptr) return false;
    const bool taken =
        ps_set_lm(decoder_.get(), kSearch, model) == 0 && ps_set_search(decoder_.get(), kSearch) == 0;
    ngram_model_free(model);
    return taken;
  }

  /// A difference of scores as a natural logarithm.
  double natural(double difference) {
    return difference * logmath_log_to_ln(ps_get_logmath(decoder_.get()), kScoreUnit);
  }

  /// The fit of the sounds of the best words (Heard::score), and the frames of speech.
  std::pair<double, double> fit_of_best() {
    double sum = 0.0, frames = 0.0;
    for (ps_seg_t* segment = ps_seg_iter(decoder_.get()); segment; segment = ps_seg_next(segment)) {
      const char* const word = ps_seg_word(segment);
      if (!word || is_filler(word)) continue;
      int first = 0, last = 0;
      ps_seg_frames(segment, &first, &last);
      int32 acoustic = 0;
      ps_seg_prob(segment, &acoustic, nullptr, nullptr);
      sum += double(acoustic) / kScoreUnit;
      frames += double(last - first + 1);
    }
    return {frames > 0.0 ? natural(sum / frames) : 0.0, frames};
  }

  /// Those of the likeliest ways through the words that are sentences of the grammar.
  std::vector<Heard> likeliest() {
    std::vector<Heard> all;
    const auto [fit, frames] = fit_of_best();
    if (!(frames > 0.0)) return all;  // nobody spoke
    std::unique_ptr<ps_nbest_t, FreePaths> paths(ps_nbest(decoder_.get()));
    std::set<std::string> tried;
    std::optional<double> best;
    for (std::size_t i = 0; paths && i < kMostPaths && all.size() < kMostSentences; ++i) {
      int32 score = 0;
      if (ps_nbest_hyp(paths.get(), &score) != nullptr) {
        if (!best) best = score;
        Heard heard{words_of(ps_nbest_seg(paths.get()))};
        heard.behind = natural(*best - score);
        heard.score = fit - heard.behind / frames;
        if (tried.insert(heard.sentence()).second && is_sentence(heard)) all.push_back(std::move(heard));
      }
      // At the end of the ways it frees them by itself.
      ps_nbest_t* const next = ps_nbest_next(paths.release());
      paths.reset(next);
    }
    // The library leaves the likeliest of all out of them where somebody paused between two words.
    Heard first{words_of(ps_seg_iter(decoder_.get()))};
    first.score = fit;
    if (!tried.contains(first.sentence()) && is_sentence(first)) all.insert(all.begin(), std::move(first));
    return all;
  }

  /// The words from a segment on; frees it.
  static std::vector<HeardWord> words_of(ps_seg_t* segment) {
    std::vector<HeardWord> words;
    for (; segment != nullptr; segment = ps_seg_next(segment)) {
      const char* const word = ps_seg_word(segment);
      if (!word || is_filler(word)) continue;
      int first = 0, last = 0;
      ps_seg_frames(segment, &first, &last);
      const auto time_of = [](int frame) {
        return std::max(0.0, frame / kFramesPerSecond - double(kPause) / kSampleRate);
      };
      words.push_back({without_variant(word), time_of(first), time_of(last + 1)});
    }
    return words;
  }

  bool is_sentence(const Heard& heard) const {
    std::vector<std::string> words;
    for (const HeardWord& word : heard.words) words.push_back(word.word);
    return !words.empty() && !grammar_.parse(rule_, words).empty();
  }

  std::unique_ptr<cmd_ln_t, FreeConfig> config_;
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder_;
  Grammar grammar_;
  std::string rule_;  // empty: there is no grammar yet
};

}  // namespace

std::string Heard::sentence() const {
  std::string text;
  for (const HeardWord& word : words) text += (text.empty() ? "" : " ") + word.word;
  return text;
}

Result<std::unique_ptr<Recogniser>> make_sphinx_recogniser() {
  std::error_code error;
  if (!std::filesystem::exists(std::string(kModel) + "/en-us/means", error))
    return fail(fmt::format("{} has no model of English: install the package pocketsphinx-en-us", kModel));
  err_set_logfp(nullptr);
  const std::string hmm = std::string(kModel) + "/en-us";
  std::unique_ptr<cmd_ln_t, FreeConfig> config(
      cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-cmn", "batch", "-remove_noise", "no",
                  "-remove_silence", "no", "-compallsen", "yes", "-lw", "8", "-fwdflatlw", "8", "-bestpathlw",
                  "8", "-beam", "1e-80", "-pbeam", "1e-80", "-wbeam", "1e-60", "-fwdflatbeam", "1e-80",
                  "-fwdflatwbeam", "1e-60", nullptr));
  if (!config) return fail("the recogniser does not take its settings");
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder(ps_init(config.get()));
  if (!decoder) return fail(fmt::format("the recogniser cannot read the model in {}", kModel));
  return std::unique_ptr<Recogniser>(
      std::make_unique<SphinxRecogniser>(std::move(config), std::move(decoder)));
}

}  // namespace icome::speech
