#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"
#include "devices/vrpn/vrpn_server.h"
#include "haptics/servo/force_limiter.h"
#include "realtime/loop.h"

namespace icome::session {

/// Shares pointer devices with programs that speak VRPN: a loop reads each, gives the forces that programs
/// ask for through the limiter, and tells them its state. Owns devices, server and loop.
class DeviceSharing {
 public:
  /// Starts server and loop. The server has a name for each device. Fails where it cannot listen or the loop
  /// cannot start.
  static base::Result<std::unique_ptr<DeviceSharing>> create(
      std::vector<std::unique_ptr<devices::PointerDevice>> devices, const devices::VrpnServerSettings& server,
      double rate_hz);
  /// Ends the loop, takes all forces away and says farewell to the programs.
  ~DeviceSharing();

  const devices::VrpnServer& server() const { return *server_; }
  std::size_t devices() const { return shared_.size(); }
  const devices::PointerDevice& device(std::size_t index) const { return *shared_[index]->device; }
  /// Was the device away in the newest tick? Any thread.
  bool is_lost(std::size_t index) const { return shared_[index]->is_lost.load(std::memory_order_relaxed); }

 private:
  struct Shared {
    std::unique_ptr<devices::PointerDevice> device;
    haptics::ForceLimiter limiter;
    devices::PointerState state = {};
    bool has_state = false;
    std::atomic<bool> is_lost = false;
  };
  DeviceSharing() = default;
  bool tick(const realtime::TickInfo& info);
  void share(std::size_t index, double dt);

  std::vector<std::unique_ptr<Shared>> shared_;
  std::unique_ptr<devices::VrpnServer> server_;
  std::unique_ptr<realtime::LoopRunner> loop_;  // last: it uses the others
};

}  // namespace icome::session
