#include "devices/openhaptics/hd_library.h"

#include <fmt/format.h>

#include <array>

#include "devices/driver/shared_library.h"

namespace icome::devices {
namespace {

constexpr std::array<const char*, 5> kHdFiles = {"libHD.so", "libHD.so.3.5", "libHD.so.3.4", "libHD.so.3",
                                                 "libHD.so.2"};
constexpr LibrarySought kHdSought = {
    "OpenHaptics (PHANToM, Touch)", "ICOME_LIBHD", kHdFiles,
    "install OpenHaptics for Linux and the driver of the device, which 3D Systems gives to owners"};
constexpr int kMostErrors = 16;  // that are taken at once

}  // namespace

base::Result<HdLibrary> HdLibrary::load() {
  const auto library = SharedLibrary::open(kHdSought);
  if (!library) return tl::unexpected(library.error());
  HdLibrary hd;
  base::Result<void> got;
  const auto get = [&](const char* name, auto*& function) {
    if (got) got = library->get(name, function);
  };
  get("hdInitDevice", hd.init_device);
  get("hdDisableDevice", hd.disable_device);
  get("hdMakeCurrentDevice", hd.make_current_device);
  get("hdBeginFrame", hd.begin_frame);
  get("hdEndFrame", hd.end_frame);
  get("hdEnable", hd.enable);
  get("hdDisable", hd.disable);
  get("hdGetIntegerv", hd.get_integerv);
  get("hdGetDoublev", hd.get_doublev);
  get("hdSetDoublev", hd.set_doublev);
  get("hdStartScheduler", hd.start_scheduler);
  get("hdStopScheduler", hd.stop_scheduler);
  get("hdSetSchedulerRate", hd.set_scheduler_rate);
  get("hdScheduleAsynchronous", hd.schedule_asynchronous);
  get("hdUnschedule", hd.unschedule);
  get("hdGetError", hd.get_error);
  get("hdGetErrorString", hd.get_error_string);
  if (!got) return tl::unexpected(got.error());
  library->get_if_there("hdGetString", hd.get_string);
  library->get_if_there("hdCheckCalibration", hd.check_calibration);
  return hd;
}

std::string HdLibrary::text_of(unsigned code) const {
  const char* text = get_error_string(code);
  return text != nullptr && *text != '\0' ? text : fmt::format("error {:#06x}", code);
}

unsigned HdLibrary::first_error() const {
  unsigned first = 0;
  for (int i = 0; i < kMostErrors; ++i) {
    const unsigned code = get_error().code;
    if (code == 0) break;
    if (first == 0) first = code;
  }
  return first;
}

}  // namespace icome::devices
