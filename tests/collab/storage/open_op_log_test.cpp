#include "collab/storage/open_op_log.h"

#include "collab/storage/sample_log.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

TEST(OpenOpLog, TakesWhatIsNoAddressForAFolder) {
  const files::ScratchFolder folder(memory_place());
  const std::filesystem::path store = folder.path() / "store";
  good(good(open_op_log(store))->create("a"));
  EXPECT_TRUE(good(good(SqliteOpLog::open(store / "designs.sqlite")).find("a")));
  folder.write("file", "no store");
  EXPECT_NE(sentence_of(open_op_log(folder.path() / "file")).find("is not a folder"), std::string::npos);
}

}  // namespace
}  // namespace icome::collab
