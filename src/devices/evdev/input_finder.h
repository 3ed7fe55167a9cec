#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "devices/back_end.h"
#include "devices/driver/device_claim.h"
#include "devices/evdev/input_node.h"

namespace icome::devices {

enum class InputKind : std::uint8_t { Tablet, Mouse, Gamepad };

/// "tablet", "mouse" or "gamepad": back-end, prefix of addresses, and the word for people.
std::string_view kind_name(InputKind kind);

/// Judges a device by its abilities, as udev does: a tablet has a pen, a mouse moves relatively and has a
/// left button, a gamepad or joystick has its own kind of buttons; tablets and gamepads have axes x and y.
bool is_of_kind(const InputAbilities& abilities, InputKind kind);

/// A device's name in UTF-8 and without control characters; "unnamed" without one.
std::string shown_name(const InputAbilities& abilities);

/// A sentence that tells people how to be permitted to use devices of that kind.
std::string permission_advice(InputKind kind);

struct FoundInput {
  DeviceClaim claim;
  std::unique_ptr<InputNode> node;  // never null
};

/// Opens the device of an address: a path ("/dev/input/event5"), a name or a part of one, upper and lower
/// case alike, or "" for the first there is. Nodes that this program uses already are passed over. Of several
/// that fit, one of exactly the name `preferred` comes first. The error is a sentence on what is missing and
/// what to do.
base::Result<FoundInput> find_input(InputSystem& system, InputKind kind, std::string_view address,
                                    std::string_view preferred = {});

/// An entry for each device of that kind and, where there is none, one that says why.
std::vector<DeviceEntry> list_inputs(InputSystem& system, InputKind kind, std::string_view family);

}  // namespace icome::devices
