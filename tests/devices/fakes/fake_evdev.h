#pragma once
#include <linux/input-event-codes.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "devices/evdev/input_node.h"

namespace icome::devices::fakes {

/// A fake of an input device: a test tells its events, drops some, unplugs it, and sees the rumble that it
/// was told. Any thread.
class FakeInput {
 public:
  struct Command {
    double strength = 0.0;
    int milliseconds = 0;
    std::int64_t time = 0;  // ns
  };

  explicit FakeInput(InputAbilities abilities) : abilities_(std::move(abilities)) {}

  /// Gives one event to the programs that have the device open.
  void emit(int type, int code, std::int32_t value) { emit(type, code, value, base::steady_nanoseconds()); }
  void emit(int type, int code, std::int32_t value, std::int64_t time) {
    const std::lock_guard lock(guard_);
    const InputEvent event{time, std::uint16_t(type), std::uint16_t(code), value};
    abilities_.state.take(event);
    for (Reader* reader : readers_) {
      if (!reader->overflowing) reader->events.push_back(event);
    }
    told_.notify_all();
  }
  void key(int code, bool down) { emit(EV_KEY, code, down ? 1 : 0); }
  void axis(int code, std::int32_t value) { emit(EV_ABS, code, value); }
  void moved(int code, std::int32_t value) { emit(EV_REL, code, value); }
  void report() { emit(EV_SYN, SYN_REPORT, 0); }

  /// Fills the system's buffer: events that wait are lost, and those that follow too.
  void overflow() {
    const std::lock_guard lock(guard_);
    for (Reader* reader : readers_) {
      reader->overflowing = true;
      reader->events.clear();
    }
  }
  /// Makes room again; programs hear that they missed something.
  void drained() {
    const std::lock_guard lock(guard_);
    for (Reader* reader : readers_) {
      reader->missed = std::exchange(reader->overflowing, false);
    }
    told_.notify_all();
  }

  /// Plugs it in or out; once out, programs that have it open notice, and later ones find no such device.
  void plug(bool in) {
    const std::lock_guard lock(guard_);
    plugged_ = in;
    if (!in) {
      for (Reader* reader : readers_) reader->gone = true;
      abilities_.state = {};
    }
    told_.notify_all();
  }
  void refuse(bool refuses) { set(refused_, refuses); }
  void fail_to_rumble(bool fails) { set(rumble_fails_, fails); }

  bool plugged() const { return get(plugged_); }
  std::size_t open_count() const {
    const std::lock_guard lock(guard_);
    return readers_.size();
  }
  std::vector<Command> commands() const { return get(commands_); }
  /// The strength of its motors now: a command ends by itself.
  double rumbling() const {
    const std::lock_guard lock(guard_);
    if (commands_.empty()) return 0.0;
    const Command& last = commands_.back();
    return base::steady_nanoseconds() - last.time < last.milliseconds * std::int64_t{1'000'000}
               ? last.strength
               : 0.0;
  }

  tl::expected<std::unique_ptr<InputNode>, std::error_code> open() {
    const std::lock_guard lock(guard_);
    if (!plugged_) return tl::unexpected(std::make_error_code(std::errc::no_such_file_or_directory));
    if (refused_) return tl::unexpected(std::make_error_code(std::errc::permission_denied));
    return std::make_unique<Node>(*this);
  }

 private:
  /// The events that one program that has it open has still to read.
  struct Reader {
    std::deque<InputEvent> events;
    InputState known;
    bool overflowing = false;
    bool missed = false;
    bool gone = false;
    std::deque<InputEvent> differences;
  };

  class Node final : public InputNode {
   public:
    explicit Node(FakeInput& input) : input_(input), abilities_(input.abilities_) {
      reader_.known = abilities_.state;
      input_.readers_.push_back(&reader_);
    }
    ~Node() override {
      const std::lock_guard lock(input_.guard_);
      std::erase(input_.readers_, &reader_);
    }

    const InputAbilities& abilities() const override { return abilities_; }

    void wait(int milliseconds) override {
      std::unique_lock lock(input_.guard_);
      input_.told_.wait_for(lock, std::chrono::milliseconds(milliseconds),
                            [&] { return !reader_.events.empty() || reader_.missed || reader_.gone; });
    }

    InputTold next(InputEvent& event) override {
      const std::lock_guard lock(input_.guard_);
      if (reader_.gone) return InputTold::Gone;
      if (std::exchange(reader_.missed, false)) {
        look_for_differences();
        return InputTold::Missed;
      }
      return taken_from(reader_.events, event);
    }

    InputTold next_missed(InputEvent& event) override {
      const std::lock_guard lock(input_.guard_);
      return reader_.gone ? InputTold::Gone : taken_from(reader_.differences, event);
    }

    std::error_code rumble(double strength, int milliseconds) override {
      const std::lock_guard lock(input_.guard_);
      if (reader_.gone) return std::make_error_code(std::errc::no_such_device);
      if (input_.rumble_fails_) return std::make_error_code(std::errc::io_error);
      input_.commands_.push_back({strength, milliseconds, base::steady_nanoseconds()});
      return {};
    }

   private:
    InputTold taken_from(std::deque<InputEvent>& events, InputEvent& event) {
      if (events.empty()) return InputTold::Nothing;
      event = events.front();
      events.pop_front();
      reader_.known.take(event);
      return InputTold::Event;
    }

    /// Compares the state that was told with the present one, as libevdev does.
    void look_for_differences() {
      const InputState& now = input_.abilities_.state;
      const std::int64_t time = base::steady_nanoseconds();
      for (std::size_t code = 0; code < kInputKeys; ++code) {
        if (now.keys[code] != reader_.known.keys[code])
          reader_.differences.push_back({time, EV_KEY, std::uint16_t(code), now.keys[code] ? 1 : 0});
      }
      for (std::size_t code = 0; code < kInputAxes; ++code) {
        if (now.axes[code] != reader_.known.axes[code])
          reader_.differences.push_back({time, EV_ABS, std::uint16_t(code), now.axes[code]});
      }
      reader_.differences.push_back({time, EV_SYN, SYN_REPORT, 0});
    }

    FakeInput& input_;
    InputAbilities abilities_;
    Reader reader_;
  };

  template <typename T>
  void set(T& what, const T& value) {
    const std::lock_guard lock(guard_);
    what = value;
  }
  template <typename T>
  T get(const T& what) const {
    const std::lock_guard lock(guard_);
    return what;
  }

  mutable std::mutex guard_;
  std::condition_variable told_;
  InputAbilities abilities_;
  std::vector<Reader*> readers_;
  std::vector<Command> commands_;
  bool plugged_ = true;
  bool refused_ = false;
  bool rumble_fails_ = false;
};

/// A folder of fake input devices. The test adds them before a driver looks into it.
class FakeInputs final : public InputSystem {
 public:
  /// The device stays there, also unplugged.
  FakeInput& add(InputAbilities abilities) {
    abilities.path = folder_ + "/event" + std::to_string(inputs_.size());
    auto& input = inputs_[abilities.path];
    paths_.push_back(abilities.path);
    input = std::make_unique<FakeInput>(std::move(abilities));
    return *input;
  }
  /// The folder itself cannot be read.
  void fail(std::errc error) { error_ = std::make_error_code(error); }

  const std::string& folder() const override { return folder_; }
  tl::expected<std::vector<std::string>, std::error_code> nodes() override {
    if (error_) return tl::unexpected(error_);
    std::vector<std::string> paths;
    std::ranges::copy_if(paths_, std::back_inserter(paths),
                         [&](const std::string& path) { return inputs_.at(path)->plugged(); });
    return paths;
  }
  tl::expected<std::unique_ptr<InputNode>, std::error_code> open(const std::string& path) override {
    const auto input = inputs_.find(path);
    if (input == inputs_.end())
      return tl::unexpected(std::make_error_code(std::errc::no_such_file_or_directory));
    return input->second->open();
  }

 private:
  std::string folder_ = "/fake/input";
  std::vector<std::string> paths_;
  std::map<std::string, std::unique_ptr<FakeInput>> inputs_;
  std::error_code error_;
};

/// A pen tablet of 200 mm x 100 mm with 200 counts/mm, pressure, distance, and tilt in degrees (57/rad).
inline InputAbilities tablet_abilities(const std::string& name = "Fake Pen") {
  InputAbilities abilities;
  abilities.name = name;
  for (const int key : {BTN_TOOL_PEN, BTN_TOOL_RUBBER, BTN_TOUCH, BTN_STYLUS, BTN_STYLUS2})
    abilities.keys[std::size_t(key)] = true;
  abilities.axes[ABS_X] = InputAxis{0, 40000, 0, 200};
  abilities.axes[ABS_Y] = InputAxis{0, 20000, 0, 200};
  abilities.axes[ABS_PRESSURE] = InputAxis{0, 2000, 0, 0};
  abilities.axes[ABS_DISTANCE] = InputAxis{0, 60, 0, 0};
  abilities.axes[ABS_TILT_X] = abilities.axes[ABS_TILT_Y] = InputAxis{-64, 63, 0, 57};
  return abilities;
}

inline InputAbilities mouse_abilities(const std::string& name = "Fake Mouse") {
  InputAbilities abilities;
  abilities.name = name;
  for (const int key : {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, BTN_SIDE, BTN_EXTRA})
    abilities.keys[std::size_t(key)] = true;
  for (const int axis : {REL_X, REL_Y, REL_WHEEL}) abilities.relative[std::size_t(axis)] = true;
  return abilities;
}

/// A gamepad by the kernel's rules: sticks of +-1000, triggers of 0 to 255, rumble.
inline InputAbilities gamepad_abilities(const std::string& name = "Fake Pad") {
  InputAbilities abilities;
  abilities.name = name;
  for (int key = BTN_SOUTH; key <= BTN_THUMBR; ++key) abilities.keys[std::size_t(key)] = true;
  for (const int axis : {ABS_X, ABS_Y, ABS_RX, ABS_RY})
    abilities.axes[std::size_t(axis)] = InputAxis{-1000, 1000, 16, 0};
  for (const int axis : {ABS_Z, ABS_RZ}) abilities.axes[std::size_t(axis)] = InputAxis{0, 255, 0, 0};
  abilities.rumbles = true;
  return abilities;
}

}  // namespace icome::devices::fakes
