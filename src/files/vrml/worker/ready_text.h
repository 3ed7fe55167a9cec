#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/function_ref.h"

namespace icome::files {

/// Something a person should know about a file, before it is known which.
struct TextNote {
  int line = 0;
  std::string text;
};

/// "ROUTE clock.fraction_changed TO path.set_fraction".
struct TextRoute {
  std::string from;  // as Coin reads the name
  std::string out;
  std::string to;  // likewise
  std::string in;
  int line = 0;  // of the file
};

/// The text of a VRML file made ready for Coin, which gives up a whole file for one field or node that it
/// does not know: such are taken out, and so are images whose pixels do not fit their size, uses of names
/// that nothing has and all ROUTEs, which would have Coin move things. Names that Coin would change become
/// `IcomeName_7`, and so do long strings, which it reads in a time that grows with the square of their
/// length. Lines stay where they were.
struct ReadyText {
  std::string text;  // begins with the header of VRML 2.0
  /// For each EXTERNPROTO in order: a PROTO that can stand in for it and shows nothing.
  std::vector<std::string> stand_ins;
  std::vector<TextNote> notes;
  std::vector<TextRoute> routes;  // of the file itself, not of its PROTOs
  std::string error;              // why nobody should read this; empty: Coin may
  int added_lines = 0;            // before the first line of the file
};

inline constexpr std::string_view kChangedName = "IcomeName_";

/// `has_field(node, field)` tells whether a node of VRML 2.0 has this field. `names` gets, at the number in
/// a changed name or string, what it was. Whatever does not follow the grammar is left to Coin from there on.
/// Nodes that nobody knows are only noted in a part without a header, since the reader finds them in others.
ReadyText make_ready(std::string_view file,
                     base::FunctionRef<bool(const std::string& node, const std::string& field)> has_field,
                     std::vector<std::string>& names);

}  // namespace icome::files
