#pragma once
#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "realtime/cache_line.h"

namespace icome::realtime {

/// Messages from one thread to one other thread, first in, first out (thesis section 5.6.1, without
/// its lock). One thread pushes, one thread pops, and neither ever waits: a full pipe refuses, an
/// empty one gives nothing. The pipe owns the messages in it; their memory is taken at construction.
template <typename T>
class MessagePipe {
 public:
  /// Room for `capacity` messages, > 0.
  explicit MessagePipe(std::size_t capacity) : capacity_(capacity), slots_(std::bit_ceil(capacity)) {
    assert(capacity > 0);
  }

  MessagePipe(const MessagePipe&) = delete;
  MessagePipe& operator=(const MessagePipe&) = delete;

  std::size_t capacity() const { return capacity_; }

  /// Pushing thread: appends the message; false when the pipe is full, and then `message` still
  /// holds its value, so that it can be tried again. Real-time safe when moving a T is.
  bool try_push(T&& message) {
    if (!has_room()) return false;
    append(std::move(message));
    return true;
  }

  /// Pushing thread: appends a copy; false when the pipe is full. Real-time safe when copying a T is.
  bool try_push(const T& message) {
    if (!has_room()) return false;
    append(message);
    return true;
  }

  /// Popping thread: the oldest message, or nothing when the pipe is empty. Real-time safe when
  /// moving a T and destroying a moved-from T are.
  std::optional<T> try_pop() {
    if (!has_message()) return std::nullopt;
    const std::size_t index = popped_.load(std::memory_order_relaxed);
    std::optional<T>& slot = slot_of(index);
    std::optional<T> message(std::move(*slot));
    slot.reset();
    popped_.store(index + 1, std::memory_order_release);
    return message;
  }

 private:
  // Both counters only grow; their difference is the number of messages in the pipe. Each side keeps
  // the last value it saw of the other's counter, which saves most of the traffic between cores.
  bool has_room() {
    const std::size_t index = pushed_.load(std::memory_order_relaxed);
    if (index - popped_seen_ < capacity_) return true;
    popped_seen_ = popped_.load(std::memory_order_acquire);
    return index - popped_seen_ < capacity_;
  }

  bool has_message() {
    const std::size_t index = popped_.load(std::memory_order_relaxed);
    if (index != pushed_seen_) return true;
    pushed_seen_ = pushed_.load(std::memory_order_acquire);
    return index != pushed_seen_;
  }

  template <typename Message>
  void append(Message&& message) {
    const std::size_t index = pushed_.load(std::memory_order_relaxed);
    slot_of(index).emplace(std::forward<Message>(message));
    pushed_.store(index + 1, std::memory_order_release);
  }

  std::optional<T>& slot_of(std::size_t index) { return slots_[index & (slots_.size() - 1)]; }

  const std::size_t capacity_;
  std::vector<std::optional<T>> slots_;  // a power of two of them, so that counters may wrap around
  alignas(kCacheLine) std::atomic<std::size_t> pushed_ = 0;
  std::size_t popped_seen_ = 0;  // by the pushing thread
  alignas(kCacheLine) std::atomic<std::size_t> popped_ = 0;
  std::size_t pushed_seen_ = 0;  // by the popping thread
};

/// A full-duplex message pipe between two threads (thesis section 5.6.1): As flow from the first end
/// to the second, Bs flow back. It owns both directions and must outlive the use of its ends. One
/// thread uses the first end, one thread the second, and neither ever waits.
template <typename A, typename B>
class DuplexPipe {
 public:
  /// One side of the pipe; belongs to the DuplexPipe and is used by one thread.
  template <typename Out, typename In>
  class End {
   public:
    End(MessagePipe<Out>& out, MessagePipe<In>& in) : out_(out), in_(in) {}

    /// As MessagePipe::try_push. Real-time safe when moving an Out is.
    bool try_push(Out&& message) { return out_.try_push(std::move(message)); }
    /// As MessagePipe::try_push. Real-time safe when copying an Out is.
    bool try_push(const Out& message) { return out_.try_push(message); }
    /// As MessagePipe::try_pop. Real-time safe when moving an In is.
    std::optional<In> try_pop() { return in_.try_pop(); }

   private:
    MessagePipe<Out>& out_;
    MessagePipe<In>& in_;
  };

  /// Room for `capacity` messages each way, > 0.
  explicit DuplexPipe(std::size_t capacity) : forth_(capacity), back_(capacity) {}

  DuplexPipe(const DuplexPipe&) = delete;
  DuplexPipe& operator=(const DuplexPipe&) = delete;

  /// The end that pushes As and pops Bs.
  End<A, B>& first() { return first_; }
  /// The end that pushes Bs and pops As.
  End<B, A>& second() { return second_; }

 private:
  MessagePipe<A> forth_;
  MessagePipe<B> back_;
  End<A, B> first_{forth_, back_};
  End<B, A> second_{back_, forth_};
};

}  // namespace icome::realtime
