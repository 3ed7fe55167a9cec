#pragma once
#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

namespace icome::collab {

/// A frame of which a part has come; keeps little between two frames. Owns its bytes.
class FrameInPart {
 public:
  /// Room for what comes next: as much again as has come, as a sender can announce more than it will send.
  boost::asio::mutable_buffer room(std::size_t most) {
    if (size_ == capacity_) {
      const std::size_t wanted = std::clamp(2 * capacity_, kFirstBytes, std::max(kFirstBytes, most + 1));
      void* const grown = std::realloc(bytes_.get(), wanted);
      if (grown == nullptr) throw std::bad_alloc();
      static_cast<void>(bytes_.release());
      bytes_.reset(static_cast<char*>(grown));
      capacity_ = wanted;
    }
    return {bytes_.get() + size_, capacity_ - size_};
  }
  void add(std::size_t size) { size_ += size; }
  std::string_view view() const { return {bytes_.get(), size_}; }
  void clear() {
    size_ = 0;
    if (capacity_ <= kKeptBytes) return;
    bytes_.reset();
    capacity_ = 0;
  }

 private:
  static constexpr std::size_t kFirstBytes = 1024;
  static constexpr std::size_t kKeptBytes = 4096;
  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };
  std::unique_ptr<char, Free> bytes_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace icome::collab
