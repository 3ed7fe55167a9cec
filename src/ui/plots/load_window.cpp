#include "ui/plots/load_window.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace icome::ui {

void LoadWindow::add(std::int64_t time, const LoadCounts& counts) {
  constexpr std::int64_t kApart = 200'000'000;  // ns: closer samples are not worth their memory
  if (!samples_.empty()) {
    const LoadCounts& before = samples_.back().counts;
    const bool grown = std::equal(before.begin(), before.end(), counts.begin(), std::less_equal<>());
    if (!grown || time < samples_.back().time) samples_.clear();
  }
  if (samples_.empty() || time - samples_.back().time >= kApart) samples_.push_back({time, counts});
  while (samples_.size() > 1 && samples_[1].time <= time - span_) samples_.pop_front();
  for (std::size_t i = 0; i < counts.size(); ++i) recent_[i] = counts[i] - samples_.front().counts[i];
  ticks_ = std::accumulate(recent_.begin(), recent_.end(), std::uint64_t{0});
}

std::optional<double> LoadWindow::quantile(double share) const {
  if (ticks_ == 0) return std::nullopt;
  const double wanted = std::max(1.0, std::ceil(share * double(ticks_)));
  double seen = 0.0;
  for (std::size_t i = 0; i + 1 < recent_.size(); ++i) {
    seen += double(recent_[i]);
    if (seen >= wanted) return double(i) + 0.5;
  }
  return double(recent_.size() - 1);
}

}  // namespace icome::ui
