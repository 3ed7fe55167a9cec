#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/channel.h"

class SbName;
class SoMFString;
class SoNode;
class SoProto;

namespace icome::files {

struct SceneFile;

/// A ROUTE between existing nodes.
struct NodeRoute {
  const SoNode* from = nullptr;  // never null
  std::string out = {};
  std::string in = {};
  const SceneFile* file = nullptr;  // never null
  int line = 0;
};

/// A file as Coin read it. Its nodes live as long as the process.
struct SceneFile {
  int number = 0;  // its number for the reader
  std::string path = {};
  std::string told = {};  // its name in notes: empty for the design itself
  std::vector<SoNode*> roots = {};
  bool is_being_read = false;
  int inlined = 0;  // number of its Inlines that are being walked through
};

/// The design's file and those it inlines, each fetched and read once. Coin is used from here and by the
/// walk through its nodes; both from one thread.
class SceneFiles {
 public:
  SceneFiles(Channel& channel, Answer& answer);
  SceneFiles(const SceneFiles&) = delete;
  SceneFiles& operator=(const SceneFiles&) = delete;

  /// Gets all that Coin needs from the system, before that is out of reach.
  static void prepare_coin();

  /// Reads the design. Throws Refusal when nothing of it can be read.
  SceneFile& read_design(const std::string& path, std::string_view bytes);
  /// The first of the urls in `from` that can be fetched; null, with a note: none.
  SceneFile* fetch(const SceneFile& from, const std::vector<std::string>& urls, const char* who);
  /// The file that an EXTERNPROTO was taken from; null: it is no EXTERNPROTO.
  const SceneFile* home(const SoProto* proto) const;
  /// The original text of a node's name or of a string in its file.
  std::string original(const char* text) const;
  std::string original_name(const SbName& name) const;
  std::vector<std::string> strings(const SoMFString& field) const;
  /// The ROUTEs to a node, in the order of their file.
  const std::vector<NodeRoute>& routes_to(const SoNode& node) const;

 private:
  struct Callbacks;
  struct Reading;
  void read(SceneFile& file, std::string_view bytes);
  void keep_routes(const Reading& reading);
  static SoProto* stand_in(const std::string& text);

  Channel& channel_;
  Answer& answer_;
  std::unordered_map<int, std::unique_ptr<SceneFile>> files_;
  std::unordered_map<const SoProto*, const SceneFile*> homes_;
  std::unordered_map<const SoNode*, std::vector<NodeRoute>> routes_;  // by their targets
  std::vector<std::string> changed_names_;
  std::vector<Reading*> reading_;  // innermost last
};

}  // namespace icome::files
