#include "devices/evdev/linux_inputs.h"

#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <linux/input.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/parse_number.h"

namespace icome::devices {
namespace {

static_assert(kInputKeys == KEY_CNT && kInputAxes == ABS_CNT && kInputRelative == REL_CNT);

std::error_code system_error_of(int number) { return {number, std::generic_category()}; }

/// A file of the system that is closed with it.
class OpenNode {
 public:
  explicit OpenNode(int number) : number_(number) {}
  OpenNode(OpenNode&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  OpenNode& operator=(OpenNode&&) = delete;
  ~OpenNode() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

struct FreeLibevdev {
  void operator()(libevdev* device) const { libevdev_free(device); }
};
using Libevdev = std::unique_ptr<libevdev, FreeLibevdev>;

InputAbilities abilities_of(const libevdev* device, const std::string& path, bool writable) {
  InputAbilities result;
  const char* name = libevdev_get_name(device);
  result.name = name == nullptr ? "" : name;
  std::error_code ignored;
  const std::filesystem::path straight = std::filesystem::canonical(path, ignored);
  result.path = ignored ? path : straight.string();
  for (unsigned code = 0; code < kInputKeys; ++code) {
    result.keys[code] = libevdev_has_event_code(device, EV_KEY, code) != 0;
    result.state.keys[code] = libevdev_get_event_value(device, EV_KEY, code) != 0;
  }
  for (unsigned code = 0; code < kInputRelative; ++code)
    result.relative[code] = libevdev_has_event_code(device, EV_REL, code) != 0;
  for (unsigned code = 0; code < kInputAxes; ++code) {
    const input_absinfo* axis = libevdev_get_abs_info(device, code);
    if (axis == nullptr) continue;
    result.axes[code] = InputAxis{axis->minimum, axis->maximum, axis->flat, axis->resolution};
    result.state.axes[code] = axis->value;
  }
  const bool has_rumble = libevdev_has_event_code(device, EV_FF, FF_RUMBLE) != 0;
  result.rumbles = has_rumble && writable;
  result.rumble_refused = has_rumble && !writable;
  return result;
}

class LibevdevNode final : public InputNode {
 public:
  LibevdevNode(OpenNode file, Libevdev device, InputAbilities abilities)
      : file_(std::move(file)), device_(std::move(device)), abilities_(std::move(abilities)) {}

  const InputAbilities& abilities() const override { return abilities_; }

  void wait(int milliseconds) override {
    // libevdev may still hold events that it has read already.
    if (libevdev_has_event_pending(device_.get()) > 0) return;
    pollfd asked{file_.number(), POLLIN, 0};
    if (poll(&asked, 1, milliseconds) > 0 && (asked.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0)
      gone_ = true;
  }

  InputTold next(InputEvent& event) override {
    const auto [status, told] = read(LIBEVDEV_READ_FLAG_NORMAL, event);
    return status == LIBEVDEV_READ_STATUS_SYNC ? InputTold::Missed : told;
  }

  InputTold next_missed(InputEvent& event) override { return read(LIBEVDEV_READ_FLAG_SYNC, event).second; }

  std::error_code rumble(double strength, int milliseconds) override {
    if (strength <= 0.0) return effect_ < 0 ? std::error_code() : play(0);
    ff_effect effect{};
    effect.type = FF_RUMBLE;
    effect.id = effect_;
    effect.replay.length = static_cast<std::uint16_t>(std::clamp(milliseconds, 1, 0x7fff));
    const auto magnitude = static_cast<std::uint16_t>(std::lround(std::min(strength, 1.0) * 0xffff));
    effect.u.rumble = {magnitude, magnitude};
    if (ioctl(file_.number(), EVIOCSFF, &effect) < 0) return system_error_of(errno);
    effect_ = effect.id;
    return play(1);
  }

 private:
  std::pair<int, InputTold> read(unsigned flag, InputEvent& event) {
    input_event told{};
    const int status = libevdev_next_event(device_.get(), flag, &told);
    if (status == -EAGAIN || status == -EINTR) return {status, gone_ ? InputTold::Gone : InputTold::Nothing};
    if (status < 0) return {status, InputTold::Gone};
    event.time = std::int64_t{told.input_event_sec} * 1'000'000'000 + told.input_event_usec * 1000;
    event.type = told.type;
    event.code = told.code;
    event.value = told.value;
    return {status, InputTold::Event};
  }

  /// Plays the effect so many times.
  std::error_code play(int times) {
    input_event command{};
    command.type = EV_FF;
    command.code = static_cast<std::uint16_t>(effect_);
    command.value = times;
    if (::write(file_.number(), &command, sizeof(command)) != ssize_t(sizeof(command)))
      return system_error_of(errno);
    return {};
  }

  OpenNode file_;  // outlives device_
  Libevdev device_;
  InputAbilities abilities_;
  std::int16_t effect_ = -1;  // the system's number of the rumble effect; -1: none yet
  bool gone_ = false;
};

bool is_refusal(int error) { return error == EACCES || error == EPERM || error == EROFS; }

class LinuxInputs final : public InputSystem {
 public:
  explicit LinuxInputs(std::string folder) : folder_(std::move(folder)) {}

  const std::string& folder() const override { return folder_; }

  tl::expected<std::vector<std::string>, std::error_code> nodes() override {
    std::vector<std::pair<unsigned, std::string>> numbered;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder_, error), end; !error && entry != end;
         entry.increment(error)) {
      if (const auto number = number_of(entry->path().filename().string()))
        numbered.emplace_back(*number, entry->path().string());
    }
    if (error) return tl::unexpected(error);
    std::ranges::sort(numbered);
    std::vector<std::string> paths;
    for (auto& [number, path] : numbered) paths.push_back(std::move(path));
    return paths;
  }

  tl::expected<std::unique_ptr<InputNode>, std::error_code> open(const std::string& path) override {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return tl::unexpected(system_error_of(errno));
    if (!S_ISCHR(about.st_mode)) return tl::unexpected(system_error_of(ENOTTY));
    bool writable = true;
    OpenNode file(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
    if (file.number() >= 0) return opened(std::move(file), path, writable);
    if (!is_refusal(errno)) return tl::unexpected(system_error_of(errno));
    writable = false;
    OpenNode readable(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (readable.number() < 0) return tl::unexpected(system_error_of(errno));
    return opened(std::move(readable), path, writable);
  }

 private:
  /// 12 of "event12".
  static std::optional<unsigned> number_of(std::string_view file) {
    constexpr std::string_view kStart = "event";
    if (!file.starts_with(kStart)) return std::nullopt;
    return base::parse_number<unsigned>(file.substr(kStart.size()));
  }

  static tl::expected<std::unique_ptr<InputNode>, std::error_code> opened(OpenNode file,
                                                                          const std::string& path,
                                                                          bool writable) {
    libevdev* made = nullptr;
    const int status = libevdev_new_from_fd(file.number(), &made);
    if (status < 0) return tl::unexpected(system_error_of(-status));
    Libevdev device(made);
    libevdev_set_clock_id(device.get(), CLOCK_MONOTONIC);
    InputAbilities abilities = abilities_of(device.get(), path, writable);
    return std::make_unique<LibevdevNode>(std::move(file), std::move(device), std::move(abilities));
  }

  std::string folder_;
};

}  // namespace

std::shared_ptr<InputSystem> linux_inputs() {
  const char* folder = std::getenv("ICOME_INPUT_FOLDER");
  return std::make_shared<LinuxInputs>(folder == nullptr || *folder == '\0' ? "/dev/input" : folder);
}

}  // namespace icome::devices
