#include "devices/evdev/back_ends.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace icome::devices {
namespace {

/// A folder in which the back-ends look for input devices.
class InputFolder : public testing::Test {
 public:
  InputFolder() : folder("/tmp/icome-input-" + std::to_string(getpid())) {
    std::filesystem::create_directory(folder);
    setenv("ICOME_INPUT_FOLDER", folder.c_str(), 1);
  }
  ~InputFolder() override {
    unsetenv("ICOME_INPUT_FOLDER");
    std::filesystem::remove_all(folder);
  }
  std::filesystem::path folder;
};

TEST_F(InputFolder, WithoutDevicesEachListSaysSo) {
  for (const BackEnd* back_end : {&kTabletBackEnd, &kMouseBackEnd, &kGamepadBackEnd}) {
    const std::vector<DeviceEntry> entries = back_end->list();
    ASSERT_EQ(entries.size(), back_end == &kGamepadBackEnd ? 2U : 1U);
    for (const DeviceEntry& entry : entries) {
      EXPECT_FALSE(entry.present);
      EXPECT_EQ(entry.backend, back_end->name);
      EXPECT_NE(entry.why.find("is plugged in; plug one in"), std::string::npos) << entry.why;
    }
    EXPECT_EQ(entries.front().family, "pointer");
    EXPECT_FALSE(back_end->open(""));
  }
  EXPECT_EQ(kGamepadBackEnd.list().back().family, "navigation");
}

TEST_F(InputFolder, FilesThatAreNoDevicesArePassedOver) {
  for (const char* name : {"event0", "event7", "event", "mouse0", "event99999999999", "event1x"})
    std::ofstream(folder / name) << "nothing";
  std::filesystem::create_symlink("/dev/null", folder / "event2");
  EXPECT_FALSE(kMouseBackEnd.list().front().present);
  for (const char* name : {"event0", "event2"}) {
    const auto opened = kTabletBackEnd.open((folder / name).string());
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().message.find("cannot be opened as an input device"), std::string::npos)
        << opened.error().message;
  }
}

TEST_F(InputFolder, AFolderThatIsNotThereIsNamed) {
  std::filesystem::remove_all(folder);
  const std::string why = kTabletBackEnd.list().front().why;
  EXPECT_NE(why.find(folder.string() + " cannot be looked into"), std::string::npos) << why;
}

TEST_F(InputFolder, WrongSettingsAreToldBeforeAnythingIsOpened) {
  setenv("ICOME_GAMEPAD", "speed=fast", 1);
  const auto opened = kGamepadBackEnd.open("");
  unsetenv("ICOME_GAMEPAD");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message,
            "ICOME_GAMEPAD: \"speed=fast\" should read speed=NUMBER, with a number from 0.001 to 2");
}

}  // namespace
}  // namespace icome::devices
