#pragma once
#include <algorithm>
#include <cstddef>
#include <string_view>

#include "base/result.h"
#include "io/patience.h"

namespace icome::io {

/// What a reading ends with that somebody has stopped.
inline base::Error interruption() { return {"interrupted"}; }

/// Goes along with who goes through bytes, tells how far that is and asks whether to go on. Refers to the
/// bytes and the patience.
class ByteWatch {
 public:
  /// Without patience (null) it lasts for ever.
  ByteWatch(std::string_view bytes, Patience* patience)
      : begin_(bytes.data()), end_(begin_ + bytes.size()), patience_(patience), next_(begin_) {
    plan_next(begin_);
  }

  /// False when the reading is to end. Cheap enough to ask for every word.
  bool lasts(const char* at) { return at < next_ || look(at); }

 private:
  static constexpr std::ptrdiff_t kPiece = 1 << 16;  // bytes; a millisecond or less

  void plan_next(const char* at) { next_ = at + std::min(kPiece, end_ - at); }
  bool look(const char* at) {
    if (patience_ == nullptr || at == end_) return true;
    plan_next(at);
    return patience_->lasts(double(at - begin_) / double(end_ - begin_));
  }

  const char* begin_;
  const char* end_;
  Patience* patience_;
  const char* next_;  // where the next look is due
};

}  // namespace icome::io
