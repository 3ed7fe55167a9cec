#pragma once
#include <string>
#include <string_view>

#include "devices/haply/wire/web_socket.h"

namespace icome::devices {

/// A message with the bytes after it that its readers may look at, in memory of exactly that size.
class PaddedMessage {
 public:
  explicit PaddedMessage(std::string_view text) : size_(text.size()) {
    bytes_.reserve(size_ + WebSocket::kPadding);
    bytes_.assign(text);
    bytes_.resize(size_ + WebSocket::kPadding, '"');
  }
  operator std::string_view() const { return {bytes_.data(), size_}; }  // NOLINT(google-explicit-constructor)

 private:
  std::string bytes_;
  std::size_t size_;
};

}  // namespace icome::devices
