#include "devices/evdev/input_finder.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <array>

#include "devices/fakes/fake_evdev.h"

namespace icome::devices {
namespace {

using fakes::FakeInputs;
using fakes::gamepad_abilities;
using fakes::mouse_abilities;
using fakes::tablet_abilities;

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The path of the device that is found, or the error.
std::string found_path(FakeInputs& inputs, InputKind kind, std::string_view address,
                       std::string_view preferred = {}) {
  const auto found = find_input(inputs, kind, address, preferred);
  return found ? found->node->abilities().path : found.error().message;
}

TEST(InputFinder, KindsAreKnownByWhatADeviceCanSay) {
  InputAbilities keyboard;
  keyboard.keys[KEY_A] = keyboard.keys[KEY_ENTER] = true;
  InputAbilities touchpad;
  touchpad.axes[ABS_X] = touchpad.axes[ABS_Y] = InputAxis{0, 1000, 0, 10};
  touchpad.keys[BTN_TOUCH] = touchpad.keys[BTN_LEFT] = touchpad.keys[BTN_TOOL_FINGER] = true;
  InputAbilities joystick;
  joystick.axes[ABS_X] = joystick.axes[ABS_Y] = InputAxis{0, 255, 0, 0};
  joystick.keys[BTN_TRIGGER] = true;
  // The buttons of a tablet's frame come as those of a gamepad do, and its wheel as a mouse's.
  InputAbilities tablet = tablet_abilities();
  tablet.keys[BTN_SOUTH] = true;
  tablet.relative[REL_WHEEL] = true;
  const auto kinds = [](const InputAbilities& abilities) {
    return std::array{is_of_kind(abilities, InputKind::Tablet), is_of_kind(abilities, InputKind::Mouse),
                      is_of_kind(abilities, InputKind::Gamepad)};
  };
  using Kinds = std::array<bool, 3>;
  EXPECT_EQ(kinds(tablet), (Kinds{true, false, false}));
  EXPECT_EQ(kinds(mouse_abilities()), (Kinds{false, true, false}));
  EXPECT_EQ(kinds(gamepad_abilities()), (Kinds{false, false, true}));
  EXPECT_EQ(kinds(joystick), (Kinds{false, false, true}));
  EXPECT_EQ(kinds(keyboard), (Kinds{false, false, false}));
  EXPECT_EQ(kinds(touchpad), (Kinds{false, false, false}));
}

TEST(InputFinder, FirstPathAndName) {
  FakeInputs inputs;
  inputs.add(mouse_abilities());
  inputs.add(gamepad_abilities("Pad Pro"));
  inputs.add(gamepad_abilities("Pad"));
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, ""), "/fake/input/event1");
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "/fake/input/event2"), "/fake/input/event2");
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "pad"), "/fake/input/event2")
      << "the whole name goes first";
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "PRO"), "/fake/input/event1");
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "", "Pad"), "/fake/input/event2") << "found again";
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "", "gone"), "/fake/input/event1");
}

TEST(InputFinder, WhatIsInUseIsPassedOver) {
  FakeInputs inputs;
  inputs.add(gamepad_abilities());
  inputs.add(gamepad_abilities());
  auto first = find_input(inputs, InputKind::Gamepad, "Fake Pad");
  auto second = find_input(inputs, InputKind::Gamepad, "Fake Pad");
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->node->abilities().path, second->node->abilities().path);
  EXPECT_TRUE(mentions(found_path(inputs, InputKind::Gamepad, ""), "in use by this program already"));
  EXPECT_TRUE(mentions(found_path(inputs, InputKind::Gamepad, "/fake/input/event0"),
                       "in use by this program already"));
  first = base::fail("let go");
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, ""), "/fake/input/event0");
}

TEST(InputFinder, ErrorsSayWhatIsMissingAndWhatToDo) {
  FakeInputs inputs;
  EXPECT_EQ(found_path(inputs, InputKind::Mouse, ""), "no mouse is plugged in; plug one in, or switch it on");
  inputs.add(gamepad_abilities());
  EXPECT_EQ(found_path(inputs, InputKind::Gamepad, "Wheel"),
            "no gamepad is called \"Wheel\"; there are: Fake Pad");
  EXPECT_EQ(found_path(inputs, InputKind::Tablet, "/fake/input/event0"),
            "/fake/input/event0 is no tablet but \"Fake Pad\"; see what there is by `icome devices`");
  EXPECT_EQ(found_path(inputs, InputKind::Tablet, "/fake/input/event7"),
            "tablet: there is no /fake/input/event7; plug it in, or see what there is by `icome devices`");
  inputs.fail(std::errc::no_such_file_or_directory);
  const std::string nowhere = found_path(inputs, InputKind::Tablet, "");
  EXPECT_TRUE(mentions(nowhere, "/fake/input cannot be looked into")) << nowhere;
  EXPECT_TRUE(mentions(nowhere, "ICOME_INPUT_FOLDER")) << nowhere;
}

TEST(InputFinder, MissingPermissionIsToldWithGroupAndRule) {
  FakeInputs inputs;
  inputs.add(tablet_abilities()).refuse(true);
  inputs.add(mouse_abilities()).refuse(true);
  const std::string advice =
      "add yourself to the group input (sudo usermod -aG input \"$USER\", then log in again), or put this "
      "udev "
      "rule into /etc/udev/rules.d/70-icome-input.rules and plug the device in again: SUBSYSTEM==\"input\", "
      "KERNEL==\"event*\", ENV{ID_INPUT_TABLET}==\"1\", TAG+=\"uaccess\"";
  EXPECT_EQ(found_path(inputs, InputKind::Tablet, ""),
            "no tablet among the input devices that may be read; 2 may not be: " + advice);
  EXPECT_EQ(found_path(inputs, InputKind::Tablet, "/fake/input/event0"),
            "tablet: /fake/input/event0 may not be opened; " + advice);
  EXPECT_TRUE(mentions(found_path(inputs, InputKind::Mouse, ""), "ENV{ID_INPUT_MOUSE}"));
  EXPECT_TRUE(mentions(found_path(inputs, InputKind::Gamepad, ""), "ENV{ID_INPUT_JOYSTICK}"));
  inputs.fail(std::errc::permission_denied);
  EXPECT_EQ(found_path(inputs, InputKind::Tablet, ""),
            "tablet: /fake/input may not be looked into; " + advice);
}

TEST(InputFinder, Lists) {
  FakeInputs inputs;
  const auto none = list_inputs(inputs, InputKind::Tablet, "pointer");
  ASSERT_EQ(none.size(), 1U);
  EXPECT_FALSE(none[0].present);
  EXPECT_EQ(none[0].name, "tablet");
  EXPECT_EQ(none[0].why, "no tablet is plugged in; plug one in, or switch it on");

  inputs.add(tablet_abilities("Intuos"));
  inputs.add(tablet_abilities("Twin"));
  inputs.add(tablet_abilities("Twin"));
  inputs.add(tablet_abilities("/dev/null"));
  const auto there = list_inputs(inputs, InputKind::Tablet, "pointer");
  ASSERT_EQ(there.size(), 4U);
  EXPECT_TRUE(there[0].present);
  EXPECT_EQ(there[0].name, "tablet:Intuos");
  EXPECT_EQ(there[0].family, "pointer");
  EXPECT_EQ(there[0].backend, "tablet");
  EXPECT_EQ(there[0].why, "/fake/input/event0");
  EXPECT_EQ(there[1].name, "tablet:/fake/input/event1") << "two are called alike";
  EXPECT_EQ(there[2].name, "tablet:/fake/input/event2");
  EXPECT_EQ(there[2].why, "Twin, /fake/input/event2");
  EXPECT_EQ(there[3].name, "tablet:/fake/input/event3") << "a name must not read as a path";
}

TEST(InputFinder, NamesAreFitForPeopleAndJson) {
  InputAbilities abilities;
  EXPECT_EQ(shown_name(abilities), "unnamed");
  abilities.name = "Pen\x1b[31m \xff \xc3\xa9";
  EXPECT_EQ(shown_name(abilities), "Pen?[31m ? \xc3\xa9");
}

}  // namespace
}  // namespace icome::devices
