#include "devices/openhaptics/open_haptics_driver.h"

#include <array>
#include <chrono>
#include <thread>

#include "base/clock.h"
#include "devices/driver/pace.h"

namespace icome::devices {
namespace {

constexpr std::array<const char*, 5> kHdWarnings = {
    "The motors are hot: the device weakens until they have cooled; let it rest",
    "More force was asked for than the device gives: it is cut",
    "The device wants to be calibrated: run the setup program of its driver",
    "The device is not calibrated: put the stylus into the inkwell",
    "The library of the device reports errors; it goes on as long as they pass"};

constexpr auto kCallbackLook =
    std::chrono::milliseconds(2);                     // from one look at the scheduler's callback to the next
constexpr std::int64_t kStandsStill = 1'000'000'000;  // ns without a frame
constexpr std::int64_t kCheckEvery = 1'000'000'000;   // ns, of the calibration

/// The state that the scheduler's callback and the thread that watches it share.
struct HdCallback {
  HdExchange& exchange;
  std::atomic<bool> finish = false;    // the next call is the last
  std::atomic<bool> finished = false;  // no call follows
};

unsigned hd_callback(void* context) {
  HdCallback& callback = *static_cast<HdCallback*>(context);
  if (callback.finish.load(std::memory_order_acquire)) {
    callback.exchange.rest();
    callback.finished.store(true, std::memory_order_release);
    return HdLibrary::kDone;
  }
  // After a failure it only waits for its last call.
  static_cast<void>(callback.exchange.frame());
  return HdLibrary::kContinue;
}

/// Watches whether frames are made at all.
class FrameWatch {
 public:
  bool stands_still(const HdExchange& exchange) {
    const std::int64_t now = base::steady_nanoseconds();
    if (const std::uint64_t count = exchange.count(); count != count_) {
      count_ = count;
      moved_ = now;
    }
    return now - moved_ > kStandsStill;
  }

 private:
  std::uint64_t count_ = 0;
  std::int64_t moved_ = base::steady_nanoseconds();  // ns
};

/// Waits for the callback's last call, for as long as frames may take.
bool wait_for_last(HdCallback& callback) {
  callback.finish.store(true, std::memory_order_release);
  const std::int64_t end = base::steady_nanoseconds() + kStandsStill;
  while (!callback.finished.load(std::memory_order_acquire) && base::steady_nanoseconds() < end)
    std::this_thread::sleep_for(kCallbackLook);
  return callback.finished.load(std::memory_order_acquire);
}

}  // namespace

OpenHapticsDriver::OpenHapticsDriver(std::string name, const OpenHapticsSettings& settings)
    : name_(std::move(name)), settings_(settings), warnings_(kHdWarnings) {}

OpenHapticsDriver::~OpenHapticsDriver() { close(); }

base::Result<DeviceInfo> OpenHapticsDriver::open() {
  close();
  auto hd = HdLibrary::load();
  if (!hd) return tl::unexpected(hd.error());
  hd_ = *hd;
  auto device = HdSession::instance().open(hd_, name_, settings_.rate);
  if (!device) return tl::unexpected(device.error());
  device_ = *device;
  return device_->info;
}

std::string OpenHapticsDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  warnings_.forget();
  next_check_ = 0;
  HdExchange exchange(hd_, device_->handle, link, warnings_, HdSession::instance().frames());
  return settings_.mode == OpenHapticsSettings::Mode::Drives ? be_driven(exchange, link, stop)
                                                             : follow(exchange, link, stop);
}

std::string OpenHapticsDriver::be_driven(HdExchange& exchange, DriverLink& link,
                                         const std::atomic<bool>& stop) {
  HdCallback callback{exchange};
  const unsigned long scheduled = hd_.schedule_asynchronous(&hd_callback, &callback, HdLibrary::kMaxPriority);
  if (const unsigned error = hd_.first_error(); error != 0) return sentence_of(error);
  FrameWatch frames;
  bool stands_still = false;
  while (!stop.load(std::memory_order_relaxed) && exchange.failure() == 0 && !stands_still) {
    watch(exchange, link);
    std::this_thread::sleep_for(kCallbackLook);
    stands_still = frames.stands_still(exchange);
  }
  if (!wait_for_last(callback)) {
    hd_.unschedule(scheduled);
    exchange.rest();
  }
  if (stands_still)
    return device_->info.name + ": OpenHaptics' scheduler stands still; plug the device in again";
  return exchange.failure() == 0 ? std::string() : sentence_of(exchange.failure());
}

std::string OpenHapticsDriver::follow(HdExchange& exchange, DriverLink& link, const std::atomic<bool>& stop) {
  Pace pace(settings_.rate);
  while (!stop.load(std::memory_order_relaxed) && exchange.frame()) {
    watch(exchange, link);
    pace.wait();
  }
  exchange.rest();
  return exchange.failure() == 0 ? std::string() : sentence_of(exchange.failure());
}

/// Checks the calibration now and then beside the frames, and tells the link of warnings.
void OpenHapticsDriver::watch(HdExchange& exchange, DriverLink& link) {
  const std::int64_t now = base::steady_nanoseconds();
  if (now >= next_check_) {
    next_check_ = now + kCheckEvery;
    exchange.check_calibration();
  }
  warnings_.tell(link, now);
}

std::string OpenHapticsDriver::sentence_of(unsigned failure) const {
  const std::string& model = device_->info.name;
  const std::string text = hd_.text_of(failure);
  if (failure == HdLibrary::kCommunication)
    return "The connection to " + model + " is lost (" + text + "); check its cable and power";
  if (failure == HdLibrary::kDeviceFault)
    return model + " reports a fault (" + text + "); switch it off and on again";
  return model + " does not work any more (" + text + "); switch it off and on again";
}

void OpenHapticsDriver::close() {
  if (!device_) return;
  HdSession::instance().close(hd_, *device_);
  device_.reset();
}

}  // namespace icome::devices
