#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace icome::files {

/// Can this be a DEF name in every program's files? VRML 2.0 allows more: bytes beyond ASCII, and '+',
/// which others rename.
bool is_vrml_name(std::string_view name);

/// The name that a DEF name expresses: empty for one that stands for none (vrml_protos.h).
std::string said_by(const std::string& def);

/// Gives DEF names, each once.
class VrmlNames {
 public:
  /// Takes the name; false when it is no valid one, would mean none or is taken.
  bool take(const std::string& name);
  /// A free name like the one wanted: "left_door" for "left door", "left_door_2" where that is taken, and one
  /// that stands for none (vrml_protos.h) for "".
  std::string take_like(std::string_view wanted);

 private:
  std::string take_free(const std::string& name);

  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> last_;  // last number tried behind a name
};

}  // namespace icome::files
