#include "study/records/disk.h"

#include "study/data_samples.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

TEST(Disk, ReadsWhatIsThere) {
  const StudyScratch scratch;
  const std::string bytes("a\0b\n", 4);
  scratch.write("file", bytes);
  EXPECT_EQ(read_whole(scratch.path() / "file").value(), bytes);
  EXPECT_EQ(read_whole(scratch.path() / "none").value(), std::nullopt);
  EXPECT_FALSE(read_whole(scratch.path()));             // a folder
  EXPECT_FALSE(read_whole(scratch.path() / "file/x"));  // in a file
}

TEST(Disk, WritesAWholeFileOrNone) {
  const StudyScratch scratch;
  const fs::path file = scratch.path() / "file";
  ASSERT_TRUE(write_whole(file, "one"));
  ASSERT_TRUE(write_missing(file, "two"));
  EXPECT_EQ(bytes_of(file), "one");
  fs::create_directory(scratch.path() / "folder");
  EXPECT_FALSE(write_whole(scratch.path() / "folder", "x"));
  const auto entries = fs::directory_iterator(scratch.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 2);  // the file and the folder, and no part
  EXPECT_FALSE(write_whole(scratch.path() / "nowhere/file", "x"));
}

TEST(Disk, KnowsWhatKilledProgramsLeft) {
  EXPECT_TRUE(is_part("motion/.x_motion.tsv.part"));  // of earlier programs
  EXPECT_TRUE(is_part("motion/x_motion.tsv.part-1234"));
  EXPECT_TRUE(is_part("motion/x_motion.tsv.part-1234-2"));
  for (const char* const name : {"x_motion.tsv", "x.part", ".part-x", "x.part-", "x.part-1.tsv"})
    EXPECT_FALSE(is_part(name)) << name;
}

TEST(Disk, AddsAfterWhatIsOnRecord) {
  const StudyScratch scratch;
  const fs::path path = scratch.write("file", "a\nb\ntor");
  auto file = AppendFile::open(path, 4);
  ASSERT_TRUE(file);
  EXPECT_EQ(bytes_of(path), "a\nb\n");
  ASSERT_TRUE(file->append("c\n"));
  ASSERT_TRUE(file->append("d\n"));
  EXPECT_EQ(bytes_of(path), "a\nb\nc\nd\n");
  EXPECT_FALSE(AppendFile::open(scratch.path() / "none", 0));
}

TEST(Disk, OneHoldsALock) {
  const StudyScratch scratch;
  const fs::path path = scratch.path() / "lock";
  {
    const auto lock = FileLock::take(path);
    ASSERT_TRUE(lock);
    EXPECT_FALSE(FileLock::try_take(path).value().has_value());
  }
  EXPECT_TRUE(FileLock::try_take(path).value().has_value());
}

TEST(Disk, MakesFoldersInFolders) {
  const StudyScratch scratch;
  ASSERT_TRUE(make_folder(scratch.path() / "a/b/../c/"));
  EXPECT_TRUE(fs::is_directory(scratch.path() / "a/c"));
  EXPECT_TRUE(make_folder(scratch.path() / "a/c"));
  EXPECT_FALSE(make_folder(scratch.write("file", "")));
  EXPECT_FALSE(make_folder(scratch.path() / "file/in"));
  EXPECT_FALSE(make_folder(""));
}

}  // namespace
}  // namespace icome::study
