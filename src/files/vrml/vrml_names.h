#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace icome::files {

/// Can this stand behind DEF in every program's files? VRML 2.0 allows more: bytes beyond ASCII, and '+',
/// which others rename.
bool is_vrml_name(std::string_view name);

/// What a DEF name says: nothing for one that stands for none (vrml_protos.h).
std::string said_by(const std::string& def);

/// Gives DEF names away, each once.
class VrmlNames {
 public:
  /// Takes the name; false when it cannot be one, would mean none or is taken.
  bool take(const std::string& name);
  /// A free name like the one wanted: "left_door" for "left door", "left_door_2" where that is taken, and one
  /// that stands for none (vrml_protos.h) for "".
  std::string take_like(std::string_view wanted);

 private:
  std::string take_free(const std::string& name);

  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> last_;  // number that was tried behind a name
};

}  // namespace icome::files
