#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace icome::files {

/// Can this stand behind DEF in every program's files? VRML 2.0 allows more: bytes beyond ASCII, and '+',
/// which others rename.
bool is_vrml_name(std::string_view name);

/// Gives DEF names away, each once.
class VrmlNames {
 public:
  /// Takes the name; false when it cannot be one or is taken.
  bool take(const std::string& name);
  /// A free name like the one wanted: "left_door" for "left door", "left_door_2" where that is taken.
  std::string take_like(std::string_view wanted);

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> last_;  // number that was tried behind a name
};

}  // namespace icome::files
