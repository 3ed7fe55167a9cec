#pragma once
#include <cstddef>
#include <string_view>

#include "base/result.h"

namespace icome::files {

/// Offset of `#VRML V2.0 utf8` in a file: 0, or behind the byte order mark that some editors put before
/// UTF-8. Fails with half a sentence ("is VRML 1.0, ...") for everything else.
base::Result<std::size_t> find_vrml_header(std::string_view bytes);

/// Does text without a header begin with a node, DEF, PROTO or EXTERNPROTO of VRML 2.0? Parts that are only
/// inlined are often stored so.
bool begins_like_vrml(std::string_view bytes);

/// Is this the name of a node of VRML 2.0?
bool is_vrml_node(std::string_view name);

}  // namespace icome::files
