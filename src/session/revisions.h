#pragma once
#include <cstdint>
#include <utility>
#include <vector>

namespace icome::session {

/// Numbers the states of a world with a history, so that a world that was undone back to its saved state is
/// not modified. To be told of everything that is done to the history.
class Revisions {
 public:
  void performed() {
    undone_.clear();
    done_.push_back(++last_);
  }
  /// An action is tried out, and taken back when nothing else has been done since.
  void tried() {
    aside_ = std::exchange(undone_, {});
    done_.push_back(++last_);
  }
  void took_back() {
    done_.pop_back();
    undone_ = std::exchange(aside_, {});
  }
  void extended() { done_.back() = ++last_; }
  void undid() {
    undone_.push_back(done_.back());
    done_.pop_back();
  }
  void redid() {
    done_.push_back(undone_.back());
    undone_.pop_back();
  }

  /// The number of the present state, another one in each, also of other histories.
  std::uint64_t now() const { return done_.empty() ? first_ : done_.back(); }
  /// Begins anew, with another world.
  void restart() {
    done_.clear();
    undone_.clear();
    first_ = ++last_;
  }

 private:
  std::uint64_t last_ = 0;   // given
  std::uint64_t first_ = 0;  // before anything was done
  std::vector<std::uint64_t> done_, undone_;
  std::vector<std::uint64_t> aside_;  // undone when something was tried out
};

}  // namespace icome::session
