#include "apps/touch/tick_log.h"

#include <algorithm>
#include <limits>

namespace icome::apps {
namespace {

// More than a picture can show; at 1 kHz a run of 17 minutes.
constexpr std::size_t kMostSamples = 1 << 20;

std::uint32_t saturated(std::int64_t nanoseconds) {
  constexpr std::int64_t kLongest = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(nanoseconds, std::int64_t{0}, kLongest));
}

}  // namespace

void TickLog::add(const TickRow& row) {
  if (trace_ != nullptr) trace_->add(row);
  if (judge_ != nullptr) {
    haptics::JudgedTick tick{row.tip, row.scp, row.touching(), row.moment};
    if (forces_of_surfaces_) tick.force = row.force;
    judge_->judge(tick);
  }
  if (keep_samples_) keep_sample(row);
  tick_ns_.push_back(saturated(row.own_ns));
  touching_ += row.touching() ? 1 : 0;
  max_force_ = std::max(max_force_, row.force.norm());
}

void TickLog::keep_sample(const TickRow& row) {
  if (tick_ns_.size() % stride_ != 0) return;
  samples_.push_back({row.t, row.tip, row.scp, row.force, row.touching()});
  if (samples_.size() < kMostSamples) return;
  for (std::size_t i = 0; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
  samples_.resize(samples_.size() / 2);
  stride_ *= 2;
}

}  // namespace icome::apps
