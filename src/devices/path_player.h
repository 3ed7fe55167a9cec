#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that replays tip positions from a file, one row a read, without a wall clock: the same file
/// gives the same ticks on every machine, as fast as the machine can. Forces are accepted and ignored.
class PathPlayer final : public PointerDevice {
 public:
  /// Reads a file whose first line is `t,x,y,z` and whose rows are seconds and metres, t increasing. A fifth
  /// column, `b`, is the first button: 1 down, 0 up.
  /// `info` is passed on to the limiter and the display, under the name of the file. The error names
  /// file and line.
  static base::Result<PathPlayer> create(const std::string& path, DeviceInfo info = {});

  /// As create(), from text in memory; `name` stands for the file in errors.
  static base::Result<PathPlayer> parse(std::string_view text, const std::string& name, DeviceInfo info = {});

  /// Puts rows on the straight ways between those that are more than `most` (s, > 0) apart, and begins anew.
  /// The button stays as it was until the next row of the file. Fails where there would be over ten million
  /// rows.
  base::Result<void> fill_in(double most);

  const DeviceInfo& info() const override { return info_; }
  /// The next row and its velocity (backward difference, zero in the first row); Stalled after the last.
  /// Real-time safe.
  DeviceStatus read(PointerState& state) override;
  /// Ignores the force and returns Ok: a path does not yield. Real-time safe.
  DeviceStatus write(const Vector3& force) override;

  /// Has every row been read? Real-time safe.
  bool finished() const { return next_ == times_.size(); }
  /// Time of the row that read() gave last, s; of the first row before that. Real-time safe.
  double time() const { return times_[next_ == 0 ? 0 : next_ - 1]; }
  /// Time of each row, s; at least one.
  const std::vector<double>& times() const { return times_; }
  /// Position in each row, m.
  const std::vector<Vector3>& positions() const { return positions_; }
  /// Has the file the button's column?
  bool has_button() const { return !buttons_.empty(); }

 private:
  PathPlayer() = default;

  DeviceInfo info_;
  std::vector<double> times_;       // s
  std::vector<Vector3> positions_;  // m
  std::vector<bool> buttons_;       // empty: the button is never down
  std::size_t next_ = 0;            // row of the next read
};

}  // namespace icome::devices
