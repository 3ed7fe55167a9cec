#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "session/session.h"
#include "ui/timed_application.h"
#include "world/edit/edits_of.h"

namespace icome::ui {

/// The one application of the tests, without a screen.
inline TimedApplication& application() {
  static int argc = 1;
  static char name[] = "icome_ui_tests";
  static char* argv[] = {name, nullptr};
  static TimedApplication* const kApplication = [] {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    return new TimedApplication(argc, argv);
  }();
  return *kApplication;
}

/// A session with an empty design, and what panels do with it.
class DesktopTest : public ::testing::Test {
 protected:
  explicit DesktopTest(session::SessionSettings settings = {}) {
    application();
    auto made = session::Session::create(std::move(settings));
    EXPECT_TRUE(made) << made.error().message;
    session_ = std::move(*made);
  }

  session::Session& session() { return *session_; }
  const world::World& world() { return session_->world(); }

  void perform(const world::Edit& edit, const std::string& name = "Edit") {
    const auto done = session_->history().perform(edit, name);
    EXPECT_TRUE(done) << done.error().message;
  }
  /// Makes the session's empty world equal to another.
  void load(const world::World& other) { perform(world::EditGroup{world::edits_of(other)}, "Load"); }

 private:
  std::unique_ptr<session::Session> session_;
};

}  // namespace icome::ui
