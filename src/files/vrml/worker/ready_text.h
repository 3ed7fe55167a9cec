#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/function_ref.h"

namespace icome::files {

/// A remark for people on a file, without the name of the file yet.
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

/// The text of a VRML file prepared for Coin, which gives up a whole file for one unknown field or node:
/// such are removed, and so are images whose pixels do not fit their size, uses of undefined names and all
/// ROUTEs, which would make Coin move things. Names that Coin would change become `IcomeName_7`, and so do
/// long strings, which it reads in a time that grows with the square of their length. Lines keep their
/// numbers.
struct ReadyText {
  std::string text;  // begins with the header of VRML 2.0
  /// For each EXTERNPROTO in order: a PROTO that can stand in for it and shows nothing.
  std::vector<std::string> stand_ins;
  std::vector<TextNote> notes;
  std::vector<TextRoute> routes;  // of the file itself, not of its PROTOs
  std::string error;              // why this must not be read; empty: Coin may read it
  int added_lines = 0;            // before the first line of the file
};

inline constexpr std::string_view kChangedName = "IcomeName_";

/// `has_field(node, field)` tells whether a node of VRML 2.0 has this field. `names` gets the originals of
/// changed names and strings, at the numbers in the new ones. From the first breach of the grammar on the
/// text is left to Coin. Unknown nodes are noted only in a part without a header, as the reader finds others.
ReadyText make_ready(std::string_view file,
                     base::FunctionRef<bool(const std::string& node, const std::string& field)> has_field,
                     std::vector<std::string>& names);

}  // namespace icome::files
