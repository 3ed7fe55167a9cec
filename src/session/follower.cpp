#include "session/follower.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>
#include <utility>

namespace icome::session {

Follower::Follower(EditedQueue& queue, std::unique_ptr<Representation> representation, std::string name)
    : name_(std::move(name)), reader_(queue.add_reader()), representation_(std::move(representation)) {
  thread_ = std::thread([this] { run(); });
}

Follower::~Follower() { thread_.join(); }

void Follower::run() {
  constexpr std::size_t kLongestName = 15;
  pthread_setname_np(pthread_self(), name_.substr(0, kLongestName).c_str());
  while (wait() && !given_up_.load(std::memory_order_relaxed)) {
    try {
      take_all();
      bring_up_to_date();
      if (!lost_) representation_->go_on(replica_);
      if (!lost_) note("");
    } catch (const std::exception& error) {
      note(error.what());
    } catch (...) {
      note("for no known reason");
    }
    // The edits are in the replica, which is opened anew where they could not be followed.
    whole_.reset();
    edits_.clear();
    other_scene_ = other_play_ = false;
    rounds_.store(rounds_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    followed_.store(taken_, std::memory_order_release);
  }
}

/// Waits for posts, or until the representation goes on by itself; false when there will be no more.
bool Follower::wait() {
  const auto pause = lost_ || half_way_ ? std::nullopt : representation_->pause(replica_);
  return pause ? reader_.wait_for(*pause) : reader_.wait();
}

void Follower::take_all() {
  // Caps the batch, so that continuous edits are still shown in between.
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
    played_since_.reset();
    lost_ = true;  // until it is there
    replica_ = *whole_;
    lost_ = false;
  }
  if (edited.for_replicas && !lost_) {
    // Edits are held until the representation has followed: names of changed things are read off them.
    lost_ = true;
    edits_.push_back(std::move(edited.for_replicas));
    [[maybe_unused]] const auto done = world::apply(replica_, *edits_.back());
    assert(done);  // main has done the same
    lost_ = false;
  }
  if (edited.shown) {
    shown_ = *edited.shown;
    other_scene_ = true;
  }
  if (edited.play) {
    played_since_ = edited.play->since;
    other_play_ = true;
  }
}

void Follower::bring_up_to_date() {
  if (lost_) return;
  const bool anew = whole_ || half_way_;
  half_way_ = true;  // until it is there
  if (anew) {
    representation_->open(replica_, shown_);
    if (played_since_) representation_->play(replica_, played_since_);
  } else {
    std::vector<const world::Edit*> edits;
    for (const auto& edit : edits_) edits.push_back(edit.get());
    if (!edits.empty()) representation_->follow(replica_, world::changes_of(edits));
    if (other_scene_) representation_->show(replica_, shown_);
    if (other_play_) representation_->play(replica_, played_since_);
  }
  half_way_ = false;
}

void Follower::note(const char* why) {
  const bool troubled = *why != '\0';
  if (troubled == troubled_) return;
  troubled_ = troubled;
  Trouble& trouble = trouble_.write_slot();
  trouble.fill('\0');
  std::copy_n(why, std::min(std::strlen(why), trouble.size() - 1), trouble.begin());
  trouble_.publish();
}

std::optional<std::string> Follower::news() {
  if (!trouble_.update()) return std::nullopt;
  const std::string why = trouble_.read().data();
  if (troubled_told_ == !why.empty()) return std::nullopt;
  troubled_told_ = !why.empty();
  if (why.empty()) return fmt::format("The {} follows the design again.", name_);
  return fmt::format(
      "The {} has fallen behind the design, as it could not be made ({}). It is made anew with your next "
      "edit; "
      "where that does not help, save your work, close other programs and open it again.",
      name_, why);
}

}  // namespace icome::session
