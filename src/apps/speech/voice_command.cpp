#include "apps/speech/voice_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/speech/talk.h"
#include "apps/terminal.h"
#include "speech/dialogue/sayable.h"
#include "speech/hearing/recogniser.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json words_json(const speech::Vocabulary& vocabulary) {
  Json tables = Json::object();
  for (const auto& [name, words] : vocabulary.tables) {
    Json& table = tables[name] = Json::array();
    for (const speech::WordMeaning& word : words) table.push_back(word.words);
  }
  return tables;
}

Json names_json(const world::World& world) {
  std::vector<std::string> names;
  for (const auto& [id, object] : world.objects())
    if (!object.name.empty()) names.push_back(object.name);
  std::ranges::sort(names);
  return names;
}

std::string list_json(const speech::Vocabulary& vocabulary, const world::World& world,
                      const std::vector<speech::Sayable>& sayable) {
  Json json{{"language", vocabulary.language}, {"commands", Json::array()}};
  for (const speech::Sayable& it : sayable)
    json["commands"].push_back(
        {{"name", it.command}, {"help", it.help}, {"forms", it.forms}, {"sentences", it.sentences}});
  json["words"] = words_json(vocabulary);
  json["names"] = names_json(world);
  return text_of(json);
}

std::string list_text(const speech::Vocabulary& vocabulary, const std::vector<speech::Sayable>& sayable) {
  std::string text;
  for (const speech::Sayable& it : sayable) {
    text += fmt::format("{}: {}\n", it.command, it.help);
    for (const std::string& sentence : it.sentences) text += "  " + sentence + "\n";
  }
  for (const char* table : {"colour", "size", "shape", "material"}) {
    std::string words;
    for (const speech::WordMeaning& word : vocabulary.table(table))
      words += (words.empty() ? "" : ", ") + word.words;
    text += fmt::format("Words for {}: {}\n", table, words);
  }
  return text;
}

base::Result<std::string> list(const VoiceOptions& options, StatusLine& status) {
  const auto talk = Talk::open(options.talk, status);
  if (!talk) return tl::unexpected(talk.error());
  speech::Dialogue& dialogue = (*talk)->dialogue();
  if (options.jsgf) return dialogue.vocabulary().grammar.jsgf(speech::Dialogue::kSentence, "icome");
  status.say("Trying what can be said");
  const auto sayable = speech::sayable_now(dialogue);
  return options.talk.json ? list_json(dialogue.vocabulary(), (*talk)->world(), sayable)
                           : list_text(dialogue.vocabulary(), sayable);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Words of a vocabulary that nobody can be heard to say. Fails where there is no recogniser that tells.
base::Result<std::vector<std::string>> silent_words(const TalkOptions& options, StatusLine& status) {
  const auto talk = Talk::open(options, status);
  if (!talk) return tl::unexpected(talk.error());
  status.say("Loading the recogniser");
  const auto recogniser = speech::make_sphinx_recogniser();
  status.clear();
  if (!recogniser) return tl::unexpected(recogniser.error());
  return (*recogniser)
      ->set_grammar((*talk)->dialogue().vocabulary().grammar,
                    {speech::Dialogue::kSentence, speech::Dialogue::kUsualSentence});
}

/// Sentences, each with its file, about what is wrong with the last vocabulary of the options.
std::vector<std::string> problems_of(const TalkOptions& options,
                                     const base::Result<speech::Vocabulary>& vocabulary) {
  if (!vocabulary) return lines_of(vocabulary.error().message);
  const std::string file = options.vocabularies.back().string();
  std::vector<std::string> problems;
  for (const std::string& it : speech::often_but_never(*vocabulary))
    problems.push_back(fmt::format("{}: {}.", file, it));
  StatusLine status;
  const auto silent = silent_words(options, status);
  if (!silent)
    tell(silent.error().message);
  else if (!silent->empty())
    problems.push_back(fmt::format("{}: nobody can be heard to say: {}.", file, fmt::join(*silent, ", ")));
  return problems;
}

int check(const VoiceOptions& options) {
  TalkOptions talk = options.talk;
  talk.vocabularies.push_back(options.check);
  const auto vocabulary = vocabulary_of(talk);
  const std::vector<std::string> problems = problems_of(talk, vocabulary);
  if (options.talk.json) {
    const Json json{{"file", options.check.string()},
                    {"valid", problems.empty()},
                    {"problems", problems},
                    {"commands", vocabulary ? vocabulary->commands.size() : 0}};
    const int written = print_answer(text_of(json));
    return problems.empty() ? written : kFailed;
  }
  for (const std::string& problem : problems) tell(problem);
  if (!problems.empty()) return kFailed;
  return print_answer(fmt::format("{}: good; {} commands with the built-in ones\n", options.check.string(),
                                  vocabulary->commands.size()));
}

}  // namespace

int run_voice(const VoiceOptions& options) {
  catch_interrupts();
  if (!options.check.empty()) return check(options);
  StatusLine status;
  const auto answer = list(options, status);
  status.clear();
  if (!answer) return end_without_result(answer.error(), status);
  return print_answer(*answer);
}

}  // namespace icome::apps
