#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "devices/head_device.h"
#include "devices/head_trace.h"

namespace icome::devices {

/// A head tracker that replays a recorded motion by the clock, from its first reading on; the first pose is
/// straight ahead, and after the last one the head stays there. One thread uses it.
class TraceHead final : public HeadDevice {
 public:
  /// Reads the file of a trace (head_trace.h). The error names file and line. `clock` gives nanoseconds.
  static base::Result<TraceHead> create(const std::string& path, std::function<std::int64_t()> clock);
  /// Precondition: there are samples.
  TraceHead(std::string name, std::vector<HeadSample> samples, std::function<std::int64_t()> clock);

  const std::string& name() const override { return name_; }
  DeviceStatus read(Pose& user_from_head) override;

 private:
  std::string name_;
  std::vector<HeadSample> samples_;
  std::function<std::int64_t()> clock_;
  std::int64_t begin_ = 0;  // ns, of the first reading
  bool has_begun_ = false;
  std::size_t at_ = 0;  // the sample of now
};

}  // namespace icome::devices
