#pragma once
#include <cstdint>
#include <string>

namespace icome::session {

/// Something that somebody said or did in a shared design.
struct SharedLine {
  std::uint64_t number = 0;  // from 1 on, for whoever looks for new ones
  std::uint32_t author = 0;
  std::string name = {};  // of the person
  std::string text = {};  // what was said, or what the person did: "is here"
  bool is_said = false;
};

}  // namespace icome::session
