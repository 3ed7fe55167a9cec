#include "devices/haply/haply_back_end.h"

#include <utility>

#include "base/terminal_text.h"
#include "devices/driver/driven_device.h"
#include "devices/haply/haply_driver.h"

namespace icome::devices {
namespace {

constexpr std::string_view kHaplyName = "haply";

DeviceEntry absent_haply(std::string why) {
  return {std::string(kHaplyName), "pointer", std::string(kHaplyName), false, std::move(why)};
}

DeviceEntry haply_entry(const InverseService& service, std::size_t index, const HaplySettings& settings) {
  const ServiceArm& arm = service.state().arms()[index];
  std::string what = "Haply Inverse3";
  if (const ServiceGrip* const grip = service.state().grip_of(index, settings.grip))
    what += " with VerseGrip " + std::string(grip->id.text());
  if (!service.version().text.empty())
    what += ", Inverse Service " + base::terminal_text(service.version().text);
  if (!arm.powered) what += "; it has no power";
  if (!arm.calibrated) what += "; it is not calibrated";
  const std::string address = "haply:" + std::string(arm.id.text());
  return {address, "pointer", std::string(kHaplyName), true, std::move(what), address};
}

std::vector<DeviceEntry> list_haply() {
  const auto settings = haply_settings_from_environment();
  if (!settings) return {absent_haply(settings.error().message)};
  auto service = InverseService::connect(*settings);
  if (!service) return {absent_haply(service.error().message)};
  if (const auto first = (*service)->choose({}); !first) return {absent_haply(first.error().message)};
  std::vector<DeviceEntry> entries;
  for (std::size_t i = 0; i < (*service)->state().arms().size(); ++i)
    entries.push_back(haply_entry(**service, i, *settings));
  return entries;
}

base::Result<std::unique_ptr<PointerDevice>> open_haply(std::string_view address) {
  const auto settings = haply_settings_from_environment();
  if (!settings) return tl::unexpected(settings.error());
  auto device = DrivenDevice::create(std::make_unique<HaplyDriver>(*settings, std::string(address)));
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<PointerDevice>(std::move(*device));
}

}  // namespace

BackEnd haply_back_end() { return {kHaplyName, "haply", list_haply, open_haply}; }

}  // namespace icome::devices
