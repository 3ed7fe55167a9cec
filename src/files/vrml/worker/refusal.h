#pragma once
#include <string>

namespace icome::files {

/// Why the whole file is refused; thrown.
struct Refusal {
  std::string why;
};

}  // namespace icome::files
