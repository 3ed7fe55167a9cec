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
  double dead = 10.0;    // counts about rest that are none, usually 2 to 30; < range
  bool wait = false;     // there need not be one yet: it is looked for now and then
  double retry = 2.0;    // s, between two looks for one that is not there
};

/// A 3D mouse of 3Dconnexion and its like, through spacenavd, the driver that Linux has for them. Lost while
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
  bool plugged_ = true;         // as far as spacenavd has said
  NavigationState state_;
};

}  // namespace icome::devices
