#pragma once
#include <string>
#include <string_view>

#include "files/vrml/read/vrml_frames.h"

namespace icome::files {

/// The worker's end of the talk with the reader. Whatever breaks the talk ends the process: there is nobody
/// left to answer.
class Channel {
 public:
  VrmlFrameHead receive_head();
  /// The bytes that follow a head.
  std::string receive_bytes(const VrmlFrameHead& head);
  /// A frame that must be of this kind.
  std::string receive(VrmlFrame kind);
  void send(VrmlFrame kind, int file, std::string_view bytes);
};

}  // namespace icome::files
