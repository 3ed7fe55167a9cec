#pragma once
#include <string>
#include <string_view>

#include "files/vrml/read/vrml_frames.h"

namespace icome::files {

/// The worker's end of the dialogue with the reader. Any error in it ends the process: there is nobody left
/// to answer.
class Channel {
 public:
  VrmlFrameHead receive_head();
  /// The bytes that follow a head.
  std::string receive_bytes(const VrmlFrameHead& head);
  /// Receives a frame that must be of this kind.
  std::string receive(VrmlFrame kind);
  void send(VrmlFrame kind, int file, std::string_view bytes);
};

}  // namespace icome::files
