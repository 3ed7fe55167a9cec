#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/result.h"
#include "devices/vrpn/remote_forces.h"
#include "devices/vrpn/served_client.h"
#include "devices/vrpn/vrpn_socket.h"
#include "realtime/latest_value.h"

namespace icome::devices {

struct VrpnServerSettings {
  std::string host = "127.0.0.1";                 // name or address of the interface that clients come by
  int port = 3883;                                // of TCP and UDP; 0: a free one
  std::vector<std::string> names = {"Pointer0"};  // of the devices, 1 to 8
};

/// Shares devices with programs that speak VRPN, 1000 states a second at most: each as a vrpn_Tracker,
/// vrpn_Button and vrpn_ForceDevice of one name. Clients come by TCP, or ask by UDP to be connected to, and
/// there are 16 at most; a slow, silent or hostile one delays neither the others nor the device. Owns its
/// thread and sockets.
///
/// The forces that clients ask for (planes and force fields) are rendered here, for the caller to add to its
/// own and to limit. They last as long as the client does: the forces of one that is gone or hangs end (see
/// vrpn::ServedClient).
class VrpnServer {
 public:
  /// Listens from here on. May take seconds to look the host up; the error says what is in the way.
  static base::Result<std::unique_ptr<VrpnServer>> create(const VrpnServerSettings& settings);
  ~VrpnServer() { stop(); }

  /// The place where it listens: "127.0.0.1:3883".
  std::string listening() const { return vrpn::shown(place_); }
  const std::vector<std::string>& names() const { return names_; }

  /// Takes the state of a device (by its place among the names), and the force that it gives, N. One thread a
  /// device, that of its servo. Real-time safe.
  void feed(const PointerState& state, const Vector3& force, std::size_t device = 0);
  /// The force that clients want on a device in this state, N, not limited; `now` is of
  /// base::steady_nanoseconds. The same thread. Real-time safe.
  Vector3 wanted_force(const PointerState& state, std::int64_t now, std::size_t device = 0);

  /// Says farewell to the clients and closes; then there is no wanted force. May be called again. Not the
  /// servo's.
  void stop();

 private:
  struct Device {
    realtime::LatestValue<vrpn::SharedState> states;
    realtime::LatestValue<vrpn::WantedForces> wanted;
    vrpn::RemoteForces forces;  // the servo's
  };

  explicit VrpnServer(const VrpnServerSettings& settings);
  base::Result<void> listen(const VrpnServerSettings& settings);
  void run();
  void wait();
  void answer_requests(std::int64_t now);
  void accept_clients(std::int64_t now);
  void add(vrpn::Socket socket, const vrpn::Place& place, bool connecting, std::int64_t now);
  bool may_call(const vrpn::Place& place) const;
  void serve(std::int64_t now);
  void share(std::int64_t now);
  void publish_wishes();

  std::vector<std::string> names_;
  vrpn::Place place_;
  vrpn::Socket listener_;
  vrpn::Socket requests_;
  std::vector<std::unique_ptr<Device>> states_;
  // The server's thread's. A client keeps its place as long as it is there.
  std::vector<std::unique_ptr<vrpn::ServedClient>> clients_;
  std::int64_t due_ = 0;  // ns, of the next states
  std::uint64_t clients_so_far_ = 0;
  std::int64_t full_until_ = 0;  // ns; until then the system has no room for new clients
  bool wishes_changed_ = false;
  bool flooded_ = false;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace icome::devices
