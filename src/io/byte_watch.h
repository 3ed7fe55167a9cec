#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

#include "base/result.h"
#include "io/time_budget.h"

namespace icome::io {

/// The error that ends an interrupted reading.
inline base::Error interruption() { return {"interrupted"}; }

/// Follows a reader through its bytes, reports its progress and asks whether to go on. Refers to the
/// bytes and the time budget.
class ByteWatch {
 public:
  /// Without a time budget (null) it lasts for ever.
  ByteWatch(std::string_view bytes, TimeBudget* time_budget)
      : begin_(bytes.data()), end_(begin_ + bytes.size()), time_budget_(time_budget), next_(begin_) {
    plan_next(begin_);
  }

  /// False when the reading is to end. Cheap enough to ask for every word.
  bool lasts(const char* at) { return at < next_ || look(at); }

 private:
  static constexpr std::ptrdiff_t kPiece = 1 << 16;  // bytes; a millisecond or less

  void plan_next(const char* at) { next_ = at + std::min(kPiece, end_ - at); }
  bool look(const char* at) {
    if (time_budget_ == nullptr || at == end_) return true;
    plan_next(at);
    return time_budget_->lasts(double(at - begin_) / double(end_ - begin_));
  }

  const char* begin_;
  const char* end_;
  TimeBudget* time_budget_;
  const char* next_;  // where the next look is due
};

}  // namespace icome::io
