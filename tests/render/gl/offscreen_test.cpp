#include "render/gl/offscreen.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace icome::render {
namespace {

TEST(Offscreen, StartsWithoutADisplayServer) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const auto context = Offscreen::create();
  ASSERT_TRUE(context.has_value()) << context.error().message;
  EXPECT_FALSE(context->renderer().empty());
}

TEST(Offscreen, SurvivesTheEndOfAnother) {
  auto first = Offscreen::create();
  ASSERT_TRUE(first.has_value());
  { const Offscreen gone = std::move(*first); }
  const auto second = Offscreen::create();
  ASSERT_TRUE(second.has_value());
  EXPECT_FALSE(second->renderer().empty());
}

// A process of its own, because EGL looks for its vendors once.
TEST(OffscreenDeathTest, NamesThePackageWhenEglHasNoVendor) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_DIRS", "/no/such/folder", 1);
        const auto context = Offscreen::create();
        if (!context) fputs(context.error().message.c_str(), stderr);
        _exit(context ? 1 : 0);
      },
      testing::ExitedWithCode(0), "install libegl-mesa0");
}

}  // namespace
}  // namespace icome::render
