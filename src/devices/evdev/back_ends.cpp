#include "devices/evdev/back_ends.h"

#include <string>
#include <utility>

#include "devices/evdev/gamepad.h"
#include "devices/evdev/input_driver.h"
#include "devices/evdev/linux_inputs.h"
#include "devices/evdev/mouse.h"
#include "devices/evdev/tablet.h"

namespace icome::devices {
namespace {

template <typename Reader, typename Settings>
base::Result<std::unique_ptr<InputReader>> reader_with(const base::Result<Settings>& settings) {
  if (!settings) return tl::unexpected(settings.error());
  return std::make_unique<Reader>(*settings);
}

base::Result<std::unique_ptr<InputReader>> reader_of(InputKind kind) {
  switch (kind) {
    case InputKind::Tablet:
      return reader_with<Tablet>(tablet_settings_from_environment());
    case InputKind::Mouse:
      return reader_with<Mouse>(mouse_settings_from_environment());
    case InputKind::Gamepad:
      break;
  }
  return reader_with<GamepadPointer>(gamepad_settings_from_environment());
}

template <InputKind Kind>
base::Result<std::unique_ptr<PointerDevice>> open_kind(std::string_view address) {
  auto device = open_input_pointer(linux_inputs(), Kind, address);
  if (!device) return tl::unexpected(device.error());
  return std::move(*device);
}

template <InputKind Kind>
std::vector<DeviceEntry> list_kind() {
  const std::string backend(kind_name(Kind));
  if (const auto reader = reader_of(Kind); !reader)
    return {{backend, "pointer", backend, false, reader.error().message}};
  const std::shared_ptr<InputSystem> system = linux_inputs();
  std::vector<DeviceEntry> entries = list_inputs(*system, Kind, "pointer");
  if (Kind != InputKind::Gamepad) return entries;
  for (DeviceEntry& entry : list_inputs(*system, Kind, "navigation")) entries.push_back(std::move(entry));
  return entries;
}

}  // namespace

constinit const BackEnd kTabletBackEnd = {"tablet", "tablet", list_kind<InputKind::Tablet>,
                                          open_kind<InputKind::Tablet>};
constinit const BackEnd kMouseBackEnd = {"mouse", "mouse", list_kind<InputKind::Mouse>,
                                         open_kind<InputKind::Mouse>};
constinit const BackEnd kGamepadBackEnd = {"gamepad", "gamepad", list_kind<InputKind::Gamepad>,
                                           open_kind<InputKind::Gamepad>};

base::Result<std::unique_ptr<DrivenDevice>> open_input_pointer(std::shared_ptr<InputSystem> system,
                                                               InputKind kind, std::string_view address,
                                                               const DrivenSettings& driven) {
  auto reader = reader_of(kind);
  if (!reader) return tl::unexpected(reader.error());
  return DrivenDevice::create(
      std::make_unique<InputDriver>(std::move(system), kind, std::string(address), std::move(*reader)),
      driven);
}

}  // namespace icome::devices
