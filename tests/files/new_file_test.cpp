#include "files/new_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "files/file_bytes.h"
#include "files/sample_files.h"

namespace icome::files {
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
  const ScratchFolder folder;
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
  const ScratchFolder folder;
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
  const ScratchFolder folder;
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

TEST(NewFile, SaysWhyItCannotBeWritten) {
  const ScratchFolder folder;
  EXPECT_FALSE(NewFile::create(folder.path() / "nowhere" / "a.txt"));
  EXPECT_FALSE(NewFile::create(folder.path()));
  EXPECT_FALSE(NewFile::create("/dev/null"));
}

}  // namespace
}  // namespace icome::files
