#include "session/edited_queue.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "world/edit/edit_memory.h"

namespace icome::session {
namespace {

std::uint64_t memory_of_edits(const Edited& edited) {
  std::uint64_t bytes = edited.edit ? world::memory_of(*edited.edit) : 0;
  if (edited.for_replicas && edited.for_replicas != edited.edit)
    bytes += world::memory_of(*edited.for_replicas);
  return bytes;
}

}  // namespace

bool EditedQueue::Reader::wait() {
  for (;;) {
    // Read before looking: kept posts are the reader's once the queue is closed.
    const bool closed = closed_.load(std::memory_order_acquire);
    if (look()) return true;
    if (closed) return false;
    news_.acquire();
    // One look finds everything, however often it was signalled.
    while (news_.try_acquire()) {
    }
  }
}

bool EditedQueue::Reader::wait_for(std::chrono::nanoseconds longest) {
  const bool closed = closed_.load(std::memory_order_acquire);
  if (look()) return true;
  if (closed) return false;
  (void)news_.try_acquire_for(longest);
  return true;
}

std::optional<Edited> EditedQueue::Reader::take() {
  if (!look()) return std::nullopt;
  taken_bytes_.fetch_add(next_->bytes, std::memory_order_relaxed);
  return std::exchange(next_, std::nullopt);
}

/// Is there something to take?
bool EditedQueue::Reader::look() {
  if (next_) return true;
  const bool closed = closed_.load(std::memory_order_acquire);
  next_ = pipe_.try_pop();
  if (!next_ && closed && !kept_.empty()) {
    next_ = std::move(kept_.front());
    kept_.pop_front();
  }
  return next_.has_value();
}

/// Moves kept posts into the pipe as far as there is room. The posting thread calls it.
void EditedQueue::Reader::hand_on() {
  bool some = false;
  while (!kept_.empty() && pipe_.try_push(std::move(kept_.front()))) {
    kept_.pop_front();
    some = true;
  }
  if (some) news_.release();
}

EditedQueue::Reader& EditedQueue::add_reader() {
  assert(posted_ == 0 && !closed_);
  return *readers_.emplace_back(std::make_unique<Reader>());
}

bool EditedQueue::has_room() const {
  return std::all_of(readers_.begin(), readers_.end(), [this](const auto& reader) {
    return posted_bytes_ - reader->taken_bytes_.load(std::memory_order_relaxed) <= most_bytes_;
  });
}

std::uint64_t EditedQueue::post(Edited edited) {
  assert(!closed_);
  edited.number = ++posted_;
  edited.bytes = memory_of_edits(edited);
  posted_bytes_ += edited.bytes;
  for (const auto& reader : readers_) {
    reader->kept_.push_back(edited);
    reader->hand_on();
  }
  return posted_;
}

void EditedQueue::pump() {
  if (closed_) return;
  for (const auto& reader : readers_) reader->hand_on();
}

void EditedQueue::close() {
  if (std::exchange(closed_, true)) return;
  for (const auto& reader : readers_) {
    reader->hand_on();
    reader->closed_.store(true, std::memory_order_release);
    reader->news_.release();
  }
}

}  // namespace icome::session
