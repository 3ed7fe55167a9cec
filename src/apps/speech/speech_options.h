#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// What the commands that understand sentences have in common.
struct TalkOptions {
  std::string design = "new";                       // a file, or kNewDesign
  std::filesystem::path words;                      // of one's own; empty: the usual file
  std::vector<std::filesystem::path> vocabularies;  // added to the built-in one
  bool json = false;
};

/// The options of `icome say`.
struct SayOptions {
  TalkOptions talk;
  std::vector<std::string> sentences;  // none: the lines of standard input
  std::string pointer;                 // "x,y,z" or "x,y,z,dx,dy,dz"; empty: there is no hand
  std::filesystem::path out;           // empty: the design is not saved
  bool force = false;
};

/// The options of `icome voice`.
struct VoiceOptions {
  TalkOptions talk;
  bool list = false;
  bool jsgf = false;
  std::filesystem::path check;
};

/// The options of `icome listen`.
struct ListenOptions {
  TalkOptions talk;
  std::vector<std::filesystem::path> recordings;  // none: the microphone
  std::string microphone;                         // empty: the usual one
  std::filesystem::path pointer;                  // path of the hand; empty: there is none
  bool apply = false;                             // do what was understood
  std::filesystem::path out;                      // empty: over the design, where it is a file
  bool force = false;
  std::optional<std::string> wake_word;  // that begins what is meant; none: all is meant
  bool speak = false;                    // the replies
  double hang = 0.4;                     // s of silence that end an utterance
  std::optional<double> least_score;     // none: the usual one
};

/// The options of the commands of speech; a command that was not given leaves nothing.
struct SpeechOptions {
  SayOptions say;
  VoiceOptions voice;
  ListenOptions listen;
  std::string task = {};  // "say", "voice" or "listen"; empty: none
};

void add_speech(CLI::App& app, SpeechOptions& options);

}  // namespace icome::apps
