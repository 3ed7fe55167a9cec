#include "devices/openhaptics/open_haptics_driver.h"

#include <array>
#include <chrono>
#include <thread>

#include "base/clock.h"
#include "devices/driver/pace.h"

namespace icome::devices {
namespace {

constexpr std::array<const char*, 4> kHdWarnings = {
    "The motors are hot: the device weakens until they have cooled; let it rest",
    "More force was asked for than the device gives: it is cut (times so far: {})",
    "The library of the device reports errors; it goes on as long as they pass (errors so far: {})",
    "Another PHANToM or Touch is being opened or closed: this one gives no force meanwhile"};

// From one look at the scheduler's callback to the next.
constexpr auto kCallbackLook = std::chrono::milliseconds(2);
constexpr std::int64_t kStandsStill = 1'000'000'000;  // ns without a frame
constexpr std::int64_t kLastCall = 500'000'000;       // ns until the callback's last call must have ended
constexpr std::int64_t kTurnPatience = 100'000'000;   // ns
constexpr std::int64_t kCheckEvery = 1'000'000'000;   // ns, of the calibration

enum class CallbackState : std::uint8_t {
  Runs,
  Ends,       // the next call is the last
  Ended,      // no call follows
  Abandoned,  // the last call did not come in time: calls that come late do nothing
};

/// The state that the scheduler's callback and the thread that watches it share.
struct HdCallback {
  HdExchange exchange;
  std::atomic<CallbackState> state = CallbackState::Runs;
  std::atomic<bool> is_called = false;  // now
};

unsigned hd_callback(void* context) {
  HdCallback& callback = *static_cast<HdCallback*>(context);
  callback.is_called.store(true);
  const CallbackState state = callback.state.load();
  // After a failure it only waits for its last call.
  if (state == CallbackState::Runs) static_cast<void>(callback.exchange.frame());
  if (state == CallbackState::Ends) static_cast<void>(callback.exchange.rest());
  callback.is_called.store(false);
  if (state == CallbackState::Runs) return HdLibrary::kContinue;
  // Once it has ended nothing of it may be touched.
  CallbackState ends = CallbackState::Ends;
  callback.state.compare_exchange_strong(ends, CallbackState::Ended);
  return HdLibrary::kDone;
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

/// Waits for the callback's last call; false, and it is abandoned, where that does not end in time.
bool wait_for_last(HdCallback& callback) {
  callback.state.store(CallbackState::Ends);
  const std::int64_t end = base::steady_nanoseconds() + kLastCall;
  while (callback.state.load() != CallbackState::Ended && base::steady_nanoseconds() < end)
    std::this_thread::sleep_for(kCallbackLook);
  CallbackState ends = CallbackState::Ends;
  return !callback.state.compare_exchange_strong(ends, CallbackState::Abandoned);
}

/// Ends the calls of a callback. One that hangs in the library is left to itself, as unscheduling it would
/// wait for it: it finds alive what it uses, and puts the device to rest when it goes on.
void end_callback(const HdLibrary& hd, const std::shared_ptr<HdCallback>& callback, unsigned long scheduled) {
  if (wait_for_last(*callback)) return;
  callback->exchange.let_go();
  HdSession::instance().keep(callback);
  if (callback->is_called.load()) return;
  hd.unschedule(scheduled);
  static_cast<void>(callback->exchange.rest());
}

/// The reason why a device in that state of calibration may not push: its places are not where the hand is.
std::string why_withheld(unsigned calibration) {
  switch (calibration) {
    case HdLibrary::kCalibrationNeedsUpdate:
      return "it wants to be calibrated; run the setup program of its driver";
    case HdLibrary::kCalibrationNeedsHand:
      return "it is not calibrated; put the stylus into the inkwell";
    default:
      return {};
  }
}

/// Takes all errors of the library. Returns the first one; 0 without any.
unsigned take_hd_errors(const HdLibrary& hd) {
  const HdTurns::Turn turn = HdSession::instance().turns().take(kTurnPatience);
  return turn ? hd.first_error() : 0;
}

}  // namespace

OpenHapticsDriver::OpenHapticsDriver(std::string name, const OpenHapticsSettings& settings)
    : name_(std::move(name)), settings_(settings), warnings_(std::make_shared<Warnings>(kHdWarnings)) {}

OpenHapticsDriver::~OpenHapticsDriver() { close(); }

base::Result<DeviceInfo> OpenHapticsDriver::open() {
  close();
  auto hd = HdLibrary::load();
  if (!hd) return tl::unexpected(hd.error());
  hd_ = *hd;
  auto device = HdSession::instance().open(hd_, name_, settings_.rate);
  if (!device) return tl::unexpected(device.error());
  device_ = *device;
  DeviceInfo info = device_->info;
  // Of two alike people need to know which.
  if (!name_.empty()) info.name += " (" + device_->address() + ")";
  return info;
}

std::string OpenHapticsDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  warnings_->forget();
  next_check_ = 0;
  return settings_.mode == OpenHapticsSettings::Mode::Drives ? be_driven(link, stop) : follow(link, stop);
}

std::string OpenHapticsDriver::be_driven(DriverLink& link, const std::atomic<bool>& stop) {
  const std::shared_ptr<HdCallback> callback(
      new HdCallback{{hd_, device_->handle, link, warnings_, HdSession::instance().turns()}});
  const HdExchange& exchange = callback->exchange;
  // An old error would be taken for one of scheduling. That is done without a turn, as the library may let it
  // wait for frames, which wait for turns; other devices' frames leave no errors behind.
  static_cast<void>(take_hd_errors(hd_));
  const unsigned long scheduled =
      hd_.schedule_asynchronous(&hd_callback, callback.get(), HdLibrary::kMaxPriority);
  const unsigned refused = take_hd_errors(hd_);
  FrameWatch frames;
  bool stands_still = false;
  while (refused == 0 && !stop.load(std::memory_order_relaxed) && exchange.failure() == 0 && !stands_still) {
    watch(callback->exchange, link);
    std::this_thread::sleep_for(kCallbackLook);
    stands_still = frames.stands_still(exchange);
  }
  // Also where the library refused: it may have scheduled the callback nevertheless.
  end_callback(hd_, callback, scheduled);
  if (stands_still)
    return device_->info.name + ": OpenHaptics' scheduler stands still; plug the device in again";
  const unsigned failure = refused != 0 ? refused : exchange.failure();
  return failure == 0 ? std::string() : sentence_of(failure);
}

std::string OpenHapticsDriver::follow(DriverLink& link, const std::atomic<bool>& stop) {
  HdExchange exchange(hd_, device_->handle, link, warnings_, HdSession::instance().turns());
  Pace pace(settings_.rate);
  FrameWatch frames;
  bool stands_still = false;
  while (!stop.load(std::memory_order_relaxed) && exchange.frame() && !stands_still) {
    watch(exchange, link);
    pace.wait();
    stands_still = frames.stands_still(exchange);
  }
  static_cast<void>(exchange.rest());
  if (stands_still)
    return device_->info.name + ": OpenHaptics hangs in a call about another device; plug that in again";
  return exchange.failure() == 0 ? std::string() : sentence_of(exchange.failure());
}

/// Checks the calibration now and then beside the frames, and tells the link of warnings.
void OpenHapticsDriver::watch(HdExchange& exchange, DriverLink& link) {
  const std::int64_t now = base::steady_nanoseconds();
  if (now >= next_check_) {
    next_check_ = now + kCheckEvery;
    if (const auto state = exchange.calibration()) link.withhold(why_withheld(*state));
  }
  warnings_->tell(link, now);
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
