#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "files/remark.h"

namespace icome::files {

/// A script of a file, which is kept as it stands there.
struct VrmlScript {
  std::string name;    // its DEF name; empty: none
  std::string source;  // "DEF name Script { ... }"
  int line = 0;        // from 1
};

/// What ICOME does not take over from a VRML 2.0 file.
struct VrmlLeftOut {
  std::vector<VrmlScript> scripts;  // in the file's order, outside PROTOs and without USE and IS
  std::vector<Remark> remarks;      // one on each type of node, in the order of their first lines
};

/// What of a file was taken after all, for motions.
struct VrmlTaken {
  std::multiset<int> routes = {};                 // their lines
  std::set<std::string, std::less<>> nodes = {};  // TimeSensors and interpolators, by their DEF names
};
/// By file; the design itself is "".
using VrmlMoving = std::map<std::string, VrmlTaken>;

/// How deep braces and brackets may lie within each other: parsers go into them by recursion.
inline constexpr int kMostNestedVrml = 2000;

/// Looks through the text of a VRML 2.0 file for what is left out or changes its meaning: nodes that do
/// nothing here, nodes that nobody knows, scripts and routes, in PROTOs too. Whether the rest is good VRML
/// is for the parser to say. Fails when the text is not VRML 2.0 or nested deeper than kMostNestedVrml;
/// `name` names the file in the error, and `of` in the remarks: empty for the file that was asked for, else
/// it is a part of that, which needs no header
/// and of which the parser tells what nobody knows. Nothing is said of what was `taken`.
base::Result<VrmlLeftOut> scan_vrml(std::string_view text, const std::string& name,
                                    const std::string& of = {}, const VrmlTaken& taken = {});

}  // namespace icome::files
