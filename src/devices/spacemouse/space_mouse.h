#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "devices/navigation_device.h"

namespace icome::devices {

class SpnavLink;

struct SpaceMouseSettings {
  double range = 350.0;  // counts at full deflection, usually 250 to 500
  double dead = 10.0;    // counts, dead zone about rest, usually 2 to 30; < range
  bool wait = false;     // create() succeeds without one and looks for it now and then
  double retry = 2.0;    // s, between two searches for a missing one
};

/// A 3D mouse of 3Dconnexion or a compatible one, through spacenavd, its driver on Linux. Lost while
/// spacenavd does not run or the mouse is unplugged; goes on by itself when they are back. A program has one
/// at most.
class SpaceMouse final : public NavigationDevice {
 public:
  /// Connects, which may take some tenths of a second. Fails when spacenavd does not run, unless the
  /// settings say to wait, or when there is another SpaceMouse.
  static base::Result<std::unique_ptr<SpaceMouse>> create(const SpaceMouseSettings& settings = {});
  ~SpaceMouse() override;

  const std::string& name() const override { return name_; }
  DeviceStatus read(NavigationState& state) override;

 private:
  SpaceMouse(std::unique_ptr<SpnavLink> link, const SpaceMouseSettings& settings);
  void look_for_it();
  void take_in();
  double axis(int counts) const;

  std::string name_ = "3D mouse";
  std::unique_ptr<SpnavLink> link_;  // never null
  SpaceMouseSettings settings_;
  std::int64_t next_look_ = 0;  // ns, steady clock
  bool plugged_ = true;         // as far as spacenavd has reported
  NavigationState state_;
};

}  // namespace icome::devices
