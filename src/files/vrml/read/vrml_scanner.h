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

/// A script of a file, kept in its original text.
struct VrmlScript {
  std::string name;    // its DEF name; empty: none
  std::string source;  // "DEF name Script { ... }"
  int line = 0;        // from 1
};

/// The parts of a VRML 2.0 file that ICOME leaves out.
struct VrmlLeftOut {
  std::vector<VrmlScript> scripts;  // in the file's order, outside PROTOs and without USE and IS
  std::vector<Remark> remarks;      // one on each type of node, in the order of their first lines
};

/// The parts of a file that were used after all, for motions.
struct VrmlTaken {
  std::multiset<int> routes = {};                 // their lines
  std::set<std::string, std::less<>> nodes = {};  // TimeSensors and interpolators, by their DEF names
};
/// By file; the key of the design itself is "".
using VrmlMoving = std::map<std::string, VrmlTaken>;

/// Largest depth of nested braces and brackets: parsers handle them by recursion.
inline constexpr int kMostNestedVrml = 2000;

/// Scans the text of a VRML 2.0 file for parts that are left out or change their meaning: nodes without an
/// effect here, unknown nodes, scripts and routes, in PROTOs too. The parser decides whether the rest is
/// valid VRML. Fails when the text is not VRML 2.0 or nested deeper than kMostNestedVrml; `name` names the
/// file in the error, and `of` in the remarks: empty for the file that was asked for, else it is a part of
/// that, which needs no header and whose unknown nodes the parser reports. Nothing is said of parts that
/// were `taken`.
base::Result<VrmlLeftOut> scan_vrml(std::string_view text, const std::string& name,
                                    const std::string& of = {}, const VrmlTaken& taken = {});

}  // namespace icome::files
