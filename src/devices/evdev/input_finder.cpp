#include "devices/evdev/input_finder.h"

#include <fmt/format.h>
#include <linux/input-event-codes.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/shown_text.h"
#include "base/utf8.h"
#include "devices/driver/udev_rule.h"

namespace icome::devices {
namespace {

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); });
  return result;
}

/// 3 for the preferred name, 2 for exactly the name of the address, 1 for another that fits, 0 for none.
int name_fit(const std::string& name, std::string_view address, std::string_view preferred) {
  const std::string small = lower_case(name);
  const std::string asked = lower_case(address);
  if (small.find(asked) == std::string::npos) return 0;
  if (!preferred.empty() && name == preferred) return 3;
  return small == asked ? 2 : 1;
}

/// The property that udev gives devices of that kind.
std::string_view udev_property(InputKind kind) {
  switch (kind) {
    case InputKind::Tablet:
      return "ID_INPUT_TABLET";
    case InputKind::Mouse:
      return "ID_INPUT_MOUSE";
    case InputKind::Gamepad:
      break;
  }
  return "ID_INPUT_JOYSTICK";
}

bool is_refused(const std::error_code& error) {
  return error == std::errc::permission_denied || error == std::errc::operation_not_permitted;
}

/// The result of a look through the nodes.
struct Look {
  std::vector<std::unique_ptr<InputNode>> of_kind;
  int refused = 0;        // nodes of unknown kind, as they may not be opened
  std::error_code error;  // of the folder
};

Look look_around(InputSystem& system, InputKind kind) {
  Look look;
  const auto paths = system.nodes();
  if (!paths) {
    look.error = paths.error();
    return look;
  }
  for (const std::string& path : *paths) {
    auto node = system.open(path);
    if (node && is_of_kind((*node)->abilities(), kind)) look.of_kind.push_back(std::move(*node));
    if (!node && is_refused(node.error())) ++look.refused;
  }
  return look;
}

/// The reason why a look found nothing: a sentence or two.
std::string why_none(const InputSystem& system, const Look& look, InputKind kind) {
  const std::string_view name = kind_name(kind);
  if (is_refused(look.error))
    return fmt::format("{}: {} may not be looked into; {}", name, system.folder(), permission_advice(kind));
  if (look.error)
    return fmt::format(
        "{}: {} cannot be looked into ({}); in a container, pass it the folder, else plug the {} in and set "
        "ICOME_INPUT_FOLDER where it lies elsewhere",
        name, system.folder(), look.error.message(), name);
  if (look.refused > 0)
    return fmt::format("no {} among the input devices that may be read; {} may not be: {}", name,
                       look.refused, permission_advice(kind));
  return fmt::format("no {} is plugged in; plug one in, or switch it on", name);
}

std::string names_of(const Look& look) {
  std::string names;
  for (const auto& node : look.of_kind) names += (names.empty() ? "" : ", ") + shown_name(node->abilities());
  return names;
}

base::Result<FoundInput> find_by_path(InputSystem& system, InputKind kind, const std::string& path) {
  auto node = system.open(path);
  const std::string_view name = kind_name(kind);
  const std::string shown = base::shown_text(base::as_utf8(path));
  if (!node && is_refused(node.error()))
    return base::fail(fmt::format("{}: {} may not be opened; {}", name, shown, permission_advice(kind)));
  if (!node && node.error() == std::errc::no_such_file_or_directory)
    return base::fail(
        fmt::format("{}: there is no {}; plug it in, or see what there is by `icome devices`", name, shown));
  if (!node)
    return base::fail(
        fmt::format("{}: {} cannot be opened as an input device ({}); see what there is by "
                    "`icome devices`",
                    name, shown, node.error().message()));
  if (!is_of_kind((*node)->abilities(), kind))
    return base::fail(fmt::format("{} is no {} but \"{}\"; see what there is by `icome devices`", shown, name,
                                  shown_name((*node)->abilities())));
  auto claim = DeviceClaim::of((*node)->abilities().path);
  if (!claim) return base::fail(in_use_text(shown));
  return FoundInput{std::move(*claim), std::move(*node)};
}

}  // namespace

std::string_view kind_name(InputKind kind) {
  switch (kind) {
    case InputKind::Tablet:
      return "tablet";
    case InputKind::Mouse:
      return "mouse";
    case InputKind::Gamepad:
      break;
  }
  return "gamepad";
}

bool is_of_kind(const InputAbilities& abilities, InputKind kind) {
  const bool plane = abilities.axes[ABS_X].has_value() && abilities.axes[ABS_Y].has_value();
  const bool pen = plane && (abilities.keys[BTN_TOOL_PEN] || abilities.keys[BTN_STYLUS]);
  switch (kind) {
    case InputKind::Tablet:
      return pen;
    case InputKind::Mouse:
      return abilities.relative[REL_X] && abilities.relative[REL_Y] && abilities.keys[BTN_LEFT];
    case InputKind::Gamepad:
      break;
  }
  return plane && !pen && (abilities.keys[BTN_GAMEPAD] || abilities.keys[BTN_TRIGGER]);
}

std::string shown_name(const InputAbilities& abilities) {
  std::string name = base::as_utf8(abilities.name);
  std::ranges::replace_if(
      name, [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; }, '?');
  return name.empty() ? "unnamed" : name;
}

std::string permission_advice(InputKind kind) {
  return "add yourself to the group input (sudo usermod -aG input \"$USER\", then log in again), or " +
         udev_rule_advice("input", fmt::format(R"(SUBSYSTEM=="input", KERNEL=="event*", ENV{{{}}}=="1")",
                                               udev_property(kind)));
}

base::Result<FoundInput> find_input(InputSystem& system, InputKind kind, std::string_view address,
                                    std::string_view preferred) {
  if (address.starts_with('/')) return find_by_path(system, kind, std::string(address));
  Look look = look_around(system, kind);
  if (look.of_kind.empty()) return base::fail(why_none(system, look, kind));
  FoundInput found;
  int best = 0;
  bool in_use = false;
  for (auto& node : look.of_kind) {
    const int fit = name_fit(shown_name(node->abilities()), address, preferred);
    if (fit <= best) continue;
    auto claim = DeviceClaim::of(node->abilities().path);
    in_use = in_use || !claim;
    if (!claim) continue;
    best = fit;
    found.claim = std::move(*claim);
    found.node = std::move(node);
  }
  if (best > 0) return found;
  if (in_use)
    return base::fail(fmt::format("every {} that fits is in use by this program already; close one there",
                                  kind_name(kind)));
  return base::fail(fmt::format("no {} is called \"{}\"; there are: {}", kind_name(kind),
                                base::shown_text(base::as_utf8(address)), names_of(look)));
}

std::vector<DeviceEntry> list_inputs(InputSystem& system, InputKind kind, std::string_view family) {
  const Look look = look_around(system, kind);
  const std::string backend(kind_name(kind));
  if (look.of_kind.empty())
    return {{backend, std::string(family), backend, false, why_none(system, look, kind)}};
  std::vector<DeviceEntry> entries;
  for (const auto& node : look.of_kind) {
    const std::string name = shown_name(node->abilities());
    const auto alike = std::ranges::count_if(
        look.of_kind, [&](const auto& other) { return shown_name(other->abilities()) == name; });
    const std::string& path = node->abilities().path;
    const bool by_name = alike == 1 && !name.starts_with('/');
    entries.push_back({fmt::format("{}:{}", backend, by_name ? name : path), std::string(family), backend,
                       true, by_name ? path : fmt::format("{}, {}", name, path), path});
  }
  return entries;
}

}  // namespace icome::devices
