// Makes a tablet, a mouse and a gamepad of the system's own (uinput), and drives them through the back-ends
// as a person would: run it as root where there is /dev/uinput. Prints what was found and measured.
#include <fcntl.h>
#include <linux/uinput.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "devices/evdev/back_ends.h"
#include "devices/evdev/gamepad_navigation.h"
#include "devices/evdev/linux_inputs.h"

namespace icome::devices {
namespace {

int failures = 0;

void check(bool holds, const std::string& what) {
  std::printf("%s  %s\n", holds ? "ok    " : "FAILED", what.c_str());
  std::fflush(stdout);
  failures += holds ? 0 : 1;
}

bool holds_soon(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

struct AxisOfNode {
  int code;
  int least;
  int most;
  int resolution;
};

/// An input device of the kernel that this program plays; it ends with it.
class PlayedNode {
 public:
  PlayedNode(const char* name, std::initializer_list<int> keys, std::initializer_list<int> relative,
             std::initializer_list<AxisOfNode> axes, bool rumbles)
      : file_(open("/dev/uinput", O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
    for (const int key : keys) set(UI_SET_EVBIT, EV_KEY), set(UI_SET_KEYBIT, key);
    for (const int axis : relative) set(UI_SET_EVBIT, EV_REL), set(UI_SET_RELBIT, axis);
    for (const AxisOfNode& axis : axes) {
      uinput_abs_setup setup{};
      setup.code = std::uint16_t(axis.code);
      setup.absinfo.minimum = axis.least;
      setup.absinfo.maximum = axis.most;
      setup.absinfo.resolution = axis.resolution;
      set(UI_SET_EVBIT, EV_ABS);
      ioctl(file_, UI_ABS_SETUP, &setup);
    }
    if (rumbles) set(UI_SET_EVBIT, EV_FF), set(UI_SET_FFBIT, FF_RUMBLE);
    uinput_setup setup{};
    std::strncpy(setup.name, name, sizeof(setup.name) - 1);
    setup.id.bustype = BUS_VIRTUAL;
    setup.ff_effects_max = rumbles ? 4 : 0;
    ioctl(file_, UI_DEV_SETUP, &setup);
    made_ = ioctl(file_, UI_DEV_CREATE) == 0;
    if (rumbles) answerer_ = std::thread([this] { answer(); });
  }
  ~PlayedNode() {
    stop_ = true;
    if (answerer_.joinable()) answerer_.join();
    ioctl(file_, UI_DEV_DESTROY);
    close(file_);
  }

  bool made() const { return made_; }
  void say(int type, int code, int value) const {
    input_event event{};
    event.type = std::uint16_t(type);
    event.code = std::uint16_t(code);
    event.value = value;
    if (write(file_, &event, sizeof(event)) != ssize_t(sizeof(event))) std::perror("uinput");
  }
  void report() const { say(EV_SYN, SYN_REPORT, 0); }

  /// Strength of the strong motor, 0 to 1, that plays.
  double rumbling() const { return playing_ ? strength_.load() : 0.0; }
  int uploads() const { return uploads_; }

 private:
  void set(unsigned long request, int code) const { ioctl(file_, request, code); }

  void answer() {
    while (!stop_) {
      pollfd asked{file_, POLLIN, 0};
      input_event event{};
      if (poll(&asked, 1, 10) <= 0 || read(file_, &event, sizeof(event)) != ssize_t(sizeof(event))) continue;
      if (event.type == EV_FF) playing_ = event.value != 0;
      if (event.type != EV_UINPUT) continue;
      if (event.code == UI_FF_UPLOAD) {
        uinput_ff_upload upload{};
        upload.request_id = unsigned(event.value);
        ioctl(file_, UI_BEGIN_FF_UPLOAD, &upload);
        strength_ = upload.effect.u.rumble.strong_magnitude / 65535.0;
        ++uploads_;
        ioctl(file_, UI_END_FF_UPLOAD, &upload);
      } else if (event.code == UI_FF_ERASE) {
        uinput_ff_erase erase{};
        erase.request_id = unsigned(event.value);
        ioctl(file_, UI_BEGIN_FF_ERASE, &erase);
        playing_ = false;
        ioctl(file_, UI_END_FF_ERASE, &erase);
      }
    }
  }

  int file_;
  bool made_ = false;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> playing_ = false;
  std::atomic<double> strength_ = 0.0;
  std::atomic<int> uploads_ = 0;
  std::thread answerer_;
};

std::unique_ptr<PlayedNode> tablet_node() {
  return std::unique_ptr<PlayedNode>(new PlayedNode(
      "Played Pen", {BTN_TOOL_PEN, BTN_TOUCH, BTN_STYLUS}, {},
      {{ABS_X, 0, 40000, 200}, {ABS_Y, 0, 20000, 200}, {ABS_PRESSURE, 0, 2000, 0}, {ABS_TILT_X, -64, 63, 57}},
      false));
}

void put_pen(const PlayedNode& pen, int x, int y, int pressure) {
  pen.say(EV_KEY, BTN_TOOL_PEN, 1);
  pen.say(EV_KEY, BTN_TOUCH, pressure > 0 ? 1 : 0);
  pen.say(EV_ABS, ABS_X, x);
  pen.say(EV_ABS, ABS_Y, y);
  pen.say(EV_ABS, ABS_PRESSURE, pressure);
  pen.report();
}

bool comes_to(PointerDevice& device, PointerState& state, const Vector3& place) {
  return holds_soon(
      [&] { return device.read(state) == DeviceStatus::Ok && (state.position - place).norm() < 1e-9; });
}

void list(const BackEnd& back_end) {
  for (const DeviceEntry& entry : back_end.list())
    std::printf("        %s (%s): %s %s\n", entry.name.c_str(), entry.family.c_str(),
                entry.present ? "there," : "absent,", entry.why.c_str());
}

/// Time from an event to the servo's read, as a table's line.
void measure_delay(const PlayedNode& pen, PointerDevice& device) {
  constexpr int kTimes = 2000;
  std::vector<double> microseconds;
  PointerState state;
  for (int i = 0; i < kTimes; ++i) {
    const int x = i % 2 == 0 ? 20100 : 20000;
    const double place = i % 2 == 0 ? 0.0005 : 0.0;
    const std::int64_t start = base::steady_nanoseconds();
    pen.say(EV_ABS, ABS_X, x);
    pen.report();
    const auto end = start + 1'000'000'000;
    while (base::steady_nanoseconds() < end) {
      if (device.read(state) == DeviceStatus::Ok && std::abs(state.position.x() - place) < 1e-9) break;
    }
    microseconds.push_back(1e-3 * double(base::steady_nanoseconds() - start));
    std::this_thread::sleep_for(std::chrono::microseconds(700));
  }
  std::ranges::sort(microseconds);
  std::printf("        event to reading: median %.0f us, p99.9 %.0f us, longest %.0f us\n",
              microseconds[kTimes / 2], microseconds[kTimes * 999 / 1000], microseconds.back());
}

void drive_tablet() {
  auto pen = tablet_node();
  check(pen->made(), "a tablet is made");
  list(kTabletBackEnd);
  auto device = open_input_pointer(linux_inputs(), InputKind::Tablet, "played", {.retry = 0.05});
  check(device.has_value(), device ? "it is opened by a part of its name" : device.error().message);
  if (!device) return;
  PointerState state;
  check(holds_soon([&] { return (*device)->read(state) == DeviceStatus::Ok && state.parked; }), "parked");
  put_pen(*pen, 40000, 0, 1000);
  check(comes_to(**device, state, {0.1, 0.05, -0.0025}), "the far right corner, half pressed");
  measure_delay(*pen, **device);

  // More events than the system keeps for a program, in one frame.
  for (int i = 0; i < 5000; ++i) pen->say(EV_ABS, ABS_X, i % 2 == 0 ? 1000 : 39000);
  pen->say(EV_KEY, BTN_STYLUS, 1);
  put_pen(*pen, 30000, 10000, 0);
  check(comes_to(**device, state, {0.05, 0.0, 0.002}) && state.buttons == 0b10U,
        "events were dropped: resynced");

  pen.reset();
  check(holds_soon([&] { return (*device)->read(state) == DeviceStatus::Lost; }), "unplugged: lost");
  check(holds_soon([&] { return !(*device)->condition().empty(); }), "told: " + (*device)->condition());
  pen = tablet_node();
  check(holds_soon([&] { return (*device)->read(state) == DeviceStatus::Ok; }), "plugged in: found again");
  put_pen(*pen, 0, 20000, 2000);
  check(comes_to(**device, state, {-0.1, -0.05, -0.005}), "and it moves");
}

void drive_mouse() {
  const PlayedNode mouse("Played Mouse", {BTN_LEFT, BTN_RIGHT}, {REL_X, REL_Y, REL_WHEEL}, {}, false);
  check(mouse.made(), "a mouse is made");
  list(kMouseBackEnd);
  auto device = kMouseBackEnd.open("Played Mouse");
  check(device.has_value(), "it is opened");
  if (!device) return;
  mouse.say(EV_REL, REL_X, 100);
  mouse.say(EV_REL, REL_Y, -200);
  mouse.say(EV_REL, REL_WHEEL, 1);
  mouse.report();
  PointerState state;
  check(comes_to(**device, state, {0.005, 0.01, -0.002}), "moved right, away and in");
}

PlayedNode gamepad_node() {
  return {
      "Played Pad",
      {BTN_SOUTH, BTN_EAST, BTN_WEST, BTN_NORTH},
      {},
      {{ABS_X, -1000, 1000, 0}, {ABS_Y, -1000, 1000, 0}, {ABS_RX, -1000, 1000, 0}, {ABS_RY, -1000, 1000, 0}},
      true};
}

void drive_rumble(const PlayedNode& pad, PointerDevice& device) {
  const double full = device.info().max_force;
  check(full > 0.0, "it can rumble");
  const auto pushed = [&](double share) {
    return holds_soon([&] {
      device.write({0.0, full * share, 0.0});
      return std::abs(pad.rumbling() - share) < 0.02;
    });
  };
  check(pushed(0.5) && pushed(1.0) && pushed(0.25), "it rumbles by half, all and a quarter");
  const std::int64_t stopped = base::steady_nanoseconds();
  check(holds_soon([&] { return pad.rumbling() == 0.0; }), "the servo says nothing more: it ends");
  std::printf("        after %.1f ms\n", 1e-6 * double(base::steady_nanoseconds() - stopped));
  const int before = pad.uploads();
  const std::int64_t start = base::steady_nanoseconds();
  while (base::steady_nanoseconds() - start < 1'000'000'000) {
    const double phase = 1e-9 * double(base::steady_nanoseconds() - start);
    device.write({full * std::abs(std::sin(40.0 * phase)), 0.0, 0.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const int uploads = pad.uploads() - before;
  check(uploads <= 101 && uploads > 20, std::to_string(uploads) + " commands in a second of changing force");
}

void drive_gamepad() {
  const PlayedNode pad = gamepad_node();
  check(pad.made(), "a gamepad is made");
  list(kGamepadBackEnd);
  {
    auto device = kGamepadBackEnd.open("");
    check(device.has_value(), device ? "it is opened" : device.error().message);
    if (!device) return;
    pad.say(EV_ABS, ABS_X, 1000);
    pad.report();
    PointerState state;
    check(comes_to(**device, state, {0.1, 0.0, 0.0}), "pushed right, the tip comes to the end of its sphere");
    drive_rumble(pad, **device);
  }
  auto walker = GamepadNavigation::create(linux_inputs());
  check(walker.has_value(), walker ? "it navigates" : walker.error().message);
  if (!walker) return;
  NavigationState state;
  check(holds_soon([&] { return (*walker)->read(state) == DeviceStatus::Ok && state.push.x() == 1.0; }),
        "the stick that is held already pushes");
}

int drive_all() {
  if (access("/dev/uinput", W_OK) != 0) {
    std::fputs(
        "/dev/uinput may not be written to, or is not there: load the module uinput, and run as root\n",
        stderr);
    return 1;
  }
  drive_tablet();
  drive_mouse();
  drive_gamepad();
  std::printf("%d failed\n", failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace icome::devices

int main() { return icome::devices::drive_all(); }
