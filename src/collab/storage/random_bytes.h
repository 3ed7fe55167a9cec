#pragma once
#include <string>

#include "base/result.h"

namespace icome::collab {

/// So many bytes that nobody can guess.
base::Result<std::string> random_bytes(std::size_t count);

/// Two hexadecimal digits for each byte.
std::string hex_text(std::string_view bytes);

}  // namespace icome::collab
