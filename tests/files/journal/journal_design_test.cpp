#include "files/journal/journal_design.h"

#include "files/design_files.h"
#include "files/sample_journals.h"

namespace icome::files {
namespace {

TEST(JournalDesign, IsReadAndWrittenLikeOtherFormats) {
  const ScratchFolder folder;
  const auto path = folder.write("torn.icome", sample_journal().bytes + "\x8aRE tail");
  const auto design = read_design(path);
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(hash(design->world), sample_journal().hashes.back());
  ASSERT_EQ(design->remarks.size(), 2u) << "what is lost, and where it is kept";
  EXPECT_NE(sentence(design->remarks[0], "torn.icome").find("torn.icome: The last edit was cut off"),
            std::string::npos);
  const auto copy = folder.path() / "copy.icome";
  const auto remarks = write_design(copy, design->world);
  ASSERT_TRUE(remarks) << remarks.error().message;
  EXPECT_TRUE(remarks->empty());
  EXPECT_EQ(hash(read_design(copy)->world), hash(design->world));
  EXPECT_FALSE(read_design(copy, {.size_limit = 10}));
}

}  // namespace
}  // namespace icome::files
