#include "devices/trace_head.h"

#include <utility>

#include "io/file_bytes.h"

namespace icome::devices {

base::Result<TraceHead> TraceHead::create(const std::string& path, std::function<std::int64_t()> clock) {
  constexpr std::uint64_t kLongest = 1ULL << 30U;  // bytes
  const auto text = io::read_bytes(path, kLongest);
  if (!text) return tl::unexpected(text.error());
  auto samples = read_head_trace(*text, path);
  if (!samples) return tl::unexpected(samples.error());
  return TraceHead(path, std::move(*samples), std::move(clock));
}

TraceHead::TraceHead(std::string name, std::vector<HeadSample> samples, std::function<std::int64_t()> clock)
    : name_(std::move(name)), samples_(std::move(samples)), clock_(std::move(clock)) {}

DeviceStatus TraceHead::read(Pose& user_from_head) {
  const std::int64_t now = clock_();
  if (!std::exchange(has_begun_, true)) begin_ = now;
  const double time = samples_.front().time + 1e-9 * double(now - begin_);
  while (at_ + 1 < samples_.size() && samples_[at_ + 1].time <= time) ++at_;
  user_from_head = samples_.front().tracker_from_head.inverse() * samples_[at_].tracker_from_head;
  return DeviceStatus::Ok;
}

}  // namespace icome::devices
