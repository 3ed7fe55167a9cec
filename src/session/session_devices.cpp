// Pointers that come and go while a session runs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/session_parts.h"

namespace icome::session {
namespace {

constexpr double kShownFor = 2.0;     // s, for which a workspace is shown that has come or changed
constexpr double kViewRests = 0.4;    // s
constexpr double kOtherScale = 0.05;  // the least change of the scale that is worth letting go for

std::unique_ptr<devices::SimulatedDevice> make_mouse_hand(double rate_hz) {
  devices::SimulatedSettings settings;
  settings.info.name = "mouse";
  settings.rate = rate_hz;
  return std::make_unique<devices::SimulatedDevice>(std::move(settings));
}

/// The thing that is wrong with a mapping; empty: nothing.
std::string trouble_with(const devices::DeviceMapping& mapping) {
  if (mapping.scale && !(*mapping.scale >= 0.01 && *mapping.scale <= 100.0))
    return "The scale must be from 0.01 to 100.";
  if (!(mapping.max_force == 0.0 || (mapping.max_force >= 0.01 && mapping.max_force <= 1000.0)))
    return "The most force must be from 0.01 to 1000 N.";
  if (!(mapping.workspace_radius == 0.0 ||
        (mapping.workspace_radius >= 0.001 && mapping.workspace_radius <= 10.0)))
    return "The workspace must reach from 1 mm to 10 m.";
  if (mapping.clutch_button < -1 || mapping.clutch_button > 31)
    return "The clutch must be a button from 0 to 31.";
  if (!mapping.centre.allFinite()) return "The middle of the workspace must be a place.";
  return {};
}

double own_radius_of(const devices::MappedDevice& device) {
  return device.info().workspace_radius / device.mapping().scale.value_or(1.0);
}

/// The mapping with the scale at which the workspace spans what the view shows, as far as scales go.
devices::DeviceMapping fitted_to(const interaction::View& view, const devices::MappedDevice& device,
                                 devices::DeviceMapping mapping) {
  const double radius = mapping.workspace_radius > 0.0 ? mapping.workspace_radius : own_radius_of(device);
  const double scale = seen_radius(view) / radius;
  if (std::isfinite(scale)) mapping.scale = std::clamp(scale, 0.01, 100.0);
  return mapping;
}

}  // namespace

std::optional<std::size_t> SessionParts::mouse() const {
  if (!mouse_hand) return std::nullopt;
  return hands.pointers() - 1;
}

/// The hand lies aside until the mouse takes it up.
void SessionParts::take_in_mouse() {
  auto hand = make_mouse_hand(settings.servo.rate_hz);
  hand->park(base::Vector3::Zero());
  mouse_hand = hand.get();
  hand_is_aimed = false;
  parked_at = base::Vector3(base::Vector3::Zero());
  hands.add(hands.pointers(), std::move(hand), user.stage_from_device());
  pointers.push_back({.ungrabbed = true, .number = ++pointers_so_far});
}

void SessionParts::take_in_device(PointerConnection connection) {
  const std::size_t place = mouse().value_or(hands.pointers());
  if (place == 0) let_go_of_technique();
  auto device = std::make_unique<devices::MappedDevice>(std::move(connection.device), connection.mapping);
  if (connection.mapping.scale_follows_view)
    device->set_mapping(fitted_to(user.view(), *device, connection.mapping));
  hands.add(place, std::move(device), user.stage_from_device());
  pointers.insert(pointers.begin() + std::ptrdiff_t(place), {.ungrabbed = true,
                                                             .number = ++pointers_so_far,
                                                             .address = std::move(connection.address),
                                                             .identity = std::move(connection.identity),
                                                             .seen_until = session_seconds() + kShownFor});
  if (place == 0) renew_capped();
}

void SessionParts::take_out(std::size_t pointer) {
  if (pointer == 0) let_go_of_technique();
  let_go(pointer);
  const devices::PointerDevice* const device = hands.remove(pointer);
  closing.push_back(
      {std::move(pointers[pointer].address), std::move(pointers[pointer].identity), device, nullptr});
  pointers.erase(pointers.begin() + std::ptrdiff_t(pointer));
  if (hands.pointers() == 0) take_in_mouse();
  if (pointer == 0) renew_capped();
}

void SessionParts::remap(std::size_t pointer, const devices::DeviceMapping& mapping) {
  if (pointer == 0) let_go_of_technique();
  let_go(pointer);
  hands.remap(pointer, mapping);
  pointers[pointer].seen_until = session_seconds() + kShownFor;
}

/// Closes devices that no servo uses any more, which may take as long as it wants.
void SessionParts::close_gone() {
  for (auto& gone : hands.take_gone()) {
    const auto it = std::find_if(closing.begin(), closing.end(),
                                 [&](const ClosingDevice& one) { return one.device == gone.get(); });
    if (it == closing.end()) continue;
    const auto held = std::make_shared<std::unique_ptr<devices::PointerDevice>>(std::move(gone));
    it->device = nullptr;
    it->task = std::make_unique<BackgroundTask<bool>>([held]() -> base::Result<bool> {
      held->reset();
      return true;
    });
  }
  std::erase_if(closing, [](const ClosingDevice& it) { return it.task && it.task->is_done(); });
}

/// Fits workspaces to the view once it rests, where that lets go of nothing.
void SessionParts::follow_view_scale(double dt) {
  const interaction::View& view = user.view();
  const bool rests = is_same_view(view, rested_view);
  rested_view = view;
  view_rests_for = rests ? view_rests_for + dt : 0.0;
  if (view_rests_for < kViewRests) return;
  for (std::size_t i = 0; i < hands.pointers(); ++i) {
    devices::MappedDevice* const device = hands.mapped(i);
    if (!device || hands.is_away(i) || !device->mapping().scale_follows_view) continue;
    if (hands.view(i).touching || device->clutch().held || is_held(i)) continue;
    const devices::DeviceMapping fitted = fitted_to(view, *device, device->mapping());
    if (std::abs(fitted.scale.value_or(1.0) / device->mapping().scale.value_or(1.0) - 1.0) > kOtherScale)
      remap(i, fitted);
  }
}

/// The first pointer has become another one, and no edit tells what it feels more softly.
void SessionParts::renew_capped() {
  capped = std::make_shared<const std::vector<haptics::CappedEffect>>(hands.felt().capped_effects());
}

std::optional<std::size_t> SessionHands::mouse() const { return parts_.mouse(); }

base::Result<std::size_t> SessionHands::connect(PointerConnection connection) {
  if (const std::string wrong = trouble_with(connection.mapping); !wrong.empty()) return base::fail(wrong);
  if (!parts_.hands.has_room())
    return base::fail(fmt::format("There are {} pointers already: disconnect one first.", pointers()));
  const std::size_t index = parts_.mouse().value_or(pointers());
  parts_.take_in_device(std::move(connection));
  return index;
}

base::Result<void> SessionHands::disconnect(std::size_t index) {
  if (parts_.is_mouse(index)) return base::fail("The mouse's hand stays.");
  parts_.take_out(index);
  return {};
}

bool SessionHands::is_closing(const std::string& address, const std::string& identity) const {
  return std::any_of(parts_.closing.begin(), parts_.closing.end(), [&](const ClosingDevice& it) {
    return it.address == address || (!identity.empty() && it.identity == identity);
  });
}

PointerUse SessionHands::use(std::size_t index) const {
  const PointerParts& it = parts_.pointers[index];
  PointerUse use;
  use.number = it.number;
  use.address = it.address;
  use.identity = it.identity;
  use.own_radius = pointer_info(index).workspace_radius;
  use.condition = parts_.hands.condition(index);
  use.is_mouse = parts_.is_mouse(index);
  use.shows_workspace = it.shows_workspace;
  devices::MappedDevice* const device = parts_.hands.mapped(index);
  if (!device) return use;
  use.mapping = parts_.hands.is_away(index) ? parts_.hands.wanted(index) : device->mapping();
  use.own_radius = own_radius_of(*device);
  use.clutched = device->clutch().held;
  return use;
}

base::Result<void> SessionHands::set_mapping(std::size_t index, const devices::DeviceMapping& mapping) {
  devices::MappedDevice* const device = parts_.hands.mapped(index);
  if (!device) return base::fail("This pointer is used as it is.");
  if (const std::string wrong = trouble_with(mapping); !wrong.empty()) return base::fail(wrong);
  parts_.remap(index, mapping.scale_follows_view ? fitted_to(parts_.user.view(), *device, mapping) : mapping);
  return {};
}

void SessionHands::show_workspace(std::size_t index, bool shown) {
  parts_.pointers[index].shows_workspace = shown;
}

}  // namespace icome::session
