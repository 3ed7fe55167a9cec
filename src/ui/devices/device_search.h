#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/catalogue.h"
#include "session/background_task.h"
#include "session/hands/pointer_connection.h"

namespace icome::ui {

/// The ways to devices, which may all take seconds and are called by threads of their own.
struct DeviceWays {
  std::function<std::vector<devices::DeviceEntry>()> list = devices::list_devices;
  std::function<base::Result<session::PointerConnection>(const std::string&)> open = session::open_connection;
};

/// Looks for devices and opens them on threads of its own; is asked now and then what has come of it. Ends
/// once all of these threads have.
class DeviceSearch {
 public:
  explicit DeviceSearch(DeviceWays ways) : ways_(std::move(ways)) {}

  /// Begins to look for devices, unless that is under way.
  void look();
  bool looks() const { return looking_ != nullptr; }
  /// The devices that were found, when a search has ended since the last call; null otherwise. A search that
  /// failed gives its reason.
  std::unique_ptr<base::Result<std::vector<devices::DeviceEntry>>> take_found();

  /// Begins to open a device, unless that is under way.
  void open(const std::string& address);
  bool is_opening(const std::string& address) const;
  bool is_opening() const { return !opening_.empty(); }
  /// A device that was opened, or could not be.
  struct Opened {
    std::string address;
    base::Result<session::PointerConnection> connection;
  };
  std::vector<Opened> take_opened();

 private:
  struct Opening {
    std::string address;
    std::unique_ptr<session::BackgroundTask<session::PointerConnection>> task;
  };
  DeviceWays ways_;
  std::unique_ptr<session::BackgroundTask<std::vector<devices::DeviceEntry>>> looking_;
  std::vector<Opening> opening_;
};

}  // namespace icome::ui
