#pragma once
#include <atomic>
#include <cstdint>
#include <limits>

namespace icome::world {

/// A budget of work for an answer, counted and not timed, so that the same question gets the same
/// answer on any machine. One unit is about the work for two triangles, some 100 ns. One thread uses
/// it.
class Effort {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  /// `given_up`: set by another thread that does not want the answer any more; may be null, and must
  /// outlive this object.
  explicit Effort(std::uint64_t most, const std::atomic<bool>* given_up = nullptr)
      : most_(most), left_(most), given_up_(given_up) {}

  /// False when none is left: the results of the query are then worthless.
  bool spend(std::uint64_t units = 1) {
    if (given_up_ && given_up_->load(std::memory_order_relaxed)) left_ = 0;
    if (units >= left_) {
      left_ = 0;
    } else {
      left_ -= units;
    }
    return left_ > 0;
  }
  bool is_spent() const { return left_ == 0; }
  std::uint64_t spent() const { return most_ - left_; }

 private:
  std::uint64_t most_, left_;
  const std::atomic<bool>* given_up_;
};

}  // namespace icome::world
