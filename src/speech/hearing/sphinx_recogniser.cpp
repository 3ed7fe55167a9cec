// The only source that knows PocketSphinx.
#include <fmt/format.h>
#include <pocketsphinx/pocketsphinx.h>
#include <sphinxbase/err.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "speech/hearing/recogniser.h"
#include "speech/hearing/word_sounds.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr const char* kModel = "/usr/share/pocketsphinx/model/en-us";
constexpr const char* kSearch = "icome";
constexpr double kFramesPerSecond = 100.0;

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
    std::vector<std::string> silent;
    for (const std::string& word : grammar.vocabulary(rule))
      if (!teach(word)) silent.push_back(word);
    const Grammar spoken = silent.empty() ? grammar : without(grammar, silent);
    const std::string jsgf = spoken.jsgf(rule, "icome");
    if (ps_set_jsgf_string(decoder_.get(), kSearch, jsgf.c_str()) != 0 ||
        ps_set_search(decoder_.get(), kSearch) != 0)
      return fail("the recogniser does not take the grammar: it has no sentence");
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

  /// The grammar without sentences that have one of these words.
  static Grammar without(const Grammar& grammar, const std::vector<std::string>& words) {
    Grammar rest = grammar;
    for (const auto& [name, pattern] : grammar.rules()) rest.set(name, without(pattern, words));
    return rest;
  }
  static Pattern without(const Pattern& pattern, const std::vector<std::string>& words) {
    const bool is_silent =
        pattern.kind == Pattern::Kind::Word && std::ranges::find(words, pattern.text) != words.end();
    if (is_silent) return {Pattern::Kind::Choice, {}, {}};
    Pattern rest = pattern;
    for (Pattern& part : rest.parts) part = without(part, words);
    return rest;
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
    if (frames > 0.0)
      heard.score = sum / frames * logmath_log_to_ln(ps_get_logmath(decoder_.get()), 1024) / 1024.0;
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
  std::unique_ptr<cmd_ln_t, FreeConfig> config(cmd_ln_init(
      nullptr, ps_args(), TRUE, "-hmm", hmm.c_str(), "-dict", dictionary.c_str(), "-cmn", "batch", nullptr));
  if (!config) return fail("the recogniser does not take its settings");
  std::unique_ptr<ps_decoder_t, FreeDecoder> decoder(ps_init(config.get()));
  if (!decoder) return fail(fmt::format("the recogniser cannot read the model in {}", kModel));
  return std::unique_ptr<Recogniser>(
      std::make_unique<SphinxRecogniser>(std::move(config), std::move(decoder)));
}

}  // namespace icome::speech
