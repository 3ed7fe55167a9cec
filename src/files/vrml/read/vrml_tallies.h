#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/remark.h"

namespace icome::files {

/// Treatment of a node of a VRML file.
enum class VrmlFate {
  Taken,        // it has a meaning here
  Group,        // its children are taken, its effect on them is not
  Finest,       // the first of its levels of detail is taken
  LeftOut,      // it is known, and has no effect here
  Unknown,      // to VRML 2.0
  Route,        // of events
  Kept,         // a script that is kept and does not run
  BoundScript,  // refers to things around it, and cannot be kept alone
  ProtoScript,  // belongs to a PROTO
};

/// The treatment of a type of VRML 2.0 or any other; scripts are not distinguished.
VrmlFate fate_of(std::string_view type);

/// Counts the left-out parts of a text by type, and remembers the first few lines of each.
class VrmlTallies {
 public:
  /// The types must outlive this object.
  void add(std::string_view type, VrmlFate fate, int line);
  /// One for each type, in the order of their first lines; `of` names the file.
  std::vector<Remark> remarks(const std::string& of) const;

 private:
  struct Tally {
    std::size_t count = 0;
    std::vector<int> lines = {};  // of the first ones
  };
  using Key = std::pair<VrmlFate, std::string_view>;
  static std::string sentence(const Key& key, const Tally& tally);

  std::map<Key, Tally> tallies_;
};

}  // namespace icome::files
