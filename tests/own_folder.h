#pragma once
// A folder that no other test has, as the tests of one program run in several processes at a time.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace icome {

/// The path of the running test's own folder, "icome_PURPOSE_SUITE_TEST" among temporary files; it is not
/// made.
inline std::filesystem::path own_folder(const std::string& purpose) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::path(testing::TempDir()) /
         ("icome_" + purpose + "_" + test->test_suite_name() + "_" + test->name());
}

}  // namespace icome
