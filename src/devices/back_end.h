#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// A device that a back-end could drive, there or not.
struct DeviceEntry {
  std::string name;     // the address that opens it, such as "haply:049D"; its back-end's when absent
  std::string family;   // "pointer", "navigation" or "head"
  std::string backend;  // BackEnd::name
  bool present = false;
  std::string
      why;  // absent: what is missing and what to do, in a sentence or two; present: what it is, or empty
  std::string identity{};  // Driver::identity() of the device once it is open; empty: not known
};

/// One way to devices, such as a maker's library.
struct BackEnd {
  std::string_view name;    // for people and JSON, such as "openhaptics"
  std::string_view prefix;  // of the addresses it opens: "hd" in "hd:Left"
  /// The devices there are and, where there are none, one entry that says why. May take a second.
  std::vector<DeviceEntry> (*list)() = nullptr;
  /// Opens the pointer device of an address without its prefix and colon; empty: the first there is. Null for
  /// back-ends without pointer devices. May take seconds.
  base::Result<std::unique_ptr<PointerDevice>> (*open)(std::string_view address) = nullptr;
};

}  // namespace icome::devices
