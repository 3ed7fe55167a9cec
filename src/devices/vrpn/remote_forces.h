#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "devices/pointer_device.h"
#include "devices/vrpn/protocol.h"

namespace icome::devices::vrpn {

constexpr std::size_t kMostClients = 16;
constexpr std::size_t kPlanes = 4;  // of one client

/// The forces that one client wants to be felt.
struct ClientForces {
  struct PlaneSlot {
    Plane plane;                 // normal of length 1, or zero: none; SI units; all finite
    std::uint64_t revision = 0;  // changes with each plane that the client sent
  };
  std::uint64_t client = 0;  // a number that no other client of the server has or had; 0: none
  std::array<PlaneSlot, kPlanes> planes;
  ForceField field;  // radius 0: none; all finite
};

/// The forces that all clients want to be felt on one device.
struct WantedForces {
  std::array<ClientForces, kMostClients> clients;
};

/// Bounds of what clients may ask for.
struct RemoteForceSettings {
  double spring_unit = 1000.0;    // N/m for a spring constant of 1, and N s/m for a damping of 1
  double max_stiffness = 3000.0;  // N/m
  double max_damping = 10.0;      // N s/m
  double deepest = 0.01;          // m, see RemoteForces
  double max_force = 50.0;        // N, of a field at its origin
};

/// Makes sense of a plane: SI units, a normal of length 1, and within the bounds; false: refused.
bool tidy(Plane& plane, const RemoteForceSettings& settings);
bool tidy(ForceField& field, const RemoteForceSettings& settings);

/// The force of planes and fields on a tip. A plane pushes out of its back, never pulls, and comes to its
/// place within its recovery cycles: one that is new begins at the tip, one that changes begins at its last
/// place. One that is new with the tip deeper behind it than `deepest` is no wall for it until the tip has
/// been in front. All planes are new to a tip that jumped, and a client's to the planes of one that had its
/// slot before. A field's force changes at once; the limiter behind this bounds its rate. One thread.
class RemoteForces {
 public:
  explicit RemoteForces(const RemoteForceSettings& settings = {}) : settings_(settings) {}

  /// The force on a tip in this state, N, at a time (ns, steady). Real-time safe.
  Vector3 force(const WantedForces& wanted, const PointerState& state, std::int64_t now);

 private:
  struct Wall {
    std::uint64_t revision = 0;
    bool there = false;
    bool behind = false;  // the tip came from its back
    Plane from;           // the plane as it began to change
    Plane to;
    std::int64_t changed = 0;  // ns
  };
  Vector3 push(Wall& wall, const ClientForces::PlaneSlot& slot, const PointerState& state, std::int64_t now);
  void change(Wall& wall, const Plane& last, const Plane& next, const PointerState& state, std::int64_t now);

  struct Client {
    std::uint64_t number = 0;
    std::array<Wall, kPlanes> walls;
  };
  RemoteForceSettings settings_;
  std::array<Client, kMostClients> clients_;
};

}  // namespace icome::devices::vrpn
