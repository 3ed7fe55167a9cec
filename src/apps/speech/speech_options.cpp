#include "apps/speech/speech_options.h"

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"

namespace icome::apps {
namespace {

constexpr const char* kSayNotes =
    "Examples:\n"
    "  icome say \"three small red spheres\" \"make them yellow\" --out balls.wrl\n"
    "  icome say --design house.wrl \"select the one on the table\" --json\n"
    "  icome say --design house.wrl --pointer 0,0.8,0.1 \"copy this here\" --out house.wrl\n"
    "  icome say --design house.wrl --out new.wrl          sentences from standard input, one a line\n"
    "\n"
    "Sentences are understood as if they were heard (docs/speech.md). Left, right, in front and behind are\n"
    "those of a viewer who looks along -z; y is up. With --pointer there is a hand whose tip is there, m in\n"
    "the world; it touches what is within 5 mm, and points along -z or as the second three numbers say.\n"
    "A sentence that is not understood changes nothing and is no failure of the command.\n"
    "\n"
    "JSON, one object a line for each sentence: {heard, accepted, state: done|asked|refused, intent: null "
    "or\n"
    "{op, ...}, reply, objects: [names], candidates: [names, of the question which one is meant],\n"
    "operations: [lines for icome edit]}.";

constexpr const char* kVoiceNotes =
    "Examples:\n"
    "  icome voice --list                          what can be said about an empty design\n"
    "  icome voice --list --design house.wrl       its names too; each sentence can be said as it stands\n"
    "  icome voice --check words.toml              is a vocabulary of one's own right?\n"
    "  icome voice --jsgf > icome.jsgf             the grammar for a recogniser\n"
    "\n"
    "A vocabulary adds words, rules and commands to the built-in one (docs/speech.md).\n"
    "\n"
    "JSON of --list: {language, commands: [{name, help, forms: [patterns], sentences: [each can be said "
    "now]}],\n"
    "words: {table: [words]}, names: [of objects]}; of --check: {file, valid, problems: [sentences with "
    "lines],\n"
    "commands}.";

constexpr const char* kListenNotes =
    "Examples:\n"
    "  icome listen order.wav --json               what is heard in a recording, and what it means\n"
    "  icome listen a.wav b.wav --apply --out balls.wrl\n"
    "                                              do it, one after the other, and save the design\n"
    "  icome listen --design house.wrl --apply     the microphone, until Ctrl-C\n"
    "  icome listen --apply --wake-word computer --speak\n"
    "                                              it is called by \"computer\", and answers aloud\n"
    "  icome listen move.wav --design house.wrl --pointer hand.csv --apply --out house.wrl\n"
    "\n"
    "Recordings are WAV, FLAC or OGG at any rate, or .raw (16 kHz, 16 bits, one channel). They are cut "
    "where\n"
    "nobody speaks. Without --apply each utterance is understood for the design as it is, and nothing is "
    "done.\n"
    "What is no sentence of the grammar (icome voice --list) is refused, as is what fits worse than\n"
    "--least-score; docs/speech.md tells how often it is right. The hand's path has a first line t,x,y,z\n"
    "(s, m in the world) or t,x,y,z,dx,dy,dz (where it points); t runs on from one recording to the next,\n"
    "and \"this\" and \"here\" mean the hand at the moment of the word.\n"
    "\n"
    "JSON, one object a line for each utterance: {file, begin_s, end_s, heard, score (0 at best, or null), "
    "accepted,\n"
    "state, intent: null or {op, ...}, said: the reply, objects, candidates, operations, ms: from the whole\n"
    "utterance to its meaning}.";

void add_talk_options(CLI::App& command, TalkOptions& talk) {
  command.add_option("--design", talk.design, "The design that is spoken of, or new (default)")
      ->type_name("FILE");
  command.add_option("--vocabulary", talk.vocabularies, "Words and commands that are added (docs/speech.md)")
      ->type_name("FILE.toml")
      ->allow_extra_args(false);
  command
      .add_option("--words", talk.words,
                  "One's own words for colours and sizes (default: icome/words.toml in ~/.config)")
      ->type_name("FILE.toml");
}

}  // namespace

void add_speech(CLI::App& app, SpeechOptions& options) {
  CLI::App& say =
      *app.add_subcommand("say", "Understand sentences as voice commands, without sound (thesis 7.4)");
  say.footer(kSayNotes);
  say.add_option("SENTENCE", options.say.sentences,
                 "Sentences, one after the other (default: standard input)")
      ->type_name("");
  add_talk_options(say, options.say.talk);
  say.add_option("--pointer", options.say.pointer, "There is a hand there")->type_name("X,Y,Z[,DX,DY,DZ]");
  say.add_option("--out", options.say.out, "Save the design when all is said")->type_name("OUT");
  say.add_flag("--force", options.say.force, "Replace a file even if some of it would be lost");
  say.add_flag("--json", options.say.talk.json, "Print a JSON object for each sentence (fields below)");
  say.callback([&options] { options.task = "say"; });

  CLI::App& listen =
      *app.add_subcommand("listen", "Understand voice commands by microphone or recording (thesis 7.4)");
  listen.footer(kListenNotes);
  auto* const recordings =
      listen.add_option("WAV", options.listen.recordings, "Recordings of speech (default: the microphone)")
          ->type_name("")
          ->check(not_empty());
  add_talk_options(listen, options.listen.talk);
  listen.add_option("--pointer", options.listen.pointer, "Where the hand is, by the time")
      ->type_name("P.csv");
  auto* const apply = listen.add_flag("--apply", options.listen.apply, "Do what is understood");
  listen
      .add_option("--out", options.listen.out, "Save the design when all is heard (default: over --design)")
      ->type_name("OUT")
      ->needs(apply);
  listen.add_option("--microphone", options.listen.microphone, "Another microphone than the usual one")
      ->type_name("NAME")
      ->check(not_empty())
      ->excludes(recordings);
  listen
      .add_option("--wake-word", options.listen.wake_word,
                  "Only what begins with this word is meant, or follows it alone within 8 s")
      ->type_name("WORD");
  listen.add_flag("--speak", options.listen.speak, "Speak the replies, and hear nothing meanwhile")
      ->excludes(recordings);
  listen.add_flag("--force", options.listen.force, "Replace a file even if some of it would be lost");
  listen.add_option("--hang", options.listen.hang, "Silence that ends an utterance (default 0.4)")
      ->type_name("S")
      ->check(number_range(0.1, 2.0));
  listen
      .add_option("--least-score", options.listen.least_score,
                  "Score below which an utterance is no sentence (default -6.6)")
      ->type_name("SCORE")
      ->check(number_range(-100.0, 0.0));
  listen.add_flag("--json", options.listen.talk.json,
                  "Print a JSON object for each utterance (fields below)");
  listen.callback([&options] { options.task = "listen"; });

  CLI::App& voice =
      *app.add_subcommand("voice", "List what can be said, and check a vocabulary of one's own");
  voice.footer(kVoiceNotes);
  auto* const what = voice.add_option_group("what");
  what->add_flag("--list", options.voice.list, "Print what can be said");
  what->add_flag("--jsgf", options.voice.jsgf, "Print the grammar as JSGF");
  what->add_option("--check", options.voice.check, "Check a vocabulary")->type_name("FILE.toml");
  what->require_option(1);
  add_talk_options(voice, options.voice.talk);
  voice.add_flag("--json", options.voice.talk.json, "Print the answer as JSON (fields below)");
  voice.callback([&options] { options.task = "voice"; });
}

}  // namespace icome::apps
