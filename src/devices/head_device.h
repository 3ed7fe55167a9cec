#pragma once
#include <string>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that reports the pose of the user's head, so that looking around moves no pointer (thesis 5.6.3,
/// 5.7.1). Back-ends derive from it; its creator owns it, and one thread (main) calls read().
class HeadDevice {
 public:
  virtual ~HeadDevice() = default;
  virtual const std::string& name() const = 0;
  /// Reads the pose of the head (m; origin between the eyes, looking along -z, y up) relative to its pose for
  /// a look straight ahead. `user_from_head` keeps its old value unless Ok is returned. Never waits.
  virtual DeviceStatus read(Pose& user_from_head) = 0;
  /// After Lost: what is wrong and what to do, in a sentence; empty where nothing is known.
  virtual std::string why_lost() const { return {}; }
};

}  // namespace icome::devices
