#include "session/follower.h"

#include <pthread.h>

#include <cassert>
#include <utility>

namespace icome::session {

Follower::Follower(EditedQueue& queue, std::unique_ptr<Representation> representation, std::string name)
    : reader_(queue.add_reader()), representation_(std::move(representation)) {
  thread_ = std::thread([this, name = std::move(name)] { run(name); });
}

Follower::~Follower() { thread_.join(); }

void Follower::run(const std::string& name) {
  constexpr std::size_t kLongestName = 15;
  pthread_setname_np(pthread_self(), name.substr(0, kLongestName).c_str());
  while (reader_.wait() && !given_up_.load(std::memory_order_relaxed)) {
    take_all();
    bring_up_to_date();
    rounds_.store(rounds_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    followed_.store(taken_, std::memory_order_release);
  }
}

void Follower::take_all() {
  // Who edits without a pause shall see something in between.
  constexpr int kMostAtOnce = 4096;
  for (int i = 0; i < kMostAtOnce; ++i) {
    auto edited = reader_.take();
    if (!edited) return;
    take(*edited);
  }
}

void Follower::take(Edited& edited) {
  taken_ = edited.number;
  if (edited.whole) {
    whole_ = std::move(edited.whole);
    edits_.clear();
    shown_ = {};
    replica_ = *whole_;
  }
  if (edited.for_replicas) {
    // Held until the representation has followed: names of what has changed are read off them.
    edits_.push_back(std::move(edited.for_replicas));
    [[maybe_unused]] const auto done = world::apply(replica_, *edits_.back());
    assert(done);  // main has done the same
  }
  if (edited.shown) {
    shown_ = *edited.shown;
    other_scene_ = true;
  }
}

void Follower::bring_up_to_date() {
  if (whole_) {
    representation_->open(replica_, shown_);
  } else {
    std::vector<const world::Edit*> edits;
    for (const auto& edit : edits_) edits.push_back(edit.get());
    if (!edits.empty()) representation_->follow(replica_, world::changes_of(edits));
    if (other_scene_) representation_->show(replica_, shown_);
  }
  whole_.reset();
  edits_.clear();
  other_scene_ = false;
}

}  // namespace icome::session
