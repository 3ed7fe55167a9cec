#pragma once
#include <string>

#include "base/result.h"

namespace icome::devices {

/// The use of one device by this program, however it was addressed: two that are opened at once never drive
/// the same one, as their forces would fight. It lasts as long as this object.
class DeviceClaim {
 public:
  DeviceClaim() = default;
  /// Claims the device of that identity (Driver::identity()). The error names it, for people. Any thread.
  static base::Result<DeviceClaim> of(const std::string& identity);
  /// Is the device of that identity claimed? Any thread.
  static bool is_taken(const std::string& identity);
  DeviceClaim(DeviceClaim&& other) noexcept;
  DeviceClaim& operator=(DeviceClaim&& other) noexcept;
  ~DeviceClaim();
  explicit operator bool() const { return !identity_.empty(); }

 private:
  std::string identity_;
};

/// The error of a device that is claimed already, for people.
std::string in_use_text(const std::string& identity);

}  // namespace icome::devices
