#include "io/new_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/sample_files.h"
#include "io/file_bytes.h"

namespace icome::io {
namespace {

std::size_t count_files(const std::filesystem::path& folder) {
  return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

void write_at(const std::filesystem::path& path, std::string_view bytes) {
  auto file = NewFile::create(path);
  ASSERT_TRUE(file) << file.error().message;
  file->write(bytes);
  const auto finished = file->finish();
  EXPECT_TRUE(finished) << finished.error().message;
}

TEST(NewFile, IsThereWholeOrNotAtAll) {
  const files::ScratchFolder folder;
  const auto path = folder.write("a.txt", "before");
  {
    auto file = NewFile::create(path);
    ASSERT_TRUE(file);
    file->write("after");
    EXPECT_EQ(read_bytes(path, 9).value(), "before");
  }
  EXPECT_EQ(read_bytes(path, 9).value(), "before");
  write_at(path, "after");
  EXPECT_EQ(read_bytes(path, 9).value(), "after");
  EXPECT_EQ(count_files(folder.path()), 1U);
}

TEST(NewFile, SeveralMayWriteTheSameFileAtOnce) {
  const files::ScratchFolder folder;
  const auto path = folder.path() / "a.txt";
  auto one = NewFile::create(path), two = NewFile::create(path);
  ASSERT_TRUE(one && two);
  one->write("one");
  two->write("two");
  EXPECT_TRUE(two->finish());
  EXPECT_TRUE(one->finish());
  EXPECT_EQ(read_bytes(path, 9).value(), "one");
  EXPECT_EQ(count_files(folder.path()), 1U);
}

TEST(NewFile, GoesWhereALinkLeadsAndKeepsPermissions) {
  const files::ScratchFolder folder;
  const auto target = folder.write("target.txt", "before");
  ASSERT_EQ(::chmod(target.c_str(), 0640), 0);
  std::filesystem::create_symlink("target.txt", folder.path() / "link.txt");
  write_at(folder.path() / "link.txt", "after");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(read_bytes(target, 9).value(), "after");
  struct stat status = {};
  ASSERT_EQ(::stat(target.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

TEST(NewFile, TakesAwayWhatProcessesThatAreGoneLeft) {
  const files::ScratchFolder folder;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  const std::string gone = std::to_string(child), here = std::to_string(::getppid());
  for (const std::string& name : {"a.txt.part-" + gone, "a.txt.part-" + gone + "-7", "a.txt.part-" + here,
                                  "a.txt.part-" + here + "-1", "a.txt.part-x" + gone, "b.txt.part-" + gone})
    folder.write(name, "half");
  write_at(folder.path() / "a.txt", "whole");
  EXPECT_EQ(read_bytes(folder.path() / "a.txt", 9).value(), "whole");
  const auto is_there = [&](const std::string& name) {
    return std::filesystem::exists(folder.path() / name);
  };
  EXPECT_FALSE(is_there("a.txt.part-" + gone));
  EXPECT_FALSE(is_there("a.txt.part-" + gone + "-7"));
  EXPECT_TRUE(is_there("a.txt.part-" + here)) << "its process may still write it";
  EXPECT_TRUE(is_there("a.txt.part-" + here + "-1"));
  EXPECT_TRUE(is_there("a.txt.part-x" + gone)) << "somebody else's";
  EXPECT_TRUE(is_there("b.txt.part-" + gone)) << "of another file";
}

TEST(NewFile, SaysWhyItCannotBeWritten) {
  const files::ScratchFolder folder;
  EXPECT_FALSE(NewFile::create(folder.path() / "nowhere" / "a.txt"));
  EXPECT_FALSE(NewFile::create(folder.path()));
  EXPECT_FALSE(NewFile::create("/dev/null"));
}

}  // namespace
}  // namespace icome::io
