#include "files/vrml/worker/channel.h"

#include <unistd.h>

#include <cerrno>

namespace icome::files {
namespace {

void read_all(char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::read(STDIN_FILENO, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(kVrmlBadFrame);
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

void write_all(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(STDOUT_FILENO, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(kVrmlBadFrame);
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

}  // namespace

VrmlFrameHead Channel::receive_head() {
  VrmlFrameHead head;
  read_all(reinterpret_cast<char*>(&head), sizeof head);
  return head;
}

std::string Channel::receive_bytes(const VrmlFrameHead& head) {
  std::string bytes(head.size, '\0');
  read_all(bytes.data(), bytes.size());
  return bytes;
}

std::string Channel::receive(VrmlFrame kind) {
  const VrmlFrameHead head = receive_head();
  if (head.kind != kind) ::_exit(kVrmlBadFrame);
  return receive_bytes(head);
}

void Channel::send(VrmlFrame kind, int file, std::string_view bytes) {
  const VrmlFrameHead head{kind, file, bytes.size()};
  write_all(reinterpret_cast<const char*>(&head), sizeof head);
  write_all(bytes.data(), bytes.size());
}

}  // namespace icome::files
