#pragma once

#include <filesystem>

#include "base/result.h"

namespace icome::files {

/// A running icome-vrml-worker and the socket that is its standard input and output. Ended and waited for
/// on destruction.
class VrmlChild {
 public:
  static base::Result<VrmlChild> start();

  VrmlChild(VrmlChild&& other) noexcept;
  VrmlChild& operator=(VrmlChild&&) = delete;
  ~VrmlChild();

  /// A non-blocking socket.
  int socket() const { return socket_; }
  int process() const { return process_; }
  /// Ends the process if it has not ended by itself; returns the status of waitpid(), -1 where someone
  /// else has waited for it.
  int end();

 private:
  VrmlChild(int process, int socket) : process_(process), socket_(socket) {}

  int process_;  // 0: it has ended
  int socket_;
};

}  // namespace icome::files
