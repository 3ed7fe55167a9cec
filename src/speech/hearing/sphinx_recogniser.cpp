// The only source that knows PocketSphinx.
#include <fmt/format.h>
#include <pocketsphinx/pocketsphinx.h>
#include <sphinxbase/err.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "base/random.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/grammar/word_graph.h"
#include "speech/hearing/recogniser.h"
#include "speech/hearing/word_sounds.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr const char* kModel = "/usr/share/pocketsphinx/model/en-us";
constexpr const char* kSearch = "icome";
constexpr double kFramesPerSecond = 100.0;
constexpr double kLanguageWeight = 6.5;  // of steps beside sounds
/// Parts of sentences that the graph has once for all places, as it would be too large otherwise.
constexpr std::array<std::string_view, 1> kShared = {"object"};

/// How often each step of a state was taken, the end of the sentence last.
struct StepCount {
  std::vector<double> counts;
  double sum = 0.0;

  /// Steps that were not taken share what twenty steps are worth with the others.
  double share(std::size_t step) const {
    constexpr double kUnseen = 20.0;
    return (counts[step] + kUnseen / double(counts.size())) / (sum + kUnseen);
  }
};
using StepCounts = std::vector<StepCount>;

/// The steps of sentences drawn at random, where each form of a rule is as likely as the others.
StepCounts usual_steps(const Grammar& grammar, std::string_view rule, const WordGraph& graph) {
  constexpr int kSentences = 20'000;
  StepCounts counts;
  for (const WordGraph::State& state : graph.states)
    counts.push_back({std::vector<double>(state.next.size() + 1, 0.0), 0.0});
  base::Random random(1);
  const Pattern* const pattern = grammar.find(rule);
  for (int i = 0; i < kSentences; ++i) {
    const auto words = sample_sentence(grammar, *pattern, random);
    if (!words) break;
    std::size_t at = 0;
    const auto take = [&](std::size_t step) {
      counts[at].counts[step] += 1.0;
      counts[at].sum += 1.0;
    };
    for (const std::string& word : *words) {
      const auto& next = graph.states[at].next;
      const auto step =
          std::ranges::lower_bound(next, word, {}, &std::pair<std::string, std::uint32_t>::first);
      take(std::size_t(step - next.begin()));
      at = step->second;
    }
    take(graph.states[at].next.size());
  }
  return counts;
}

struct FreeDecoder {
  void operator()(ps_decoder_t* decoder) const { ps_free(decoder); }
};
struct FreeConfig {
  void operator()(cmd_ln_t* config) const { cmd_ln_free_r(config); }
};

/// Is it a silence or a noise, which the recogniser puts between words?
bool is_filler(std::string_view word) {
  return word.empty() || word.front() == '<' || word.front() == '[' || word.front() == '+' ||
         word == "(NULL)";
}

/// "read(2)" is a second way to say "read".
std::string without_variant(std::string_view word) { return std::string(word.substr(0, word.find('('))); }

class SphinxRecogniser final : public Recogniser {
 public:
  SphinxRecogniser(std::unique_ptr<cmd_ln_t, FreeConfig> config,
                   std::unique_ptr<ps_decoder_t, FreeDecoder> decoder)
      : config_(std::move(config)), decoder_(std::move(decoder)) {}

  Result<std::vector<std::string>> set_grammar(const Grammar& grammar, std::string_view rule) override {
    const auto graph = word_graph(grammar, rule, {kShared.begin(), kShared.end()});
    if (!graph) return tl::unexpected(graph.error());
    std::vector<std::string> silent;
    std::set<std::string> known;
    for (const std::string& word : grammar.vocabulary(rule)) {
      if (teach(word))
        known.insert(word);
      else
        silent.push_back(word);
    }
    fsg_model_t* const model = model_of(*graph, usual_steps(grammar, rule, *graph), known);
    const bool taken =
        ps_set_fsg(decoder_.get(), kSearch, model) == 0 && ps_set_search(decoder_.get(), kSearch) == 0;
    fsg_model_free(model);
    if (!taken) return fail("the recogniser does not take the grammar: it has no sentence");
    return silent;
  }

  Result<Heard> recognise(Sound utterance) override {
    if (ps_start_utt(decoder_.get()) != 0)
      return fail("the recogniser did not begin; give it a grammar first");
    // The whole utterance at once: its own mean is what it is normalised by.
    const int frames = ps_process_raw(decoder_.get(), utterance.data(), utterance.size(), FALSE, TRUE);
    ps_end_utt(decoder_.get());
    if (frames < 0) return fail("the recogniser did not take the sound");
    return best();
  }

 private:
  /// Makes the word known; false where there are no sounds for it.
  bool teach(const std::string& word) {
    if (char* known = ps_lookup_word(decoder_.get(), word.c_str())) {
      ckd_free(known);
      return true;
    }
    const std::string sounds = sounds_of_word(word);
    return !sounds.empty() && ps_add_word(decoder_.get(), word.c_str(), sounds.c_str(), FALSE) >= 0;
  }

  /// The graph with the share of each step among sentences drawn at random, as the recogniser has it; without
  /// words that are not known.
  fsg_model_t* model_of(const WordGraph& graph, const StepCounts& counts,
                        const std::set<std::string>& known) {
    logmath_t* const logarithms = ps_get_logmath(decoder_.get());
    const auto end = int32(graph.states.size());
    fsg_model_t* const model = fsg_model_init(kSearch, logarithms, float32(kLanguageWeight), end + 1);
    model->start_state = 0;
    model->final_state = end;
    for (int32 from = 0; from < end; ++from) {
      const WordGraph::State& state = graph.states[std::size_t(from)];
      const auto weight = [&](std::size_t step) {
        const double share = counts[std::size_t(from)].share(step);
        return int32(logmath_log(logarithms, share) * kLanguageWeight);
      };
      if (state.is_end) fsg_model_null_trans_add(model, from, end, weight(state.next.size()));
      for (std::size_t i = 0; i < state.next.size(); ++i) {
        const auto& [word, to] = state.next[i];
        if (known.contains(word))
          fsg_model_trans_add(model, from, int32(to), weight(i), fsg_model_word_add(model, word.c_str()));
      }
    }
    // What it gives back is a list of the steps, which the model has too.
    glist_free(fsg_model_null_trans_closure(model, nullptr));
    return model;
  }

  Heard best() {
    Heard heard;
    double sum = 0.0, frames = 0.0;
    for (ps_seg_t* segment = ps_seg_iter(decoder_.get()); segment; segment = ps_seg_next(segment)) {
      const char* const word = ps_seg_word(segment);
      if (!word || is_filler(word)) continue;
      int first = 0, last = 0;
      ps_seg_frames(segment, &first, &last);
      int32 acoustic = 0;
      ps_seg_prob(segment, &acoustic, nullptr, nullptr);
      sum += double(acoustic);
      frames += double(last - first + 1);
      heard.words.push_back({without_variant(word), first / kFramesPerSecond, (last + 1) / kFramesPerSecond});
    }
    int32 score = 0;
    if (!ps_get_hyp(decoder_.get(), &score)) heard.words.clear();  // it did not come to the end of a sentence
    // Scores are in units of the recogniser's own logarithm.
    // Sounds are scored in 1024 units of the recogniser's own logarithm.
    constexpr int kUnits = 1024;
    if (frames > 0.0) heard.score = sum / frames * logmath_log_to_ln(ps_get_logmath(decoder_.get()), kUnits);
    return heard;
  }

  std::unique_ptr<cmd_ln_t, FreeConfig> config_;
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder_;
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
  const std::string dictionary = std::string(kModel) + "/cmudict-en-us.dict";
  std::unique_ptr<cmd_ln_t, FreeConfig> config(
      cmd_ln_init(nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-dict", dictionary.c_str(), "-cmn", "batch",
                  "-remove_silence", "no", "-dither", "yes", "-seed", "1", "-beam", "1e-80", "-pbeam",
                  "1e-80", "-wbeam", "1e-60", nullptr));
  if (!config) return fail("the recogniser does not take its settings");
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder(ps_init(config.get()));
  if (!decoder) return fail(fmt::format("the recogniser cannot read the model in {}", kModel));
  return std::unique_ptr<Recogniser>(
      std::make_unique<SphinxRecogniser>(std::move(config), std::move(decoder)));
}

}  // namespace icome::speech
