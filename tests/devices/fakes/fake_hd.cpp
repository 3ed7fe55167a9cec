// A fake of OpenHaptics' device library: its functions, its scheduler, and arms of no material behind them.
// Written from what its makers publish; no real device was there to hold it against.
#include "devices/fakes/fake_hd.h"

#include <algorithm>
#include <cstring>
#include <thread>
#include <vector>

#include "realtime/this_thread.h"

namespace icome::devices::fakes {
namespace {

// Values, abilities, errors and states by their numbers.
constexpr unsigned kButtonsValue = 0x2000;
constexpr unsigned kPositionValue = 0x2050;
constexpr unsigned kVelocityValue = 0x2051;
constexpr unsigned kTransformValue = 0x2052;
constexpr unsigned kModelValue = 0x2501;
constexpr unsigned kVendorValue = 0x2503;
constexpr unsigned kSerialValue = 0x2504;
constexpr unsigned kMaxWorkspaceValue = 0x2550;
constexpr unsigned kUsableWorkspaceValue = 0x2551;
constexpr unsigned kUpdateRateValue = 0x2600;
constexpr unsigned kMaxStiffnessValue = 0x2602;
constexpr unsigned kMaxForceValue = 0x2603;
constexpr unsigned kContinuousForceValue = 0x2604;
constexpr unsigned kForceValue = 0x2700;
constexpr unsigned kOutputAbility = 0x4000;
constexpr unsigned kClampAbility = 0x4001;
constexpr unsigned kRampAbility = 0x4002;
constexpr unsigned kNoneError = 0;
constexpr unsigned kBadValueError = 0x0100;
constexpr unsigned kMisuseError = 0x0101;
constexpr unsigned kWarmError = 0x0200;
constexpr unsigned kTooStrongError = 0x0201;
constexpr unsigned kFaultError = 0x0300;
constexpr unsigned kCommunicationError = 0x0302;
constexpr unsigned kSchedulerError = 0x0306;
constexpr unsigned kStrangeError = 0x0999;
constexpr unsigned kNoDevice = 0xFFFFFFFF;

struct ErrorInfo {  // as C has it: returned by value
  unsigned code;
  int internal_code;
  unsigned device;
};

/// Errors that nobody has taken yet. Where there are too many, the newest are lost.
class ErrorStack {
 public:
  void add(unsigned code, unsigned device) {
    if (count_ < errors_.size()) errors_[count_++] = {code, 0, device};
  }
  ErrorInfo take() {
    if (count_ == 0) return {0, 0, kNoDevice};
    return errors_[--count_];
  }

 private:
  std::array<ErrorInfo, 8> errors_{};
  std::size_t count_ = 0;
};
FakeHd& hd_from_environment() {
  static FakeHd hd;
  const FakeEnvironment environment("FAKE_HD");
  hd.set_up(std::clamp(int(environment.number("_DEVICES", 1.0)), 0, FakeHd::kMost),
            environment.text("_MODEL", "Touch"));
  for (FakeHd::Device& device : hd.devices) {
    const bool is_plugged = device.unit.is_plugged();
    environment.set_up(device.unit);
    device.unit.plug(is_plugged);
  }
  const std::string calibration = environment.text("_CALIBRATION", "ok");
  if (calibration == "update") hd.calibration = 0x5001;
  if (calibration == "inkwell") hd.calibration = 0x5002;
  return hd;
}

FakeHd& the_hd() {
  static FakeHd& hd = hd_from_environment();
  return hd;
}

/// The current device and the errors: of a thread, or of all of them (FakeHd::is_per_process).
struct HdContext {
  std::atomic<unsigned> device = kNoDevice;
  std::mutex guard;
  ErrorStack errors;
};

std::atomic<std::thread::id> opening_thread;  // none: no device is being opened

HdContext& the_context() {
  static HdContext of_all;
  thread_local HdContext of_thread;
  FakeHd& hd = the_hd();
  if (!hd.is_per_process) return of_thread;
  const std::thread::id opening = opening_thread;
  if (opening != std::thread::id() && opening != std::this_thread::get_id()) ++hd.misuses;
  return of_all;
}

void add_error(unsigned code, unsigned device) {
  HdContext& errors = the_context();
  const std::lock_guard lock(errors.guard);
  errors.errors.add(code, device);
}

void misuse(unsigned device) {
  ++the_hd().misuses;
  add_error(kMisuseError, device);
}

void hang_in(FakeHd::Call call) {
  while (the_hd().hangs_in == call) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// The open device of that handle; null where there is none, which is a misuse.
FakeHd::Device* device_of(unsigned handle) {
  if (handle < FakeHd::kMost && the_hd().devices[handle].is_open) return &the_hd().devices[handle];
  misuse(handle);
  return nullptr;
}

/// The error that a frame of the device ends with.
unsigned error_of(const FakeHd::Device& device) {
  if (!device.unit.is_plugged()) return kCommunicationError;
  switch (device.unit.fault()) {
    case UnitFault::Hot:
      return kWarmError;
    case UnitFault::TooStrong:
      return kTooStrongError;
    case UnitFault::Broken:
      return kFaultError;
    case UnitFault::Unknown:
      return kStrangeError;
    default:
      return kNoneError;
  }
}

/// Calls callbacks once a tick, those of the highest priority first, and removes those that are done.
class Scheduler {
 public:
  using Callback = unsigned (*)(void*);

  void start() {
    if (thread_.joinable()) return misuse(kNoDevice);
    stop_ = false;
    thread_ = std::thread([this] { run(); });
    the_hd().scheduler_runs = true;
  }
  void stop() {
    if (!thread_.joinable()) return misuse(kNoDevice);
    stop_ = true;
    thread_.join();
    the_hd().scheduler_runs = false;
  }
  void set_rate(double hertz) { period_ns_ = std::int64_t(1e9 / hertz); }

  unsigned long add(Callback callback, void* context, std::uint16_t priority) {
    const std::lock_guard lock(guard_);
    const auto before = std::find_if(tasks_.begin(), tasks_.end(),
                                     [&](const Task& task) { return task.priority < priority; });
    tasks_.insert(before, {callback, context, priority, ++last_handle_});
    ++the_hd().callbacks;
    return last_handle_;
  }
  void remove(unsigned long handle) {
    const std::lock_guard lock(guard_);
    const auto removed = int(std::erase_if(tasks_, [&](const Task& task) { return task.handle == handle; }));
    the_hd().callbacks -= removed;
    if (removed == 0 && handle != 0) misuse(kNoDevice);
    if (handle == 0) add_error(kBadValueError, kNoDevice);
  }
  bool has(unsigned long handle) {
    const std::lock_guard lock(guard_);
    return std::any_of(tasks_.begin(), tasks_.end(), [&](const Task& task) { return task.handle == handle; });
  }

 private:
  struct Task {
    Callback callback = nullptr;
    void* context = nullptr;
    std::uint16_t priority = 0;
    unsigned long handle = 0;
  };

  void run() {
    static_cast<void>(realtime::ask_for_realtime_priority(85));
    std::int64_t next = base::steady_nanoseconds();
    while (!stop_) {
      if (!the_hd().scheduler_hangs) tick();
      const std::int64_t now = base::steady_nanoseconds();
      next = std::max(next + period_ns_, now - period_ns_);
      if (the_hd().scheduler_waits) realtime::sleep_until(next);
    }
  }
  void tick() {
    const std::lock_guard lock(guard_);
    for (std::size_t i = 0; i < tasks_.size();) {
      if (tasks_[i].callback(tasks_[i].context) != 0) {
        ++i;
        continue;
      }
      tasks_.erase(tasks_.begin() + std::ptrdiff_t(i));
      --the_hd().callbacks;
    }
  }

  std::mutex guard_;
  std::vector<Task> tasks_;
  unsigned long last_handle_ = 0;
  std::atomic<std::int64_t> period_ns_ = 1'000'000;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Never destroyed, as a program may end while it runs.
Scheduler& the_scheduler() {
  static Scheduler& scheduler = *new Scheduler();
  return scheduler;
}

void write_vector(const base::Vector3& metres, double* millimetres) {
  for (int i = 0; i < 3; ++i) millimetres[i] = 1000.0 * metres[i];
}

/// Column by column, lengths in mm.
void write_transform(const FakeUnit::Sample& sample, double* values) {
  base::Affine3 transform = base::Affine3::Identity();
  transform.linear() = sample.rotation;
  transform.translation() = 1000.0 * sample.position;
  std::copy_n(transform.data(), 16, values);
}

// The reading of a frame, of each device; the thread that makes frames uses it.
std::array<FakeUnit::Sample, FakeHd::kMost> frame_samples;

void get_number(unsigned what, double* values) {
  const unsigned handle = the_context().device;
  FakeHd::Device* device = device_of(handle);
  if (device == nullptr) return;
  constexpr std::array<double, 6> kUsable = {-80.0, -60.0, -35.0, 80.0, 60.0, 35.0};
  constexpr std::array<double, 6> kMost = {-210.0, -110.0, -85.0, 210.0, 205.0, 130.0};
  const FakeUnit::Sample& sample = frame_samples[handle];
  const bool is_of_frame = what == kPositionValue || what == kVelocityValue || what == kTransformValue;
  if (is_of_frame && !device->is_in_frame) return misuse(handle);
  switch (what) {
    case kPositionValue:
      return write_vector(sample.position, values);
    case kVelocityValue:
      return write_vector(sample.velocity, values);
    case kTransformValue:
      return write_transform(sample, values);
    case kUsableWorkspaceValue:
      std::copy(kUsable.begin(), kUsable.end(), values);
      return;
    case kMaxWorkspaceValue:
      std::copy(kMost.begin(), kMost.end(), values);
      return;
    case kUpdateRateValue:
      *values = 1000.0;
      return;
    case kMaxStiffnessValue:
      *values = 0.5;
      return;
    case kMaxForceValue:
      *values = the_hd().max_force;
      return;
    case kContinuousForceValue:
      *values = 0.88;
      return;
    default:
      add_error(kBadValueError, handle);
  }
}

void set_ability(unsigned ability, bool on) {
  FakeHd::Device* device = device_of(the_context().device);
  if (device == nullptr) return;
  if (ability == kOutputAbility)
    device->has_force = on;
  else if (ability == kClampAbility)
    device->has_clamp = on;
  else if (ability == kRampAbility)
    device->has_ramp = on;
  else
    add_error(kBadValueError, the_context().device);
}

/// Makes a device the current one, again and again for as long as opening it takes.
void spend_opening_time(unsigned handle) {
  FakeHd& hd = the_hd();
  const std::int64_t end = base::steady_nanoseconds() + std::int64_t(1e9 * hd.opening_time);
  opening_thread = std::this_thread::get_id();
  hd.is_opening = true;
  the_context().device = handle;
  while (base::steady_nanoseconds() < end) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    the_context().device = handle;
  }
  hd.is_opening = false;
  opening_thread = std::thread::id();
}

/// A callback that its caller waits for.
struct Waiting {
  unsigned (*callback)(void*);
  void* context;
};
unsigned call_once(void* context) {
  const Waiting& waiting = *static_cast<Waiting*>(context);
  return waiting.callback(waiting.context);
}

}  // namespace
}  // namespace icome::devices::fakes

using namespace icome::devices::fakes;

#define FAKE_EXPORT extern "C" __attribute__((visibility("default")))

FAKE_EXPORT FakeHd* fake_hd() { return &the_hd(); }

// Named as the real ones are.
// NOLINTBEGIN(readability-identifier-naming)

FAKE_EXPORT unsigned hdInitDevice(const char* name) {
  FakeHd& hd = the_hd();
  for (unsigned handle = 0; handle < FakeHd::kMost; ++handle) {
    FakeHd::Device& device = hd.devices[handle];
    if (name != nullptr ? std::strcmp(name, FakeHd::kNames[handle]) != 0 : handle != 0) continue;
    if (device.is_open) {
      misuse(handle);
      return kNoDevice;
    }
    const unsigned error = error_of(device);
    if (error == kCommunicationError || error == kFaultError) {
      add_error(error, handle);
      return kNoDevice;
    }
    device.is_open = true;
    spend_opening_time(handle);
    return handle;
  }
  add_error(kBadValueError, kNoDevice);
  return kNoDevice;
}

FAKE_EXPORT void hdDisableDevice(unsigned handle) {
  FakeHd::Device* device = device_of(handle);
  if (device == nullptr) return;
  if (device->is_in_frame) misuse(handle);
  const bool is_last = std::count_if(the_hd().devices.begin(), the_hd().devices.end(),
                                     [](const FakeHd::Device& other) { return other.is_open.load(); }) == 1;
  if (is_last && the_hd().scheduler_runs) misuse(handle);
  device->is_open = false;
  device->unit.push(icome::base::Vector3::Zero());
}

FAKE_EXPORT void hdMakeCurrentDevice(unsigned handle) {
  if (device_of(handle) != nullptr) the_context().device = handle;
}

FAKE_EXPORT unsigned hdGetCurrentDevice() { return the_context().device; }

FAKE_EXPORT void hdBeginFrame(unsigned handle) {
  FakeHd::Device* device = device_of(handle);
  if (device == nullptr) return;
  if (device->is_in_frame.exchange(true)) misuse(handle);
  the_context().device = handle;
  frame_samples[handle] = device->unit.read();
  hang_in(FakeHd::Call::BeginFrame);
}

FAKE_EXPORT void hdEndFrame(unsigned handle) {
  hang_in(FakeHd::Call::EndFrame);
  FakeHd::Device* device = device_of(handle);
  if (device == nullptr) return;
  if (!device->is_in_frame.exchange(false)) misuse(handle);
  if (const unsigned error = error_of(*device); error != kNoneError) add_error(error, handle);
}

FAKE_EXPORT void hdEnable(unsigned ability) { set_ability(ability, true); }
FAKE_EXPORT void hdDisable(unsigned ability) { set_ability(ability, false); }

FAKE_EXPORT unsigned char hdIsEnabled(unsigned ability) {
  const FakeHd::Device* device = device_of(the_context().device);
  return device != nullptr && ability == kOutputAbility && device->has_force ? 1 : 0;
}

FAKE_EXPORT void hdGetIntegerv(unsigned what, int* values) {
  const FakeHd::Device* device = device_of(the_context().device);
  if (device == nullptr) return;
  if (what == kButtonsValue)
    *values = int(device->unit.buttons());
  else
    add_error(kBadValueError, the_context().device);
}

FAKE_EXPORT void hdGetDoublev(unsigned what, double* values) { get_number(what, values); }

FAKE_EXPORT const char* hdGetString(unsigned what) {
  if (device_of(the_context().device) == nullptr) return nullptr;
  if (what == kModelValue) return the_hd().model();
  if (what == kVendorValue) return "a fake of 3D Systems";
  if (what == kSerialValue) return the_context().device == 0 ? "FAKE-0001" : "FAKE-0002";
  add_error(kBadValueError, the_context().device);
  return nullptr;
}

FAKE_EXPORT void hdSetDoublev(unsigned what, const double* values) {
  FakeHd::Device* device = device_of(the_context().device);
  if (device == nullptr) return;
  if (what != kForceValue) return add_error(kBadValueError, the_context().device);
  if (!device->is_in_frame) return misuse(the_context().device);
  const icome::base::Vector3 force(values[0], values[1], values[2]);
  if (device->unit.is_plugged())
    device->unit.push(device->has_force ? force : icome::base::Vector3(icome::base::Vector3::Zero()));
}

FAKE_EXPORT void hdStartScheduler() { the_scheduler().start(); }
FAKE_EXPORT void hdStopScheduler() { the_scheduler().stop(); }
FAKE_EXPORT void hdSetSchedulerRate(unsigned long hertz) {
  if (hertz < 500 || hertz > 4000) return add_error(kBadValueError, kNoDevice);
  the_scheduler().set_rate(double(hertz));
}
FAKE_EXPORT unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* context,
                                                 std::uint16_t priority) {
  const FakeHd::Scheduling answer = the_hd().scheduling;
  if (answer != FakeHd::Scheduling::Fine) add_error(kSchedulerError, kNoDevice);
  return answer == FakeHd::Scheduling::Refused ? 0 : the_scheduler().add(callback, context, priority);
}
FAKE_EXPORT void hdScheduleSynchronous(unsigned (*callback)(void*), void* context, std::uint16_t priority) {
  Waiting waiting{callback, context};
  const unsigned long handle = the_scheduler().add(&call_once, &waiting, priority);
  while (the_scheduler().has(handle)) std::this_thread::sleep_for(std::chrono::microseconds(100));
}
FAKE_EXPORT void hdUnschedule(unsigned long handle) { the_scheduler().remove(handle); }

FAKE_EXPORT ErrorInfo hdGetError() {
  HdContext& errors = the_context();
  const std::lock_guard lock(errors.guard);
  return errors.errors.take();
}

FAKE_EXPORT const char* hdGetErrorString(unsigned code) {
  switch (code) {
    case kBadValueError:
      return "invalid value";
    case kMisuseError:
      return "invalid operation";
    case kWarmError:
      return "warm motors";
    case kTooStrongError:
      return "exceeded maximum force";
    case kFaultError:
      return "device fault";
    case kCommunicationError:
      return "communication error";
    case kSchedulerError:
      return "scheduler full";
    default:
      return "unknown error";
  }
}

FAKE_EXPORT unsigned hdCheckCalibration() {
  return device_of(the_context().device) != nullptr ? the_hd().calibration.load() : 0;
}

// NOLINTEND(readability-identifier-naming)
