#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sketch/files/stroke_files.h"

namespace icome::sketch {

/// Writes a file of that ending among temporary files, for the running test alone.
inline std::filesystem::path stroke_file(const std::string& ending, const std::string& text) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const auto file = std::filesystem::path(testing::TempDir()) /
                    (std::string(test->test_suite_name()) + "_" + test->name() + ending);
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// Reads such a file, which is removed afterwards.
inline base::Result<StrokesRead> strokes_in(const std::string& ending, const std::string& text) {
  const auto file = stroke_file(ending, text);
  auto read = read_strokes(file);
  std::filesystem::remove(file);
  return read;
}

/// The error without the folder: "CSV_Test.csv:2: ...", from the line on.
inline std::string stroke_error(const std::string& ending, const std::string& text) {
  const auto read = strokes_in(ending, text);
  if (read) return "";
  const std::string& message = read.error().message;
  return message.substr(message.find(ending + ":") + ending.size());
}

}  // namespace icome::sketch
