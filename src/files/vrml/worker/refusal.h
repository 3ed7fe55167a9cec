#pragma once
#include <string>

namespace icome::files {

/// The reason why the whole file is refused; thrown.
struct Refusal {
  std::string why;
};

}  // namespace icome::files
