#pragma once
#include <string>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that tells where the user's head is, so that looking around moves no pointer (thesis 5.6.3,
/// 5.7.1). Back-ends derive from it; whoever created the device owns it, and one thread (main) calls read().
class HeadDevice {
 public:
  virtual ~HeadDevice() = default;
  virtual const std::string& name() const = 0;
  /// Where the head is (m): between the eyes, looking along -z, y up, with respect to where the user sits
  /// when looking straight ahead. `user_from_head` keeps its old value unless Ok is returned. Never waits.
  virtual DeviceStatus read(Pose& user_from_head) = 0;
};

}  // namespace icome::devices
