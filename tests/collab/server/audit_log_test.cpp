#include "collab/server/audit_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "files/sample_files.h"

namespace icome::collab {
namespace {

/// The `what` of each row; tells of a line that is no JSON.
std::vector<std::string> rows_in(const std::filesystem::path& path) {
  std::vector<std::string> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const auto row = nlohmann::json::parse(line, nullptr, false);
    rows.push_back(row.is_object() ? row["what"].get<std::string>() : "no JSON: " + line);
  }
  return rows;
}

TEST(AuditLog, LeavesNoPartOfARowOnAFullDiskAndTellsOfThoseThatAreLost) {
  files::ScratchFolder folder;
  const auto path = folder.path() / "audit.jsonl";
  AuditLog log(path);
  ASSERT_TRUE(log.is_open());
  log.write({1, "join"});
  // A limit of the size of files stands for the disk that is full: writing stops in the middle of a row.
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full = {std::filesystem::file_size(path) + 20, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  log.write({2, "refused"});
  log.write({3, "refused"});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(log.lost(), 2U);
  EXPECT_EQ(rows_in(path), std::vector<std::string>{"join"});
  log.write({4, "leave"});
  EXPECT_EQ(log.lost(), 0U);
  EXPECT_EQ(rows_in(path), (std::vector<std::string>{"join", "lost", "leave"}));
}

}  // namespace
}  // namespace icome::collab
